//! Coulomb friction with sticking and slipping.
//!
//! It holds its joint up to the static limit; beyond, the joint slides against the kinetic effort. A mode of the
//! state distinguishes the two.

use super::keys::{JOINT, REFERENCE};
use super::{Effect, nodes};
use crate::bond_graph::{BondNetwork, NodeKind};
use crate::declaration::{EffectKind, Element, ValueCheck};
use crate::effort_sums::{EffortSums, Hold};
use crate::fault::Help;
use crate::format::{Dimension, Key, Reads};
use crate::layout::{Level, StateLayout};

pub(super) struct Coulomb;

/// The dimensions of a joint's effort.
pub(super) const EFFORT: Reads = Reads::Number(&[Dimension::Torque, Dimension::Force]);

const KINETIC: Key = Key {
    name: "kinetic",
    reads: EFFORT,
    needed: true,
    about: "F_k, the effort while slipping",
};
const STATIC: Key = Key {
    name: "static",
    reads: EFFORT,
    needed: false,
    about: "F_s, the largest effort at rest; F_k without it",
};

impl EffectKind for Coulomb {
    fn keyword(&self) -> &'static str {
        "coulomb"
    }

    fn family(&self) -> &'static str {
        "friction"
    }

    fn summary(&self) -> &'static str {
        "Coulomb friction: holds up to |τ| = F_s, slips against τ = −F_k sgn(q̇ − ṙ)"
    }

    fn symbol(&self) -> &'static str {
        "R"
    }

    fn reads_position(&self) -> bool {
        false
    }

    fn keys(&self) -> &'static [Key] {
        &[KINETIC, STATIC, JOINT, REFERENCE]
    }

    fn once_per_joint(&self) -> bool {
        true
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        check.not_negative(&[KINETIC], Help::FrictionOpposes);
        check.ordered(&KINETIC, &STATIC, Help::RestHoldsMore);
    }

    fn declare(&self, element: &Element, layout: &mut StateLayout) {
        let (name, joint) = (&element.name, element.needed_name(&JOINT));
        let slip = layout.motion_in_words(joint, "slip");
        let mode = format!("whether `{joint}` slips (−1, 1: the sign of {slip}) or is held (0)");
        layout.mode(name.clone(), mode);
        let event = format!("`{joint}` comes to rest, or breaks away");
        layout.event(name.clone(), event);
        if let Some(reference) = element.name(&REFERENCE) {
            let dimension = layout.position_of(joint);
            layout.reference(reference, Level::Rate, Level::Acceleration, dimension);
        }
    }
}

impl Effect for Coulomb {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        nodes::add_acting(element, NodeKind::Resistor, network);
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        let port = sums.port(element);
        let reference = element.name(&REFERENCE);
        let counterpart = [Level::Rate, Level::Acceleration].map(|l| sums.reference(reference, l));
        let kinetic = sums.number(element, &KINETIC);
        let limit = sums.optional(element, &STATIC).unwrap_or(kinetic);
        let mode = sums.mode_at_port(&port, &element.name);
        let effort = -(mode * kinetic);
        sums.push(&port, effort);
        sums.dissipate(-(effort * (port.rate - counterpart[0])));
        sums.supply(effort * counterpart[0]);
        sums.contact(&element.name, &port, counterpart, Hold::Within(limit));
    }
}

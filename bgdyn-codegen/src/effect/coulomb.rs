//! Coulomb friction that sticks and slips: holds its joint up to the static limit, lets it slide
//! against the kinetic effort beyond. Which of the two is a mode of the state.

use super::viscous::{JOINT, REFERENCE};
use super::{Effect, nodes};
use crate::bond_graph::{BondNetwork, NodeKind};
use crate::declaration::{Declaration, Element, Given};
use crate::format::{Dimension, Key, Reads};
use crate::laws::{Hold, Laws};
use crate::layout::{Layout, Level};

pub(super) struct Coulomb;

/// The dimensions of a joint's effort.
pub(super) const EFFORT: Reads = Reads::Number(&[Dimension::Torque, Dimension::Force]);

/// What is said where `static` is less than `kinetic`.
pub(super) const REST_HOLDS_MORE: &str = "rest holds at least what slipping resists";

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

impl Declaration for Coulomb {
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

    fn keys(&self) -> &'static [Key] {
        &[KINETIC, STATIC, JOINT, REFERENCE]
    }

    fn once_per_joint(&self) -> bool {
        true
    }

    fn rules(&self, given: &mut Given<'_>) {
        given.not_negative(&["kinetic"], "friction opposes the motion");
        given.ordered("kinetic", "static", REST_HOLDS_MORE);
    }

    fn declare(&self, element: &Element, layout: &mut Layout) {
        let (name, joint) = (&element.name, element.name("joint").unwrap_or_default());
        let mode = format!("whether `{joint}` slips (−1, 1: the sign of its slip) or is held (0)");
        layout.mode(name.clone(), mode);
        let event = format!("`{joint}` comes to rest, or breaks away");
        layout.event(name.clone(), event);
        if let Some(reference) = element.name("reference") {
            let dimension = layout.position_of(joint);
            layout.reference(reference, Level::Rate, Level::Acceleration, dimension);
        }
    }
}

impl Effect for Coulomb {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        nodes::add_acting(element, NodeKind::Resistor, network);
    }

    fn law(&self, element: &Element, laws: &mut Laws<'_, '_>) {
        let port = laws.port(element);
        let reference = element.name("reference");
        let counterpart = [Level::Rate, Level::Acceleration].map(|l| laws.reference(reference, l));
        let kinetic = laws.number(element, &KINETIC);
        let limit = laws.optional(element, &STATIC).unwrap_or(kinetic);
        let mode = laws.mode(&element.name);
        let effort = -(mode * kinetic);
        laws.push(&port, effort);
        laws.dissipate(-(effort * (port.rate - counterpart[0])));
        laws.supply(effort * counterpart[0]);
        laws.contact(&element.name, &port, counterpart, Hold::Within(limit));
    }
}

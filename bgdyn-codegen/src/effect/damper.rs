//! A damper, at a joint or along the line between two sites: f = −b (ṡ − ṙ).

use super::keys::REFERENCE;
use super::spring::{BETWEEN, MAYBE_JOINT};
use super::viscous::EFFORT_PER_RATE;
use super::{Effect, nodes, slip};
use crate::bond_graph::{BondNetwork, NodeKind};
use crate::declaration::{EffectKind, Element, ValueCheck};
use crate::effort_sums::EffortSums;
use crate::fault::Help;
use crate::format::Key;
use crate::layout::StateLayout;

pub(super) struct Damper;

const DAMPING: Key = Key {
    name: "damping",
    reads: EFFORT_PER_RATE,
    needed: true,
    about: "b, effort per rate",
};

impl EffectKind for Damper {
    fn keyword(&self) -> &'static str {
        "damper"
    }

    fn family(&self) -> &'static str {
        "dampers"
    }

    fn summary(&self) -> &'static str {
        "damper: f = −b (ṡ − ṙ)"
    }

    fn symbol(&self) -> &'static str {
        "R"
    }

    fn reads_position(&self) -> bool {
        false
    }

    fn keys(&self) -> &'static [Key] {
        &[DAMPING, MAYBE_JOINT, BETWEEN, REFERENCE]
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        check.one_of(&[MAYBE_JOINT, BETWEEN]);
        check.not_negative(&[DAMPING], Help::DampingDrivesMotion);
    }

    fn declare(&self, element: &Element, layout: &mut StateLayout) {
        slip::declare(element, layout);
    }
}

impl Effect for Damper {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        nodes::add_acting(element, NodeKind::Resistor, network);
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        slip::resist(element, sums, |sums, s| {
            -(sums.number(element, &DAMPING) * s)
        });
    }
}

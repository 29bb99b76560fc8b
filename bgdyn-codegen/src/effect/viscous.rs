//! Viscous friction of a joint: τ = −b (q̇ − ṙ).

use super::keys::{JOINT, REFERENCE};
use super::{Effect, nodes, slip};
use crate::bond_graph::{BondNetwork, NodeKind};
use crate::declaration::{EffectKind, Element, ValueCheck};
use crate::effort_sums::EffortSums;
use crate::fault::Help;
use crate::format::{Dimension, Key, Reads};
use crate::layout::StateLayout;

pub(super) struct Viscous;

/// The dimensions of an effort per rate.
pub(super) const EFFORT_PER_RATE: Reads =
    Reads::Number(&[Dimension::AngularDamping, Dimension::Damping]);

const DAMPING: Key = Key {
    name: "damping",
    reads: EFFORT_PER_RATE,
    needed: true,
    about: "b, effort per rate",
};

impl EffectKind for Viscous {
    fn keyword(&self) -> &'static str {
        "viscous"
    }

    fn family(&self) -> &'static str {
        "friction"
    }

    fn summary(&self) -> &'static str {
        "viscous friction: τ = −b (q̇ − ṙ)"
    }

    fn symbol(&self) -> &'static str {
        "R"
    }

    fn reads_position(&self) -> bool {
        false
    }

    fn keys(&self) -> &'static [Key] {
        &[DAMPING, JOINT, REFERENCE]
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        check.not_negative(&[DAMPING], Help::DampingDrivesJoint);
    }

    fn declare(&self, element: &Element, layout: &mut StateLayout) {
        slip::declare(element, layout);
    }
}

impl Effect for Viscous {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        nodes::add_acting(element, NodeKind::Resistor, network);
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        slip::resist(element, sums, |sums, s| {
            -(sums.number(element, &DAMPING) * s)
        });
    }
}

//! A damper, at a joint or along the line between two places: f = −b (ṡ − ṙ).

use super::spring::{BETWEEN, MAYBE_JOINT};
use super::viscous::{EFFORT_PER_RATE, REFERENCE};
use super::{Effect, nodes, slip};
use crate::bond_graph::{BondNetwork, NodeKind};
use crate::declaration::{Declaration, Element, Given};
use crate::format::Key;
use crate::laws::Laws;
use crate::layout::Layout;

pub(super) struct Damper;

const DAMPING: Key = Key {
    name: "damping",
    reads: EFFORT_PER_RATE,
    needed: true,
    about: "b, effort per rate",
};

impl Declaration for Damper {
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

    fn keys(&self) -> &'static [Key] {
        &[DAMPING, MAYBE_JOINT, BETWEEN, REFERENCE]
    }

    fn rules(&self, given: &mut Given<'_>) {
        given.one_of(&["joint", "between"]);
        given.not_negative(&["damping"], "a negative damping would drive the motion");
    }

    fn declare(&self, element: &Element, layout: &mut Layout) {
        slip::declare(element, layout);
    }
}

impl Effect for Damper {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        nodes::add_acting(element, NodeKind::Resistor, network);
    }

    fn law(&self, element: &Element, laws: &mut Laws<'_, '_>) {
        slip::resist(element, laws, |laws, s| {
            -(laws.number(element, &DAMPING) * s)
        });
    }
}

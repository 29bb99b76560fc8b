//! Leakage through a gap: laminar flow, q = c Δp (Merritt 1967, chapter 3).

use super::flow::resist;
use super::keys::{CONDUCTANCE, FAMILY, FROM, TO, joins_two};
use super::volume::one_fluid;
use crate::bond_graph::BondNetwork;
use crate::declaration::{Beside, Declaration, Element, Given};
use crate::effect::{Effect, nodes};
use crate::fault::Faults;
use crate::format::Key;
use crate::laws::Laws;

pub(in crate::effect) struct Leakage;

impl Declaration for Leakage {
    fn keyword(&self) -> &'static str {
        "leakage"
    }

    fn family(&self) -> &'static str {
        FAMILY
    }

    fn summary(&self) -> &'static str {
        "leakage: q = c Δp"
    }

    fn symbol(&self) -> &'static str {
        "R"
    }

    fn keys(&self) -> &'static [Key] {
        &[CONDUCTANCE, FROM, TO]
    }

    fn order(&self) -> u8 {
        2
    }

    fn in_series(&self, _: &Element) -> bool {
        true
    }

    fn rules(&self, given: &mut Given<'_>) {
        let why = "what lets nothing through is left out";
        given.positive(&[CONDUCTANCE.name], why);
        joins_two(given, FROM.name, TO.name);
    }

    fn fits(&self, element: &Element, beside: &Beside<'_>, faults: &mut Faults) {
        one_fluid(element, beside, faults);
    }
}

impl Effect for Leakage {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let ends = [FROM, TO].map(|key| element.name(key.name).unwrap_or_default());
        nodes::add_pipe(nodes::label(element), ends, network);
    }

    fn law(&self, element: &Element, laws: &mut Laws<'_, '_>) {
        resist(element, laws, |laws, drop| {
            laws.number(element, &CONDUCTANCE) * drop
        });
    }
}

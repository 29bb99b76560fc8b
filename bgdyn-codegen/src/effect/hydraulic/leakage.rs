//! Leakage through a gap: laminar flow, q = c Δp (Merritt 1967, chapter 3).

use super::flow::resist;
use super::keys::{CONDUCTANCE, FAMILY, FROM, TO, joins_two};
use super::volume::one_fluid;
use crate::bond_graph::BondNetwork;
use crate::declaration::{EffectKind, Element, SceneContext, ValueCheck};
use crate::effect::{Effect, nodes};
use crate::effort_sums::EffortSums;
use crate::fault::{Faults, Help};
use crate::format::Key;

pub(in crate::effect) struct Leakage;

impl EffectKind for Leakage {
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

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        let why = Help::ClosedIsOptional;
        check.positive(&[CONDUCTANCE], why);
        joins_two(check, &FROM, &TO);
    }

    fn check_in_scene(&self, element: &Element, beside: &SceneContext<'_>, faults: &mut Faults) {
        one_fluid(element, beside, faults);
    }
}

impl Effect for Leakage {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let ends = [FROM, TO].map(|key| element.needed_name(&key));
        nodes::add_pipe(nodes::label(element), ends, network);
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        resist(element, sums, |sums, drop| {
            sums.number(element, &CONDUCTANCE) * drop
        });
    }
}

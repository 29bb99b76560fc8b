//! A node without a volume between two resistors: its pressure is solved for symbolically at generation time.

use super::flow::solve;
use super::keys::{FAMILY, FLUID};
use super::volume::{has_fluid, pressure, read_pressure};
use crate::bond_graph::BondNetwork;
use crate::declaration::{EffectKind, Element, SceneContext};
use crate::effect::Effect;
use crate::effort_sums::EffortSums;
use crate::fault::Faults;
use crate::format::Key;

pub(in crate::effect) struct JunctionEffect;

impl EffectKind for JunctionEffect {
    fn keyword(&self) -> &'static str {
        "junction"
    }

    fn family(&self) -> &'static str {
        FAMILY
    }

    fn summary(&self) -> &'static str {
        "hydraulic junction without volume: Σ q = 0"
    }

    fn symbol(&self) -> &'static str {
        "0"
    }

    fn keys(&self) -> &'static [Key] {
        &[FLUID]
    }

    fn nodes(&self, _: &dyn Fn(&Key) -> bool) -> &'static [&'static str] {
        &[""]
    }

    fn is_junction(&self) -> bool {
        true
    }

    // After the nodes with known pressures, before the resistors.

    fn order(&self) -> u8 {
        1
    }

    fn check_in_scene(&self, element: &Element, beside: &SceneContext<'_>, faults: &mut Faults) {
        has_fluid(element, beside, faults);
    }
}

impl Effect for JunctionEffect {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        network.add_pressure(&element.name);
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        solve(element, sums);
        let found = pressure(&element.name, sums);
        read_pressure(&element.name, found, sums);
    }
}

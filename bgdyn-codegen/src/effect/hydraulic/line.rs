//! The volume of a line or a hose: a hydraulic compliance.

use super::keys::{FAMILY, FLUID, number};
use super::volume::{VOLUME, add_volume, declare_volume, fill, filled, has_fluid};
use crate::bond_graph::BondNetwork;
use crate::declaration::{EffectKind, Element, SceneContext, ValueCheck};
use crate::effect::Effect;
use crate::effort_sums::EffortSums;
use crate::expr::Expr;
use crate::fault::{Faults, Help};
use crate::format::{Dimension, Key};
use crate::layout::StateLayout;

pub(in crate::effect) struct Line;

const OWN_VOLUME: Key = number(VOLUME, &[Dimension::Volume], true, "V");
static KEYS: [Key; 2] = [OWN_VOLUME, FLUID];

impl EffectKind for Line {
    fn keyword(&self) -> &'static str {
        "line"
    }

    fn family(&self) -> &'static str {
        FAMILY
    }

    fn summary(&self) -> &'static str {
        "hydraulic volume: Ẇ = q W/V, p = β ln(W/V)"
    }

    fn symbol(&self) -> &'static str {
        "C"
    }

    fn keys(&self) -> &'static [Key] {
        &KEYS
    }

    fn nodes(&self, _: &dyn Fn(&Key) -> bool) -> &'static [&'static str] {
        &[""]
    }

    fn order(&self) -> u8 {
        0
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        let why = Help::LineIsJunction;
        check.positive(&[OWN_VOLUME], why);
    }

    fn check_in_scene(&self, element: &Element, beside: &SceneContext<'_>, faults: &mut Faults) {
        has_fluid(element, beside, faults);
    }

    fn declare(&self, element: &Element, layout: &mut StateLayout) {
        declare_volume(&element.name, layout);
    }
}

impl Effect for Line {
    fn initial_state<'g>(
        &self,
        element: &Element,
        sums: &EffortSums<'g, '_>,
        state: &str,
        entered: Expr<'g>,
    ) -> Expr<'g> {
        filled(element, sums, state, entered)
    }

    fn elements(&self, element: &Element, scene: &[Element], network: &mut BondNetwork) {
        let node = &element.name;
        let volume = element.written(&OWN_VOLUME).map(|v| format!("V = {v}"));
        add_volume(element, node, volume, scene, network);
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        let volume = sums.number(element, &OWN_VOLUME);
        fill(element, &element.name, volume, sums);
    }
}

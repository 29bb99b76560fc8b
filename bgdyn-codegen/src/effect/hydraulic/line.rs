//! The volume of a line or a hose: a hydraulic compliance.

use super::keys::{FAMILY, FLUID, number};
use super::volume::{VOLUME, add_volume, declare_volume, fill, filled, has_fluid};
use crate::bond_graph::BondNetwork;
use crate::declaration::{Beside, Declaration, Element, Given};
use crate::effect::Effect;
use crate::expr::Ex;
use crate::fault::Faults;
use crate::format::{Dimension, Key};
use crate::laws::Laws;
use crate::layout::Layout;

pub(in crate::effect) struct Line;

const OWN_VOLUME: Key = number(VOLUME, &[Dimension::Volume], true, "V");
static KEYS: [Key; 2] = [OWN_VOLUME, FLUID];

impl Declaration for Line {
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

    fn nodes(&self, _: &dyn Fn(&str) -> bool) -> &'static [&'static str] {
        &[""]
    }

    fn order(&self) -> u8 {
        0
    }

    fn rules(&self, given: &mut Given<'_>) {
        let why = "what has no volume is a junction: `{ type: junction }`";
        given.positive(&[VOLUME], why);
    }

    fn fits(&self, element: &Element, beside: &Beside<'_>, faults: &mut Faults) {
        has_fluid(element, beside, faults);
    }

    fn declare(&self, element: &Element, layout: &mut Layout) {
        declare_volume(&element.name, layout);
    }
}

impl Effect for Line {
    fn start<'g>(
        &self,
        element: &Element,
        laws: &Laws<'g, '_>,
        state: &str,
        given: Ex<'g>,
    ) -> Ex<'g> {
        filled(element, laws, state, given)
    }

    fn elements(&self, element: &Element, scene: &[Element], network: &mut BondNetwork) {
        let node = &element.name;
        let volume = element.written(VOLUME).map(|v| format!("V = {v}"));
        add_volume(element, node, volume, scene, network);
    }

    fn law(&self, element: &Element, laws: &mut Laws<'_, '_>) {
        let volume = laws.number(element, &OWN_VOLUME);
        fill(element, &element.name, volume, laws);
    }
}

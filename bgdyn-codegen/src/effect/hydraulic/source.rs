//! Sources of pressure: a supply (an ideal pressure-controlled pump) and a tank.

use super::keys::{FAMILY, FLUID, no_less_than_vacuum, number};
use super::volume::{ENTHALPY, PRESSURE, SOURCE, enthalpy, has_fluid};
use crate::bond_graph::BondNetwork;
use crate::declaration::{EffectKind, Element, SceneContext, ValueCheck};
use crate::effect::Effect;
use crate::effort_sums::EffortSums;
use crate::fault::Faults;
use crate::format::{Dimension, Key};

/// A supply: imposes its pressure for any flow.
pub(in crate::effect) struct Supply;

/// A tank: receives the return flow, at ambient pressure unless the file gives another.
pub(in crate::effect) struct Tank;

const fn pressure_key(needed: bool, about: &'static str) -> Key {
    number(PRESSURE, &[Dimension::Pressure], needed, about)
}

const SUPPLY_PRESSURE: Key = pressure_key(true, "p, against the surroundings");
const TANK_PRESSURE: Key = pressure_key(false, "p, against the surroundings; 0 without it");

static SUPPLY: [Key; 2] = [SUPPLY_PRESSURE, FLUID];
static TANK: [Key; 2] = [TANK_PRESSURE, FLUID];

/// Imposes the pressure of a node.
fn hold(element: &Element, key: &Key, sums: &mut EffortSums<'_, '_>) {
    let (node, one) = (&element.name, sums.b.number(1.0));
    let pressure = sums.number(element, key);
    let carried = enthalpy(element, pressure, sums);
    sums.share(node, PRESSURE, pressure);
    sums.share(node, ENTHALPY, carried);
    sums.share(node, SOURCE, one);
}

impl EffectKind for Supply {
    fn keyword(&self) -> &'static str {
        "supply"
    }

    fn family(&self) -> &'static str {
        FAMILY
    }

    fn summary(&self) -> &'static str {
        "hydraulic supply: keeps its pressure p and delivers the power β (e^{p/β} − 1) q"
    }

    fn symbol(&self) -> &'static str {
        "Se"
    }

    fn keys(&self) -> &'static [Key] {
        &SUPPLY
    }

    fn nodes(&self, _: &dyn Fn(&Key) -> bool) -> &'static [&'static str] {
        &[""]
    }

    fn order(&self) -> u8 {
        0
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        no_less_than_vacuum(check, &SUPPLY_PRESSURE);
    }

    fn check_in_scene(&self, element: &Element, beside: &SceneContext<'_>, faults: &mut Faults) {
        has_fluid(element, beside, faults);
    }
}

impl Effect for Supply {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let pressure = element.written(&SUPPLY_PRESSURE).unwrap_or("0".into());
        network.hold_pressure(&element.name, format!("{}, p = {pressure}", element.name));
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        hold(element, &SUPPLY_PRESSURE, sums);
    }
}

impl EffectKind for Tank {
    fn keyword(&self) -> &'static str {
        "tank"
    }

    fn family(&self) -> &'static str {
        FAMILY
    }

    fn summary(&self) -> &'static str {
        "hydraulic tank: takes what returns at its pressure p"
    }

    fn symbol(&self) -> &'static str {
        "Se"
    }

    fn keys(&self) -> &'static [Key] {
        &TANK
    }

    fn nodes(&self, _: &dyn Fn(&Key) -> bool) -> &'static [&'static str] {
        &[""]
    }

    fn order(&self) -> u8 {
        0
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        no_less_than_vacuum(check, &TANK_PRESSURE);
    }

    fn check_in_scene(&self, element: &Element, beside: &SceneContext<'_>, faults: &mut Faults) {
        has_fluid(element, beside, faults);
    }
}

impl Effect for Tank {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let pressure = element.written(&TANK_PRESSURE).unwrap_or("0".into());
        network.hold_pressure(&element.name, format!("{}, p = {pressure}", element.name));
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        hold(element, &TANK_PRESSURE, sums);
    }
}

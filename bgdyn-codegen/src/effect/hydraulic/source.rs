//! Sources of pressure: a supply (an ideal pressure-controlled pump) and a tank.

use super::keys::{FAMILY, FLUID, no_less_than_vacuum, number};
use super::volume::{ENTHALPY, PRESSURE, SOURCE, enthalpy, has_fluid};
use crate::bond_graph::BondNetwork;
use crate::declaration::{Beside, Declaration, Element, Given};
use crate::effect::Effect;
use crate::fault::Faults;
use crate::format::{Dimension, Key};
use crate::laws::Laws;

/// Holds its pressure whatever runs.
pub(in crate::effect) struct Supply;

/// Takes what returns, at the pressure of the surroundings unless it says otherwise.
pub(in crate::effect) struct Tank;

const fn held(needed: bool, about: &'static str) -> Key {
    number(PRESSURE, &[Dimension::Pressure], needed, about)
}

const SUPPLY_PRESSURE: Key = held(true, "p, against the surroundings");
const TANK_PRESSURE: Key = held(false, "p, against the surroundings; 0 without it");

static SUPPLY: [Key; 2] = [SUPPLY_PRESSURE, FLUID];
static TANK: [Key; 2] = [TANK_PRESSURE, FLUID];

/// A node that holds its pressure.
fn hold(element: &Element, key: &Key, laws: &mut Laws<'_, '_>) {
    let (node, one) = (&element.name, laws.b.number(1.0));
    let pressure = laws.number(element, key);
    let carried = enthalpy(element, pressure, laws);
    laws.share(node, PRESSURE, pressure);
    laws.share(node, ENTHALPY, carried);
    laws.share(node, SOURCE, one);
}

impl Declaration for Supply {
    fn keyword(&self) -> &'static str {
        "supply"
    }

    fn family(&self) -> &'static str {
        FAMILY
    }

    fn summary(&self) -> &'static str {
        "hydraulic supply: holds its pressure p, gives the power β (e^{p/β} − 1) q"
    }

    fn symbol(&self) -> &'static str {
        "Se"
    }

    fn keys(&self) -> &'static [Key] {
        &SUPPLY
    }

    fn nodes(&self, _: &dyn Fn(&str) -> bool) -> &'static [&'static str] {
        &[""]
    }

    fn order(&self) -> u8 {
        0
    }

    fn rules(&self, given: &mut Given<'_>) {
        no_less_than_vacuum(given, PRESSURE);
    }

    fn fits(&self, element: &Element, beside: &Beside<'_>, faults: &mut Faults) {
        has_fluid(element, beside, faults);
    }
}

impl Effect for Supply {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let pressure = element.written(PRESSURE).unwrap_or("0".into());
        network.hold_pressure(&element.name, format!("{}, p = {pressure}", element.name));
    }

    fn law(&self, element: &Element, laws: &mut Laws<'_, '_>) {
        hold(element, &SUPPLY_PRESSURE, laws);
    }
}

impl Declaration for Tank {
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

    fn nodes(&self, _: &dyn Fn(&str) -> bool) -> &'static [&'static str] {
        &[""]
    }

    fn order(&self) -> u8 {
        0
    }

    fn rules(&self, given: &mut Given<'_>) {
        no_less_than_vacuum(given, PRESSURE);
    }

    fn fits(&self, element: &Element, beside: &Beside<'_>, faults: &mut Faults) {
        has_fluid(element, beside, faults);
    }
}

impl Effect for Tank {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let pressure = element.written(PRESSURE).unwrap_or("0".into());
        network.hold_pressure(&element.name, format!("{}, p = {pressure}", element.name));
    }

    fn law(&self, element: &Element, laws: &mut Laws<'_, '_>) {
        hold(element, &TANK_PRESSURE, laws);
    }
}

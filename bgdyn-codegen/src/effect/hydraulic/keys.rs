//! Keys of several hydraulic elements, and rules for their values.

use bgdyn_runtime::Dd;

use crate::declaration::ValueCheck;
use crate::fault::wording;
use crate::format::{Dimension, Key, Reads};

/// The word by which a scene includes all hydraulic effects.
pub(super) const FAMILY: &str = "hydraulics";

/// The fluid of a node.
pub(super) const FLUID: Key = Key {
    name: "fluid",
    reads: Reads::Word(&[]),
    needed: false,
    about: "name of its fluid; needed where the scene has several",
};

pub(super) const fn node(name: &'static str, about: &'static str) -> Key {
    Key {
        name,
        reads: Reads::Node,
        needed: true,
        about,
    }
}

pub(super) const fn number(
    name: &'static str,
    fit: &'static [Dimension],
    needed: bool,
    about: &'static str,
) -> Key {
    Key {
        name,
        reads: Reads::Number(fit),
        needed,
        about,
    }
}

/// The two nodes of a resistor.
pub(super) const FROM: Key = node("from", "the node that a positive flow leaves");
pub(super) const TO: Key = node("to", "the node that a positive flow enters");
/// The two numbers of an orifice's law.
pub(super) const ORIFICE: Key = number(
    "flow",
    &[Dimension::OrificeFlow],
    true,
    "k, flow per root of the pressure drop when fully open",
);
pub(super) const LAMINAR: Key = number(
    "resistance",
    &[Dimension::FlowResistance],
    false,
    "R, pressure drop per flow where the flow is small; 0 without it, and then dq/dΔp is infinite at Δp = 0",
);

/// The least possible gauge pressure, Pa: vacuum.
pub(super) const VACUUM: f64 = -101_325.0;

/// Refuses a pressure below vacuum.
pub(super) fn no_less_than_vacuum(check: &mut ValueCheck<'_>, key: &Key) {
    let too_small = check
        .number(key)
        .filter(|q| q.value < Dd::from_f64(VACUUM))
        .map(|q| (q.location.clone(), q.text.clone()));
    if let Some((location, text)) = too_small {
        check.report(wording::below_vacuum(&location, key.name, &text, VACUUM));
    }
}

/// Refuses an element that joins a node to itself.
pub(super) fn joins_two(check: &mut ValueCheck<'_>, one: &Key, other: &Key) {
    let (a, b) = (check.element.name(one), check.element.name(other));
    if let Some(node) = a.filter(|_| a == b) {
        let location = &check.element.location;
        check.report(wording::joins_a_node_to_itself(
            location,
            [one.name, other.name],
            node,
        ));
    }
}

/// The keyword of a fluid.
pub(super) const FLUID_KEYWORD: &str = "fluid";

/// β of a fluid.
pub(super) const BULK_MODULUS: Key = number(
    "bulk_modulus",
    &[Dimension::Pressure],
    true,
    "β = ρ dp/dρ, constant",
);

/// c of a leakage.
pub(super) const CONDUCTANCE: Key = number(
    "conductance",
    &[Dimension::Leakage],
    true,
    "c, flow per pressure drop",
);

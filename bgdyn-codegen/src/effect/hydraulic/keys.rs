//! Keys that hydraulic elements share, and rules about their values.

use bgdyn_runtime::Dd;

use crate::declaration::Given;
use crate::fault::wording;
use crate::format::{Dimension, Key, Reads};

/// The word by which a scene calls for all of it.
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

/// The least pressure there is, against the surroundings: no fluid, Pa.
pub(super) const VACUUM: f64 = -101_325.0;

/// Refuses what is called a pressure but less than a vacuum.
pub(super) fn no_less_than_vacuum(given: &mut Given<'_>, key: &str) {
    let too_small = given
        .number(key)
        .filter(|q| q.value < Dd::from_f64(VACUUM))
        .map(|q| (q.place.clone(), q.text.clone()));
    if let Some((place, text)) = too_small {
        given.report(wording::below_vacuum(&place, key, &text, VACUUM));
    }
}

/// Refuses an element that joins a node to itself.
pub(super) fn joins_two(given: &mut Given<'_>, one: &str, other: &str) {
    let (a, b) = (given.element.name(one), given.element.name(other));
    if let Some(node) = a.filter(|_| a == b) {
        let place = &given.element.place;
        given.report(wording::joins_a_node_to_itself(place, [one, other], node));
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

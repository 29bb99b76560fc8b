//! Keys that several effects declare.

use crate::format::{Dimension, Key, Reads};

/// Returns the key of a number that a file need not give.
pub(super) const fn optional_number(
    name: &'static str,
    fit: &'static [Dimension],
    about: &'static str,
) -> Key {
    Key {
        name,
        reads: Reads::Number(fit),
        needed: false,
        about,
    }
}

/// The joint an effect acts on.
pub(super) const JOINT: Key = Key {
    name: "joint",
    reads: Reads::Coordinate,
    needed: true,
    about: "the joint, or the effect whose coordinate it is",
};

/// The counterpart of friction and springs; by default the fixed world.
pub(super) const REFERENCE: Key = Key {
    name: "reference",
    reads: Reads::Input,
    needed: false,
    about: "name of the moving counterpart (a belt), an input; at rest without it",
};

/// The site of a link at which an effect acts.
pub(super) const AT: Key = Key {
    name: "at",
    reads: Reads::Site,
    needed: true,
    about: "the link or frame at whose origin it acts",
};

/// The inertia of a rotor.
pub(super) const INERTIA: Key = Key {
    name: "inertia",
    reads: Reads::Number(&[Dimension::Inertia, Dimension::Mass]),
    needed: true,
    about: "J, the rotor's moment of inertia about its axis",
};

/// The ratio of the gear between a rotor and its joint.
pub(super) const RATIO: Key = Key {
    name: "ratio",
    reads: Reads::Number(&[Dimension::One]),
    needed: false,
    about: "N, turns of the rotor per turn of the joint; 1 without it",
};

//! The closing hinge.

use super::closing_type::ClosingType;
use crate::mechanism::closure::row::ClosingRow::{Place, Tilt};

/// The places coincide, and their axes are parallel: rotation about the axis is free.
pub(super) static HINGE: ClosingType = ClosingType {
    keyword: "hinge",
    about: "The places coincide, and their axes are parallel: rotation about the axis is free.",
    rows: &[
        ("x", Place(0)),
        ("y", Place(1)),
        ("z", Place(2)),
        ("tilt x", Tilt(0)),
        ("tilt y", Tilt(1)),
    ],
    axial: true,
    length: false,
    coincident: true,
};

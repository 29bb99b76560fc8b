//! The closing point: a spherical joint.

use super::closing_type::ClosingType;
use crate::mechanism::closure::row::ClosingRow::Place;

/// The places coincide: every rotation is free.
pub(super) static POINT: ClosingType = ClosingType {
    keyword: "point",
    about: "The places coincide: every rotation is free.",
    rows: &[("x", Place(0)), ("y", Place(1)), ("z", Place(2))],
    axial: false,
    length: false,
    coincident: true,
};

//! The closing universal joint.

use super::closing_type::ClosingType;
use crate::mechanism::closure::row::ClosingRow::{Angle, Place};

/// The places coincide, and axis z of a is perpendicular to axis x of b.
pub(super) static UNIVERSAL_CLOSING: ClosingType = ClosingType {
    keyword: "universal",
    about: "The places coincide, and axis z of a is perpendicular to axis x of b.",
    rows: &[
        ("x", Place(0)),
        ("y", Place(1)),
        ("z", Place(2)),
        ("angle", Angle),
    ],
    axial: false,
    length: false,
    coincident: true,
};

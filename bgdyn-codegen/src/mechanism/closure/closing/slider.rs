//! The closing slider: a prismatic joint.

use super::closing_type::ClosingType;
use crate::mechanism::closure::row::ClosingRow::{Place, Turn};

/// Place b moves along the axis of place a, without rotation.
pub(super) static SLIDER: ClosingType = ClosingType {
    keyword: "slider",
    about: "Place b moves along the axis of place a, without rotation.",
    rows: &[
        ("x", Place(0)),
        ("y", Place(1)),
        ("turn x", Turn(0)),
        ("turn y", Turn(1)),
        ("turn z", Turn(2)),
    ],
    axial: true,
    length: false,
    coincident: false,
};

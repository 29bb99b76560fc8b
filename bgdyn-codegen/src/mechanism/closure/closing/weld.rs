//! The closing weld.

use super::closing_type::ClosingType;
use crate::mechanism::closure::row::ClosingRow::{Place, Turn};

/// The places coincide, and nothing moves: a link that is cut in two.
pub(super) static WELD: ClosingType = ClosingType {
    keyword: "weld",
    about: "The places coincide, and nothing moves: a link that is cut in two.",
    rows: &[
        ("x", Place(0)),
        ("y", Place(1)),
        ("z", Place(2)),
        ("turn x", Turn(0)),
        ("turn y", Turn(1)),
        ("turn z", Turn(2)),
    ],
    axial: false,
    length: false,
    coincident: true,
};

//! The closing rod.

use super::closing_type::ClosingType;
use crate::mechanism::closure::row::ClosingRow::Length;

/// The places are connected by a massless rod with a ball at both ends.
pub(super) static DISTANCE: ClosingType = ClosingType {
    keyword: "distance",
    about: "The places are connected by a massless rod with a ball at both ends.",
    rows: &[("length", Length)],
    axial: false,
    length: true,
    coincident: false,
};

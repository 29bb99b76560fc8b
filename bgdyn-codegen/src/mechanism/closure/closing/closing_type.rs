//! The type of a loop: its word in the spec, and its rows.

use crate::mechanism::closure::row::ClosingRow;

/// A word for a loop's `type` in the spec, with the rows that it imposes.
#[derive(Debug, PartialEq, Eq)]
pub struct ClosingType {
    /// The word in the spec.
    pub keyword: &'static str,
    /// Its meaning: one line of documentation.
    pub about: &'static str,
    /// Its rows, with their names.
    pub rows: &'static [(&'static str, ClosingRow)],
    /// Whether it has an axis.
    pub axial: bool,
    /// Whether it has a length.
    pub length: bool,
    /// Whether the two places coincide.
    pub coincident: bool,
}

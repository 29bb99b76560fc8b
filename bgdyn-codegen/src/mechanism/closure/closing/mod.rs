//! The types of loop closings: a file for each, and a line for each in [`CLOSING_TYPES`].

mod distance;
mod hinge;
mod point;
mod slider;
mod universal;
mod weld;

use super::row::RowKind;

/// A word for a loop's `type` in the spec, with the rows that it imposes.
#[derive(Debug, PartialEq, Eq)]
pub struct ClosingType {
    /// The word in the spec.
    pub keyword: &'static str,
    /// Its meaning: one line of documentation.
    pub about: &'static str,
    /// Its rows, with their names.
    pub rows: &'static [(&'static str, RowKind)],
    /// Whether it has an axis.
    pub axial: bool,
    /// Whether it has a length.
    pub length: bool,
    /// Whether the two places coincide.
    pub coincident: bool,
}

/// All types of loop closings.
pub static CLOSING_TYPES: [&ClosingType; 6] = [
    &hinge::HINGE,
    &point::POINT,
    &slider::SLIDER,
    &weld::WELD,
    &distance::DISTANCE,
    &universal::UNIVERSAL_CLOSING,
];

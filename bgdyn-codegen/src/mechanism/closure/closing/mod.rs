//! The types of loop closings: a file for each, and a line for each in [`CLOSING_TYPES`].

mod closing_type;
mod distance;
mod hinge;
mod point;
mod slider;
mod universal;
mod weld;

pub use closing_type::ClosingType;

/// All types of loop closings.
pub static CLOSING_TYPES: [&ClosingType; 6] = [
    &hinge::HINGE,
    &point::POINT,
    &slider::SLIDER,
    &weld::WELD,
    &distance::DISTANCE,
    &universal::UNIVERSAL_CLOSING,
];

//! Colours and line heights of drawings and legends.

/// Colour of the velocities' bars and names.
pub(super) const VELOCITY: &str = "#1d4f91";
pub(super) const VELOCITY_BAR: &str = "#b9cde8";
/// Colour of the horizontal bars.
pub(super) const SUM: &str = "#8a5a12";
pub(super) const SUM_BAR: &str = "#ead3a8";
/// Height of a line of text.
pub(super) const LINE: f64 = 17.0;

//! Colours and line heights of drawings and legends.

/// Colour of the velocities' bars and names.
pub(super) const VELOCITY: &str = "#1d4f91";
pub(super) const VELOCITY_BAR: &str = "#b9cde8";
/// Colour of the bars across.
pub(super) const SUM: &str = "#8a5a12";
pub(super) const SUM_BAR: &str = "#ead3a8";
/// From one line of words to the next.
pub(super) const LINE: f64 = 17.0;

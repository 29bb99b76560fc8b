//! Controllers of a scene that a computer samples.

/// How the controllers of a scene are sampled: at k · `period` their inputs are measured, with the noise and the
/// resolution of the sensors, and what they compute acts `delay` later, until the next value does (zero-order hold).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampledControl<'a> {
    /// Time between two samples, s.
    pub period: f64,
    /// Time from a sample to its effect, s; at most [`SampledControl::DELAYS`] periods.
    pub delay: f64,
    /// For each component of the state the step of its sensor, in the component's unit; 0 without.
    pub resolution: &'a [f64],
    /// For each component of the state the standard deviation of the sensor's noise, in the component's unit.
    pub noise: &'a [f64],
    /// Indices of the inputs that controllers compute.
    pub controlled: &'a [usize],
    /// For each of these the step of its values, in the input's unit; 0 without.
    pub input_resolution: &'a [f64],
    /// Seed of the noise: the same seed gives the same noise.
    pub seed: u64,
}

impl SampledControl<'_> {
    /// The longest delay, in periods.
    pub const DELAYS: usize = 16;
}

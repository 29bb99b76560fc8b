//! How the controllers of a scene are sampled.

use bgdyn_runtime::SampledControl;

/// How the controllers of a scene are sampled, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Control {
    /// Time between two samples, s.
    pub period: f64,
    /// Time from a sample to its effect, s.
    pub delay: f64,
    /// For each component of the state the step of its sensor; 0 without.
    pub resolution: Vec<f64>,
    /// For each component of the state the standard deviation of the noise.
    pub noise: Vec<f64>,
    /// Indices of the inputs that controllers compute.
    pub controlled: Vec<usize>,
    /// For each of these the step of its values; 0 without.
    pub input_resolution: Vec<f64>,
    /// Seed of the noise.
    pub seed: u64,
}

impl Control {
    /// Returns it as integrators read it.
    pub fn sampled(&self) -> SampledControl<'_> {
        SampledControl {
            period: self.period,
            delay: self.delay,
            resolution: &self.resolution,
            noise: &self.noise,
            controlled: &self.controlled,
            input_resolution: &self.input_resolution,
            seed: self.seed,
        }
    }
}

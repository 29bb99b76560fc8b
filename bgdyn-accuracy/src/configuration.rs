//! A configuration: the settings for running a scene, with a closure that runs it.

use std::fmt;

/// The choice of the steps of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepControl {
    /// Fixed steps of this length, s; the interval between samples is an integer number of them.
    Step(f64),
    /// Steps with an error below this tolerance, absolute and relative, in SI units.
    Tolerance(f64),
}

impl StepControl {
    /// Returns its number: s, or dimensionless.
    pub fn value(self) -> f64 {
        let (StepControl::Step(x) | StepControl::Tolerance(x)) = self;
        x
    }
}

/// Prints `0.002 s`, or `1e-6`.
impl fmt::Display for StepControl {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            StepControl::Step(h) => write!(f, "{} s", crate::format::number(*h)),
            StepControl::Tolerance(tolerance) => write!(f, "{tolerance:e}"),
        }
    }
}

/// The sample times of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// End of the run, s.
    pub end: f64,
    /// Number of samples, equally spaced, the last one at the end.
    pub samples: usize,
}

impl Grid {
    /// Returns the time between two samples, s.
    pub fn interval(&self) -> f64 {
        self.end / self.samples as f64
    }

    /// Returns the number of steps of this length between two samples.
    pub fn parts(&self, step: f64) -> usize {
        (self.interval() / step).round().max(1.0) as usize
    }
}

/// The samples of a complete run.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples {
    /// The measured output at each sample, SI units.
    pub values: Vec<Vec<f64>>,
    /// Estimated time in compiled code, ns, if the run was not compiled.
    pub estimate: Option<f64>,
}

impl Samples {
    /// Returns a complete run with these values, or a failure if they are not all finite.
    pub fn finite(values: Vec<Vec<f64>>, estimate: Option<f64>) -> Result<Samples, RunError> {
        if values.iter().flatten().all(|x| x.is_finite()) {
            return Ok(Samples { values, estimate });
        }
        Err(RunError {
            t: 0.0,
            why: "unstable: not finite".into(),
        })
    }
}

/// The early end of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct RunError {
    /// Time, s.
    pub t: f64,
    /// The reason, in a few words.
    pub why: String,
}

impl fmt::Display for RunError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} at {} s", self.why, crate::format::short(self.t))
    }
}

/// Runs a scene from its start to the end of the grid.
pub type Runner = Box<dyn Fn(&Grid, StepControl) -> Result<Samples, RunError>>;

/// A configuration for running a scene.
pub struct Configuration {
    /// The effects of the scene: `all`, `all but friction`, `gravity+inertia`.
    pub effects: String,
    /// The integrator, by its name in scenes.
    pub method: String,
    /// The integrator's order.
    pub order: u32,
    /// Whether it has step control; else fixed steps.
    pub controlled: bool,
    /// The scalar: `f64`, `f32`.
    pub scalar: &'static str,
    /// The scalar's rounding unit.
    pub epsilon: f64,
    /// The equations: `cheapest`, or a formulation's name.
    pub formulation: String,
    /// Runs the configuration.
    pub run: Runner,
}

/// Prints all fields except the closure.
impl fmt::Debug for Configuration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Configuration")
            .field("effects", &self.effects)
            .field("method", &self.method)
            .field("scalar", &self.scalar)
            .field("formulation", &self.formulation)
            .finish_non_exhaustive()
    }
}

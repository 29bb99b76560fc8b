//! A configuration: one way to run a scene, as a closure.

use std::fmt;

/// What the steps of a run go by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepControl {
    /// Every step is as long, s; a whole number of them makes an interval between samples.
    Step(f64),
    /// As long as a step's error stays below this, absolute and relative, in SI units.
    Tolerance(f64),
}

impl StepControl {
    /// Its number: s, or none.
    pub fn value(self) -> f64 {
        let (StepControl::Step(x) | StepControl::Tolerance(x)) = self;
        x
    }
}

/// `0.002 s`, or `1e-6`.
impl fmt::Display for StepControl {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            StepControl::Step(h) => write!(f, "{} s", crate::format::number(*h)),
            StepControl::Tolerance(tolerance) => write!(f, "{tolerance:e}"),
        }
    }
}

/// When a run is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// When it ends, s.
    pub end: f64,
    /// How many samples there are, equally spaced, the last one at the end.
    pub samples: usize,
}

impl Grid {
    /// Between two samples, s.
    pub fn interval(&self) -> f64 {
        self.end / self.samples as f64
    }

    /// Steps of this length between two samples.
    pub fn parts(&self, step: f64) -> usize {
        (self.interval() / step).round().max(1.0) as usize
    }
}

/// A run that came to its end.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples {
    /// The measured output at each sample, SI units.
    pub values: Vec<Vec<f64>>,
    /// What it would take in compiled code, ns, where this run was none: an estimate.
    pub estimate: Option<f64>,
}

impl Samples {
    /// A run that came to its end with these values; it failed where they are not all finite.
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

/// A run that ended early.
#[derive(Clone, Debug, PartialEq)]
pub struct RunError {
    /// When, s.
    pub t: f64,
    /// Why, in a few words.
    pub why: String,
}

impl fmt::Display for RunError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} at {} s", self.why, crate::format::short(self.t))
    }
}

/// Runs a scene from its start to the end of the grid.
pub type Runner = Box<dyn Fn(&Grid, StepControl) -> Result<Samples, RunError>>;

/// A way to run a scene.
pub struct Configuration {
    /// The effects of the scene: `all`, `all but friction`, `gravity+inertia`.
    pub effects: String,
    /// The method of integration, as scenes name it.
    pub method: String,
    /// The method's order.
    pub order: u32,
    /// Whether it goes by a tolerance, else by steps.
    pub controlled: bool,
    /// The scalar: `f64`, `f32`.
    pub scalar: &'static str,
    /// The scalar's rounding unit.
    pub epsilon: f64,
    /// How the equations are written: `cheapest`, or a formulation's name.
    pub formulation: String,
    /// Runs it.
    pub run: Runner,
}

/// What is known of it, without the closure.
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

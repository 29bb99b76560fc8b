//! Chooses the sequence of steps and tolerances of an integrator, by errors only, not by times.
//!
//! Equal input gives the same rows on every machine.

use crate::configuration::{Configuration, Grid, RunError, StepControl};
use crate::integrate::distance;

/// The extent of a study.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Number of rounds in which everything is timed in turn; the median counts.
    pub rounds: usize,
    /// Number of samples of a run.
    pub samples: usize,
    /// Largest number of fixed steps of a run.
    pub steps: usize,
    /// The same for integrators that solve equations in each step.
    pub implicit_steps: usize,
    /// The smallest tolerance.
    pub tolerance: f64,
    /// Least duration of one measurement, s.
    pub resolution: f64,
}

impl Effort {
    /// Settings for figures.
    pub const FULL: Effort = Effort {
        rounds: 5,
        samples: 20,
        steps: 1 << 17,
        implicit_steps: 1 << 13,
        tolerance: 1e-13,
        resolution: 4e-4,
    };

    /// Settings for a quick study, and for tests.
    pub const QUICK: Effort = Effort {
        rounds: 5,
        samples: 10,
        steps: 1 << 11,
        implicit_steps: 1 << 9,
        tolerance: 1e-9,
        resolution: 1e-4,
    };
}

/// The result of one run.
#[derive(Clone, Debug)]
pub(crate) struct Trial {
    pub step_control: StepControl,
    /// The error, and an estimate of the time if the run was not of compiled code.
    pub outcome: Result<(f64, Option<f64>), RunError>,
}

/// The scale of errors.
pub(crate) struct ErrorScale<'a> {
    pub reference: &'a [Vec<f64>],
    /// The reference's own error.
    pub error: f64,
    /// The size of the motion of the output.
    pub size: f64,
    /// The largest distance of the output from its origin, which its rounding is relative to.
    pub largest: f64,
}

/// Errors above this multiple of the motion count as failures.
const LOST: f64 = 10.0;
/// The largest tolerance.
const FIRST: f64 = 1e-3;
/// Number of recorded failures before the first success.
const SHOWN: usize = 2;

impl ErrorScale<'_> {
    /// Returns the level below which errors are rounding.
    pub fn floor(&self, epsilon: f64) -> f64 {
        (16.0 * epsilon * self.largest).max(4.0 * self.error)
    }

    /// Makes one run.
    pub fn attempt(
        &self,
        configuration: &Configuration,
        grid: &Grid,
        step_control: StepControl,
    ) -> Trial {
        let judged = (configuration.run)(grid, step_control).and_then(|ran| {
            let error = distance(&ran.values, self.reference);
            if error > LOST * self.size {
                let why = "unstable: leaves the motion".into();
                return Err(RunError { t: grid.end, why });
            }
            Ok((error, ran.estimate))
        });
        let outcome = judged;
        Trial {
            step_control,
            outcome,
        }
    }
}

/// Returns whether an integrator solves equations in each step.
fn is_implicit(method: &str) -> bool {
    ["midpoint", "gauss", "rodas"]
        .iter()
        .any(|m| method.contains(m))
}

/// Returns the runs with a configuration's steps or tolerances, from the coarsest on: halved, or a tenth
/// each, until the error is rounding, or no longer decreases, or the limits of the effort are reached.
pub(crate) fn step_sequence(
    configuration: &Configuration,
    grid: &Grid,
    scale: &ErrorScale<'_>,
    effort: &Effort,
) -> Vec<Trial> {
    let most = match is_implicit(&configuration.method) {
        true => effort.implicit_steps,
        false => effort.steps,
    };
    let least = effort.tolerance.max(configuration.epsilon);
    let step_control = |k: i32| match configuration.controlled {
        true => StepControl::Tolerance(FIRST * 0.1_f64.powi(k)),
        false => StepControl::Step(grid.interval() / f64::from(2_u32.pow(k as u32))),
    };
    let within = |k: i32| match configuration.controlled {
        true => FIRST * 0.1_f64.powi(k) > 0.5 * least,
        false => grid.samples << k <= most,
    };
    let mut all: Vec<Trial> = Vec::new();
    let (mut best, mut stalled) = (f64::INFINITY, 0);
    for k in (0..30).take_while(|&k| within(k)) {
        let tried = scale.attempt(configuration, grid, rounded(step_control(k)));
        let error = tried.outcome.as_ref().map(|(error, _)| *error).ok();
        all.push(tried);
        if let Some(error) = error {
            stalled = if error < 0.95 * best { 0 } else { stalled + 1 };
            best = best.min(error);
            if error <= scale.floor(configuration.epsilon)
                || (stalled >= 3 && !configuration.controlled && best < 1e-3 * scale.size)
            {
                break;
            }
        }
    }
    // Of the failures before the first success, the last ones show the limit.
    let first = all
        .iter()
        .position(|t| t.outcome.is_ok())
        .unwrap_or(all.len());
    all.drain(..first.saturating_sub(SHOWN));
    all
}

/// Rounds a tolerance to its decimal: 1e-6, not 1.0000000000000002e-6.
fn rounded(step_control: StepControl) -> StepControl {
    match step_control {
        StepControl::Tolerance(x) => {
            StepControl::Tolerance(format!("{x:.0e}").parse().unwrap_or(x))
        }
        step => step,
    }
}

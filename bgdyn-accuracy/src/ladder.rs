//! The sequence of steps and tolerances of a method, chosen by errors only, not by times.
//!
//! Equal input gives the same rows everywhere.

use crate::contender::{Contender, Grid, StepControl, Stop};
use crate::integrate::distance;

/// How thorough a study is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// Rounds in which everything is timed in turn; the median counts.
    pub rounds: usize,
    /// Samples of a run.
    pub samples: usize,
    /// The most steps of a run by fixed steps.
    pub steps: usize,
    /// The same of methods that solve equations in each step.
    pub implicit_steps: usize,
    /// The smallest tolerance.
    pub tolerance: f64,
    /// Time that one measurement takes at least, s.
    pub resolution: f64,
}

impl Plan {
    /// For figures.
    pub const FULL: Plan = Plan {
        rounds: 5,
        samples: 20,
        steps: 1 << 17,
        implicit_steps: 1 << 13,
        tolerance: 1e-13,
        resolution: 4e-4,
    };

    /// For a quick look, and for tests.
    pub const QUICK: Plan = Plan {
        rounds: 5,
        samples: 10,
        steps: 1 << 11,
        implicit_steps: 1 << 9,
        tolerance: 1e-9,
        resolution: 1e-4,
    };
}

/// What came of one try.
#[derive(Clone, Debug)]
pub(crate) struct Tried {
    pub step_control: StepControl,
    /// The error, and an estimate of the time if the run was not of compiled code.
    pub outcome: Result<(f64, Option<f64>), Stop>,
}

/// What errors are held against.
pub(crate) struct Scale<'a> {
    pub reference: &'a [Vec<f64>],
    /// The reference's own error.
    pub error: f64,
    /// How far the output moves.
    pub size: f64,
    /// The largest distance of the output from its origin: what its rounding goes by.
    pub largest: f64,
}

/// Errors above this multiple of the motion are no motion.
const LOST: f64 = 10.0;
/// The largest tolerance.
const FIRST: f64 = 1e-3;
/// Failures that are kept in front of the first success.
const SHOWN: usize = 2;

impl Scale<'_> {
    /// Errors below this are rounding.
    pub fn floor(&self, epsilon: f64) -> f64 {
        (16.0 * epsilon * self.largest).max(4.0 * self.error)
    }

    /// One run.
    pub fn attempt(&self, contender: &Contender, grid: &Grid, step_control: StepControl) -> Tried {
        let judged = (contender.run)(grid, step_control).and_then(|ran| {
            let error = distance(&ran.values, self.reference);
            if error > LOST * self.size {
                let why = "unstable: leaves the motion".into();
                return Err(Stop { t: grid.end, why });
            }
            Ok((error, ran.estimate))
        });
        let outcome = judged;
        Tried {
            step_control,
            outcome,
        }
    }
}

/// Whether a method solves equations in each step.
fn is_implicit(method: &str) -> bool {
    ["midpoint", "gauss", "rodas"]
        .iter()
        .any(|m| method.contains(m))
}

/// A contender's steps or tolerances from the coarsest on: halved, or a tenth each, until the error is
/// rounding, or falls no more, or the plan's end is reached.
pub(crate) fn ladder(
    contender: &Contender,
    grid: &Grid,
    scale: &Scale<'_>,
    plan: &Plan,
) -> Vec<Tried> {
    let most = match is_implicit(&contender.method) {
        true => plan.implicit_steps,
        false => plan.steps,
    };
    let least = plan.tolerance.max(contender.epsilon);
    let step_control = |k: i32| match contender.controlled {
        true => StepControl::Tolerance(FIRST * 0.1_f64.powi(k)),
        false => StepControl::Step(grid.interval() / f64::from(2_u32.pow(k as u32))),
    };
    let within = |k: i32| match contender.controlled {
        true => FIRST * 0.1_f64.powi(k) > 0.5 * least,
        false => grid.samples << k <= most,
    };
    let mut all: Vec<Tried> = Vec::new();
    let (mut best, mut stalled) = (f64::INFINITY, 0);
    for k in (0..30).take_while(|&k| within(k)) {
        let tried = scale.attempt(contender, grid, rounded(step_control(k)));
        let error = tried.outcome.as_ref().map(|(error, _)| *error).ok();
        all.push(tried);
        if let Some(error) = error {
            stalled = if error < 0.95 * best { 0 } else { stalled + 1 };
            best = best.min(error);
            if error <= scale.floor(contender.epsilon)
                || (stalled >= 3 && !contender.controlled && best < 1e-3 * scale.size)
            {
                break;
            }
        }
    }
    // Of failures before the first success the last ones show where it begins.
    let first = all
        .iter()
        .position(|t| t.outcome.is_ok())
        .unwrap_or(all.len());
    all.drain(..first.saturating_sub(SHOWN));
    all
}

/// A tolerance as it is written: 1e-6, not 1.0000000000000002e-6.
fn rounded(step_control: StepControl) -> StepControl {
    match step_control {
        StepControl::Tolerance(x) => {
            StepControl::Tolerance(format!("{x:.0e}").parse().unwrap_or(x))
        }
        step => step,
    }
}

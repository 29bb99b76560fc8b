//! What makes the result of a run doubtful: too many steps, an early end, a drift of the energy, the distance to a
//! finer run.

use bgdyn_codegen::scene::{Integration, StepControl};
use bgdyn_codegen::system::SceneEquations;

use super::plant::Evaluated;
use super::report::{self, number, quantity, short};
use super::run_recorder::record_from;
use super::run_table::{Column, Record, Way};

/// Energy drifts above this, relative to the energy that could move, make the result doubtful.
const DRIFT: f64 = 1e-2;
/// The same for errors, relative to the range of an output.
const ERROR: f64 = 1e-2;
/// Upper limit of the number of steps of a run.
const STEPS: f64 = 1e10;

/// The estimated error of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Estimate {
    /// The line about it, with its line break; empty if there is none.
    pub line: String,
    /// A sentence, if the result means little.
    pub warning: Option<String>,
}

impl Estimate {
    /// Returns the text about it in a report that is read alone.
    pub fn in_report(&self) -> String {
        match &self.warning {
            Some(warning) if self.line.is_empty() => format!("warning: {warning}\n"),
            _ => self.line.clone(),
        }
    }
}

/// Returns the reason why a run would not end in any useful time.
pub fn too_many_steps(integration: &Integration) -> Option<String> {
    let StepControl::Step(h) = integration.step_control else {
        return None;
    };
    let (end, count) = (integration.end, integration.end / h);
    let steps = number(count);
    (count > STEPS).then(|| {
        format!(
            "{steps} steps of {h} s to t = {end} s: that is more than {STEPS:e}; take a longer step"
        )
    })
}

/// Returns the message about a run that ends early, if it does.
pub fn early_end(system: &SceneEquations, run: &Record) -> Option<String> {
    let reason = run.failure.as_ref()?;
    let (t, place) = (short(run.t), report::place(system, run));
    Some(format!(
        "the run ends early at t = {t} s, {place}: {reason}"
    ))
}

/// Returns the warning about the energy drift, if it is large.
pub fn drift_warning(run: &Record) -> Option<String> {
    let drift = report::drift(run);
    // A drift that is NaN is not small.
    (drift.is_nan() || drift > DRIFT).then(|| {
        format!(
            "the energy does not add up by {} of what could move: the result means little; take a smaller step or tolerance",
            number(drift)
        )
    })
}

/// Compares the run with a finer one; `watch` receives the finished fraction of that one.
pub fn estimate(
    plant: &Evaluated<'_>,
    way: &Way,
    columns: &[Column],
    run: &Record,
    watch: &mut dyn FnMut(f64),
) -> Estimate {
    let finer = record_from(plant.clone(), &way.finer(), watch);
    let against = match way.integration.step_control {
        StepControl::Step(_) => "half the step",
        StepControl::Tolerance(_) => "a tenth of the tolerance",
    };
    if let Some(reason) = finer.failure {
        let t = short(finer.t);
        let warning = format!(
            "with {against} the run ends early at t = {t} s ({reason}): the result means little"
        );
        return Estimate {
            line: String::new(),
            warning: Some(warning),
        };
    }
    let Some(found) = run.difference(&finer, columns) else {
        return Estimate::default();
    };
    let Column { name, unit } = &columns[found.column];
    let text = format!(
        "`{name}` by {}, {} of its range, at t = {} s",
        quantity(found.size, unit),
        number(found.share),
        short(found.t)
    );
    let doubtful = found.share.is_nan() || found.share > ERROR;
    let warning = doubtful.then(|| {
        format!(
            "a run with {against} differs in {text}: the result means little there; take a smaller step or tolerance"
        )
    });
    Estimate {
        line: format!("a run with {against} differs most in {text}\n"),
        warning,
    }
}

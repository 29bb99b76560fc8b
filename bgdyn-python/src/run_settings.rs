//! The settings of a run as Python gives them, and values in place of those in the scene's files.

use bgdyn_cli::simulate::Way;
use bgdyn_codegen::scene::{Integration, Override, OverrideKind, Scene, StepControl};
use bgdyn_runtime::Dd;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Upper limit of the number of steps of a run.
const STEPS: f64 = 1e10;

/// The settings of a run, as given: duration (s), step (s), tolerance, number of points.
#[derive(Clone, Copy, Debug, FromPyObject)]
pub struct Settings(Option<f64>, Option<f64>, Option<f64>, usize);

impl Settings {
    /// Returns the scene's settings of integration with these changes.
    ///
    /// # Errors
    /// `ValueError` for settings that the scene cannot have.
    pub fn way(&self, scene: &Scene) -> PyResult<Way> {
        let Settings(duration, step, tolerance, points) = *self;
        let wrong = |message: String| Err(PyValueError::new_err(message));
        let numbers = [
            ("duration", duration),
            ("step", step),
            ("tolerance", tolerance),
        ];
        for (name, value) in numbers {
            if value.is_some_and(|x| !(x.is_finite() && x > 0.0)) {
                let value = value.unwrap_or_default();
                return wrong(format!("`{name}` is a positive number, not {value}"));
            }
        }
        if points < 2 {
            return wrong(format!("points={}: the start and the end are 2", points));
        }
        let own = scene.integration;
        let step_control = match (step, tolerance) {
            (Some(_), Some(_)) => return wrong("give `step` or `tolerance`, not both".into()),
            (Some(step), None) => StepControl::Step(step),
            (None, Some(tolerance)) => StepControl::Tolerance(tolerance),
            (None, None) => own.step_control,
        };
        let method = own.method;
        if matches!(step_control, StepControl::Tolerance(_)) && !method.controls_its_error() {
            let name = method.name();
            return wrong(format!(
                "the scene's method `{name}` does not go by a tolerance: give `step`"
            ));
        }
        let end = duration.unwrap_or(own.end);
        if let StepControl::Step(h) = step_control
            && end / h > STEPS
        {
            return wrong(format!(
                "steps of {h} s to t = {end} s are more than {STEPS:e}: take a longer step"
            ));
        }
        Ok(Way {
            integration: Integration {
                method,
                step_control,
                end,
                impacts: own.impacts,
            },
            points,
            audited: true,
        })
    }
}

/// What a name means that may be both.
pub const EITHER: &str = "parameter or part of the state";

/// Returns the quantity with this name that a run can change: a `parameter`, a `part of the state`, or [`EITHER`].
///
/// # Errors
/// `ValueError` with the nearest name, or those that there are: parameters and parts of the state.
pub fn named(scene: &Scene, what: &str, name: &str) -> PyResult<Override> {
    let wanted =
        |kind: OverrideKind| what == EITHER || kind.is_parameter() == (what == "parameter");
    if let Ok(found) = scene.override_named(what, name, wanted) {
        return Ok(found);
    }
    let other = scene.override_named(EITHER, name, |_| true);
    Err(PyValueError::new_err(match other {
        Err(message) => message,
        Ok(found) => {
            let (kind, argument) = match found.kind.is_parameter() {
                true => ("parameter", "parameters"),
                false => ("part of the state", "initial"),
            };
            format!("`{name}` is a {kind}: give it in `{argument}`")
        }
    }))
}

/// Returns the values that replace those of the scene's files.
///
/// # Errors
/// `ValueError` for unknown names, and for values that are NaN or infinite.
pub fn overrides(
    scene: &Scene,
    parameters: &[(String, f64)],
    initial: &[(String, f64)],
) -> PyResult<Vec<(Override, Dd)>> {
    let parameters = parameters.iter().map(|given| ("parameter", given));
    let initial = initial.iter().map(|given| ("part of the state", given));
    let each = parameters.chain(initial).map(|(what, (name, value))| {
        let found = named(scene, what, name)?;
        match value.is_finite() {
            true => Ok((found, Dd::from_f64(*value))),
            false => Err(PyValueError::new_err(format!("`{name}` is {value}"))),
        }
    });
    each.collect()
}

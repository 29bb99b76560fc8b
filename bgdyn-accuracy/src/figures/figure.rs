//! A figure, and words that several figures use.

use crate::configuration::StepControl;
use crate::format::step;
use crate::row::Row;
use crate::study::Study;

/// A figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// The file's name: `arm_methods.svg`.
    pub name: String,
    /// Its caption, in a sentence.
    pub caption: String,
    /// The SVG text.
    pub svg: String,
}

/// Returns "~" for estimated times.
pub(super) fn about(study: &Study) -> &'static str {
    if study.is_measured() { "" } else { "~" }
}

/// Returns "gauss2 at 2 ms", "dopri5 with the tolerance 1e-6".
pub(crate) fn way(row: &Row) -> String {
    let scalar = match row.scalar.as_str() {
        "f64" => "",
        scalar => &format!(" in {scalar}"),
    };
    match row.step_control {
        StepControl::Step(h) => format!("{}{scalar} at {}", row.method, step(h)),
        StepControl::Tolerance(t) => format!("{}{scalar} with the tolerance {t:e}", row.method),
    }
}

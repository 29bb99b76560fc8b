//! Error against time: a scene's motion by many methods, steps, scalars, formulations and sets of effects.
//!
//! Each run has its error against a reference in double-double, and its time.
//!
//! One factor is varied at a time, from all effects in `f64` by the cheapest formulation. The path:
//!
//! ```text
//! scene ──generate──▶ variants, compiled ──▶ TestCase ──study──▶ Study (rows) ──▶ verdicts, front, figures, page
//! ```
//!
//! - `generate` (the feature of this name) writes the modules of a scene's variants with a function that
//!   makes a [`TestCase`] of them. Build scripts and the command `bgdyn accuracy` call it alike.
//! - [`TestCase`] is what is measured: runs of compiled scenes behind plain closures, so that what
//!   follows knows no scene.
//! - [`study()`] runs each of them, takes the time and gives rows: `accuracy.csv`.
//! - What single effects cost is asked of one call of `derivative` and of the number of steps
//!   ([`Cost`]): differences of the times of whole runs say little about it.
//! - [`verdicts`], [`front`], [`figures`] and [`page`] read rows only.
//!
//! # The error
//! A scene has one measured output: the first place among its outputs, else the first coordinate
//! among them. The error of a run is the largest distance, over equally spaced sample times, of that
//! output from the reference, in the output's own unit (m or rad). For fewer effects it is the change
//! of the motion: the distance from the reference of the scene with all effects.
#![forbid(unsafe_code)]

mod clock;
mod compiled;
mod configuration;
mod cost;
pub mod dark;
mod dyn_plant;
mod figures;
pub mod fine;
mod format;
#[cfg(feature = "generate")]
pub mod generate;
mod integrate;
mod order_check;
mod page;
mod pareto;
mod priced;
mod row;
mod step_sequence;
mod study;
pub mod svg;
mod table;
mod test_case;

pub use bgdyn_runtime::Dd;
pub use bgdyn_sim;
pub use configuration::{Configuration, Grid, RunError, Runner, Samples, StepControl};
pub use cost::{Cost, CountSteps, METHOD as STEPS_METHOD, costs_csv};
pub use figures::{Figure, figures};
pub use integrate::{Integrate, Measured};
pub use order_check::{Finding, Verdict, verdicts};
pub use page::{Machine, page, readme};
pub use pareto::{Choice, front, targets};
pub use priced::{Call, Priced};
pub use row::{Row, Status, rows_csv};
pub use step_sequence::Effort;
pub use study::{Facts, Failed, Study, study};
pub use test_case::{References, TestCase, order};

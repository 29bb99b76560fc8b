//! Error against time: a scene's motion by many methods, steps, scalars, formulations and sets of effects.
//!
//! Each run has its error against a reference in double-double, and its time.
//!
//! One factor is varied at a time, from all effects in `f64` by the cheapest formulation. The path:
//!
//! ```text
//! scene ──generate──▶ variants, compiled ──▶ Subject ──study──▶ Study (rows) ──▶ verdicts, front, figures, page
//! ```
//!
//! - `generate` (the feature of this name) writes the modules of a scene's variants with a function that
//!   makes a [`Subject`] of them. Build scripts and the command `bgdyn accuracy` call it alike.
//! - [`Subject`] is what is measured: runs of compiled scenes behind plain closures, so that what
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
mod contender;
mod converge;
mod cost;
pub mod dark;
mod erased;
mod figures;
pub mod fine;
#[cfg(feature = "generate")]
pub mod generate;
mod integrate;
mod ladder;
mod page;
mod pareto;
mod priced;
mod row;
mod study;
mod subject;
pub mod svg;
mod text;

pub use bgdyn_runtime::Dd;
pub use bgdyn_sim;
pub use contender::{Contender, Grid, Ran, Runner, StepControl, Stop};
pub use converge::{Finding, Verdict, verdicts};
pub use cost::{Cost, CountSteps, METHOD as STEPS_METHOD, costs_csv};
pub use figures::{Figure, figures};
pub use integrate::{Integrate, Measured};
pub use ladder::Plan;
pub use page::{Machine, page, readme};
pub use pareto::{Choice, front, targets};
pub use priced::{Call, Priced};
pub use row::{Row, Status, csv};
pub use study::{Facts, Failed, Study, study};
pub use subject::{References, Subject, order};

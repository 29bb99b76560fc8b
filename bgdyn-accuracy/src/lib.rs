//! Measures error against time of a scene's motion, for many integrators, steps, scalars, formulations and
//! sets of effects.
//!
//! Each run has its error against a reference in double-double, and its time.
//!
//! One factor is varied at a time, starting from all effects in `f64` with the cheapest formulation. The
//! steps:
//!
//! ```text
//! scene ──generate──▶ variants, compiled ──▶ TestCase ──study──▶ Study (rows) ──▶ verdicts, front, figures, page
//! ```
//!
//! - `generate` (the feature of this name) writes the modules of a scene's variants with a function that
//!   creates their [`TestCase`]. Build scripts and the command `bgdyn accuracy` call it.
//! - [`TestCase`] contains runs of compiled scenes behind closures, so that the next steps do not depend
//!   on the scene.
//! - [`study()`] runs each of them, measures the time and returns rows: `accuracy.csv`.
//! - The cost of single effects is measured by one call of `derivative` and by the number of steps
//!   ([`Cost`]): differences of the times of whole runs would not show it.
//! - [`verdicts`], [`front`], [`figures`] and [`page`] only read rows. The last two are in the feature `plot`, as
//!   is [`plot`], which draws all plots with axes.
//!
//! # The error
//! A scene has one measured output: the first site among its outputs, else the first coordinate among
//! them. The error of a run is the largest distance, over equally spaced sample times, of that output from
//! the reference, in the output's own unit (m or rad). For fewer effects it is the change of the motion:
//! the distance from the reference of the scene with all effects. A quaternion is continuous along a run, so
//! that the error of a component is a difference as well.
//!
//! # Rigid contacts
//! `moreau` solves for their impulses in fixed steps; every other integrator and the reference go from event to
//! event ([`bgdyn_sim::event_driven`]), which takes at most [`bgdyn_runtime::MOST_EVENT_CONTACTS`] contacts.
#![forbid(unsafe_code)]

mod clock;
mod compiled;
mod configuration;
mod cost;
pub mod dark;
mod dyn_plant;
#[cfg(feature = "plot")]
mod figures;
mod format;
#[cfg(feature = "generate")]
pub mod generate;
mod integrate;
mod order_check;
#[cfg(feature = "plot")]
mod page;
mod pareto;
#[cfg(feature = "plot")]
pub mod plot;
mod priced;
mod row;
mod scheme;
mod step_sequence;
mod study;
mod table;
mod test_case;

pub use bgdyn_runtime::Dd;
pub use bgdyn_sim;
pub use clock::Spread;
pub use configuration::{Configuration, Grid, RunError, Runner, Samples, StepControl};
pub use cost::{Cost, CountSteps, METHOD as STEPS_METHOD, costs_csv};
#[cfg(feature = "plot")]
pub use figures::{Figure, figures};
pub use format::escaped;
pub use integrate::{Integrate, Measured};
pub use order_check::{Finding, Verdict, verdicts};
#[cfg(feature = "plot")]
pub use page::{Machine, page, readme};
pub use pareto::{Choice, front, targets};
pub use priced::{Call, Priced};
pub use row::{Row, Status, rows_csv};
pub use scheme::{AsItIs, ByEvents, PlantAtStart, Scheme};
pub use step_sequence::Effort;
pub use study::{Failed, Study, StudyInfo, study};
pub use test_case::{References, TestCase, has_law, order};

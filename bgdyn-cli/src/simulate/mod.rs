//! Simulation of scenes in the evaluator, and its reports.

mod axis;
pub(crate) mod batch;
pub(crate) mod batch_plot;
mod difference;
pub(crate) mod page;
mod panel;
mod plant;
pub(crate) mod plot;
pub(crate) mod progress;
mod record;
mod recorder;
pub(crate) mod report;
pub(crate) mod varied;

pub use difference::Difference;
pub use plant::{Evaluated, Form, Numbers, Undefined};
pub use record::{Column, EnergyAt, Event, Record, Row, Way, columns};
pub use recorder::{prepared, record, record_from};

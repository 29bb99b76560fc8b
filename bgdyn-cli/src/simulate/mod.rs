//! Runs of scenes through the evaluator, and what is told of them.

mod plant;
pub(crate) mod plot;
pub(crate) mod progress;
mod record;
pub(crate) mod report;

pub use plant::{Evaluated, Form, Numbers, Undefined};
pub use record::{Column, Difference, Event, Record, Row, Way, columns, record};

//! Simulation of scenes without a compiler, and its reports.

mod axis;
pub(crate) mod batch;
pub(crate) mod batch_plot;
pub(crate) mod batch_values;
mod difference;
pub(crate) mod page;
mod panel;
mod plant;
mod plant_calls;
mod plant_positions;
pub(crate) mod plot;
pub(crate) mod progress;
pub(crate) mod report;
mod run_recorder;
mod run_table;
mod scene_functions;
mod undefined;

pub use batch::{RunSummary, summarized};
pub use difference::Difference;
pub use page::{Words, page};
pub(crate) use plant::Evaluation;
pub use plant::{Evaluated, Numbers, PreparedScene};
pub use report::{changes, report, summary};
pub use run_recorder::{prepared, record, record_from};
pub use run_table::{Column, EnergyAt, Event, Record, Row, Way, columns};
pub use scene_functions::Form;
pub use undefined::Undefined;

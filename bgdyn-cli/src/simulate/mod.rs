//! Simulation of scenes without a compiler, and its reports.

pub(crate) mod batch;
#[cfg(feature = "plot")]
pub(crate) mod batch_plot;
pub(crate) mod batch_values;
mod difference;
mod doubts;
pub(crate) mod page;
mod plant;
mod plant_calls;
mod plant_contacts;
mod plant_positions;
#[cfg(feature = "plot")]
pub(crate) mod plot;
pub(crate) mod progress;
mod recorded;
pub(crate) mod report;
mod run_recorder;
mod run_table;
mod scene_functions;
mod undefined;

pub use batch::{RunSummary, summarized};
pub use difference::Difference;
pub use doubts::{Estimate, drift_warning, early_end, estimate, too_many_steps};
pub use page::{Words, page};
pub(crate) use plant::Evaluation;
pub use plant::{Evaluated, Numbers, PreparedScene};
pub use report::{changes, csv, report, summary};
pub use run_recorder::{prepared, record, record_from};
pub use run_table::{Column, ContactEvent, EnergyAt, Event, POINTS, Record, Row, Way, columns};
pub use scene_functions::Form;
pub use undefined::Undefined;

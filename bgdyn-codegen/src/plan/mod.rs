//! The order in which a function is computed, and the names of its values, in no language: what every backend reads.
//!
//! [`FunctionPlan`] is enough for machine code: the steps of each block, where results are stored, what is read.
//! [`Listing`] adds what text needs: names of values, titles, comments. A language adds its syntax and its
//! reserved words.

mod assembly;
mod block;
mod closing;
mod columns;
mod destinations;
mod function;
mod inline;
mod limits;
mod listing;
mod named_constants;
mod names;
mod naming;
mod order;
mod polygon;
mod products;
mod reads;
mod sines;
mod summary;
mod undetermined;

pub use assembly::{AssemblyConditions, BranchConditions};
pub use block::{BlockPlan, BlockStep};
pub use closing::{
    actuated_pivot_names, closing_names, dependent_joint, independent_positions, loop_names,
    operational_pivot_names, pivot_names, tree_pivot_names,
};
pub use columns::ColumnPlan;
pub use destinations::{Destination, elements, matrix_destinations};
pub use function::{FunctionPlan, Tail};
pub use limits::PlanLimits;
pub use listing::{Comments, ListedStep, Listing};
pub use named_constants::NamedConstant;
pub use names::{LoopArrays, block_name};
pub use naming::{ArgumentNames, Naming};
pub use polygon::{AngleSums, slider_numbers, triangle_numbers, turned_joints};
pub use products::{ProductPlan, ProductTable};
pub use reads::{is_part, leaves, leaves_of, reads_dependents, unread};
pub use sines::AnglePair;
pub use summary::summary_of;
pub use undetermined::{UndeterminedLoad, undetermined_loads};

//! The subcommands.

pub(crate) mod accuracy;
pub mod check;
pub(crate) mod equations;
pub(crate) mod eval;
pub(crate) mod excite;
pub(crate) mod generate;
pub(crate) mod graph;
pub(crate) mod identify;
mod logs;
mod loop_ranges;
mod loops;
pub mod ops;
mod per_effect;
pub(crate) mod schema;
pub(crate) mod simulate;

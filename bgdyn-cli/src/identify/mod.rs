//! `bgdyn identify`: a mechanism's numbers from a log, the spec with them, and a report.

mod edits;
mod friction;
mod json;
mod links;
pub(crate) mod page;
mod rows;
mod spans;
mod text;
mod write;

pub(crate) use friction::{EffectNumber, of_each_joint, word};
pub(crate) use json::json;
pub(crate) use links::{IdentifiedMachine, Wanted};
pub(crate) use text::{summary, table};
pub(crate) use write::write;

//! From a log of positions and efforts to a calibrated model.
//!
//! The steps have one direction: [`log`] (the table, its faults, its quality) → [`even`] (equal steps, no spikes) →
//! [`prepare`] (filtered, differentiated, decimated rows) → [`base`] (which parameters have an effect of their own) →
//! [`fit`] (robust weighted least squares) → [`deviations`] → [`bodies`] (bodies that can exist, nearest to the file)
//! → [`judge`] (another motion). [`identify()`] runs them.
//!
//! Rows of the regressor come from the trait [`Rows`]: the crate knows no mechanism. SI units and radians throughout.
#![forbid(unsafe_code)]

pub mod base;
pub mod bodies;
pub mod deviations;
pub mod even;
pub mod excite;
pub mod fault;
pub mod filter;
pub mod fit;
pub mod identify;
pub mod judge;
pub mod log;
pub mod model;
mod options;
pub mod prepare;
mod problem;
pub mod pseudo_inertia;
mod result;
pub mod spectrum;
pub mod statistics;
pub mod sticking;
pub mod suspect;
pub mod triangle;

pub use fault::LogFault;
pub use identify::identify;
pub use model::{JointPart, LinkPart, Model, Rows};
pub use options::Options;
pub use result::{BaseParameter, Identification, Identified, Judgement};

//! placeholder

pub mod fault;
pub mod math;
pub mod mechanism;
mod read;
pub mod spec;

pub use read::read;

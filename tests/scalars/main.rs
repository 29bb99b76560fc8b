//! Compiled models in every scalar: lanes, dual numbers, double-double.

mod double_double;
mod duals;
mod lanes;
mod models;
mod parameters;
mod runs;

//! Compiled code against golden values, physical laws and its own operation counts.
//!
//! The models are what `bgdyn!` makes of the imported specs in `tests/golden/specs`, and of two in
//! `specs` with and without run-time parameters; of `places`, those of the repository too.

mod counted;
mod counting;
mod golden;
mod golden_values;
mod laws;
mod massless;
mod parameters;
mod places;
mod robots;

//! Random numbers that are the same on every machine: those of [`bgdyn_runtime::random`].

pub use bgdyn_runtime::random::Random;

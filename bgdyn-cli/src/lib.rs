//! The commands of `bgdyn` as a library, so that tests and other tools can call them.

pub mod import;

//! Small parts of the generator, one at a time. Here and not in the files themselves: to compile the generator once more
//! for them takes a minute.

mod causality;
mod effort_sums;
mod frames;
mod massless;
mod name;
mod passes;
mod private;
mod random;
mod render;

// What files under test import from their crate.
use bgdyn_codegen::{expr, method};

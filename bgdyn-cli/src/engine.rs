//! The engine that computes functions for the commands `eval`, `simulate` and `accuracy`.

use bgdyn_codegen::engine::Engine;
use bgdyn_codegen::tape::Tape;

/// The engine of all commands.
pub(crate) static ENGINE: &dyn Engine = &Tape;

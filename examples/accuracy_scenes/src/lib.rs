//! Scenes of the repository, compiled in the variants that the example `accuracy` compares.
#![forbid(unsafe_code)]

/// Measures a scene.
type Study = fn() -> bgdyn_accuracy::TestCase;

include!(concat!(env!("OUT_DIR"), "/modules.rs"));

//! Scenes of the repository, compiled in the variants that the example `accuracy` compares.
#![forbid(unsafe_code)]

include!(concat!(env!("OUT_DIR"), "/modules.rs"));

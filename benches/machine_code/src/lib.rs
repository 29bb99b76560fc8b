//! The generated modules of the arms and the scenes, for the benchmark.
#![forbid(unsafe_code)]

/// The generated modules.
#[allow(missing_docs, reason = "generated")]
pub mod models {
    include!(concat!(env!("OUT_DIR"), "/models.rs"));
}

//! Computed-torque controllers on a Cortex-M, checked against the host.
#![no_std]

pub mod board;
pub mod measure;
pub mod subject;

use control::Record;

/// What the controllers compute with.
#[cfg(not(feature = "double"))]
pub type Real = f32;
/// What the controllers compute with.
#[cfg(feature = "double")]
pub type Real = f64;

include!(concat!(env!("OUT_DIR"), "/motions.rs"));

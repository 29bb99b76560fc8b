//! Computed-torque controllers on a Cortex-M, checked against the host.
#![no_std]

pub mod board;
pub mod check;
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

/// The largest efforts of joints with these limits, in the scalar: found while compiling, or there
/// would be conversions from `f64` in the program.
pub const fn efforts<const N: usize>(limits: &[bgdyn::runtime::Limits; N]) -> [Real; N] {
    let mut efforts = [0.0; N];
    let mut i = 0;
    while i < N {
        efforts[i] = limits[i].effort as Real;
        i += 1;
    }
    efforts
}

//! Rigid-body dynamics generated at compile time: a mechanism in YAML becomes straight-line,
//! `no_std` Rust.
//!
//! ```ignore
//! bgdyn::bgdyn!("scara.yaml"); // pub mod scara { … }
//!
//! let arm = scara::Scara::<f64>::default();
//! let tau = arm.inverse_dynamics(&q, &v, &a);
//! ```
//!
//! Units, frames and signs are said once, in [`runtime`].
#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "macros")]
pub use bgdyn_macros::bgdyn;
pub use bgdyn_runtime as runtime;
pub use bgdyn_runtime::{Dynamics, Scalar, Singular};
pub use nalgebra;

//! What generated code calls, and nothing else: `no_std`, no heap, no panic, no `unsafe`.
//!
//! # Conventions, said once
//! - SI units and radians; torques and rates are those of the joint.
//! - x forward, y left, z up; gravity is the acceleration of free fall in world axes,
//!   `[0, 0, -9.81]` unless the spec says otherwise.
//! - Fixed-axis roll-pitch-yaw: R = Rz(yaw)·Ry(pitch)·Rx(roll).
//! - Spatial vectors list the angular part first.
//! - An inertia tensor's off-diagonal entries are *minus* the products of inertia
//!   (Kuzmin 2007, eq. 1); `ixy` always means the tensor's entry, as in URDF.
//! - `q` positions, `v` velocities, `a` accelerations, `tau` joint efforts.
#![no_std]
#![forbid(unsafe_code)]

mod dd;
mod dynamics;
mod float;
pub mod inertia;
mod joint;
mod operations;
mod pose;
pub mod rotation;
mod scalar;
mod singular;

pub use dd::{Dd, ParseDdError};
pub use dynamics::Dynamics;
pub use joint::{Limits, Motion};
pub use nalgebra;
pub use operations::Operations;
pub use pose::Pose;
pub use scalar::Scalar;
pub use singular::Singular;

//! The runtime library of generated code: `no_std`, no heap, no panic, no `unsafe` (except one instruction
//! on some Arm processors).
//!
//! # Conventions
//! - SI units and radians; torques and rates are those of the joint.
//! - x forward, y left, z up; gravity is the acceleration of free fall in world axes,
//!   `[0, 0, -9.81]` unless the spec says otherwise.
//! - Fixed-axis roll-pitch-yaw: R = Rz(yaw)·Ry(pitch)·Rx(roll).
//! - A coordinate grows about or along its joint's axis, by the right-hand rule; an effort is positive if
//!   it accelerates its coordinate in the positive direction. `gravity` returns the efforts that hold the
//!   mechanism at rest.
//! - A pose's columns are the frame's axes in world axes; its translation is the frame's origin.
//! - Spatial vectors list the angular part first. Velocities, Jacobians and J̇ v of a frame are in world
//!   axes; their linear part is that of the frame's origin.
//! - An inertia tensor's off-diagonal entries are *minus* the products of inertia
//!   (Kuzmin 2007, eq. 1); `ixy` always means the tensor's entry, as in URDF.
//! - `q` positions, `v` velocities, `a` accelerations, `tau` joint efforts.
//!
//! # Features, off by default
//! - `wide`: [`Scalar`] for the lanes of the crate `wide`, re-exported as `wide`. Stays `no_std`.
//! - `num-dual`: [`Scalar`] for the dual numbers of the crate `num-dual`, re-exported as `num_dual`. That
//!   crate needs `std`; this crate does not use it.
//! - `serde`: `Serialize` and `Deserialize` for the structs of generated modules (run-time parameters,
//!   a scene's `State` and `Input`), for [`Limits`] and [`Dd`]; re-exported as `serde`. Stays `no_std`.
//! - `alloc`: [`StateVector`] for nalgebra's `DVector`, whose size is known at run time. Needs a heap.
#![no_std]
// The exception is one instruction on x86-64 and some Arm processors: see `sqrt.rs`.
#![cfg_attr(
    not(any(
        target_arch = "x86_64",
        all(target_arch = "arm", target_abi = "eabihf")
    )),
    forbid(unsafe_code)
)]

mod argument;
mod arrays;
mod base_motion;
pub mod closure;
mod dd;
mod description;
#[cfg(feature = "num-dual")]
mod dual;
mod dynamics;
mod float;
pub mod inertia;
mod joint;
mod joint_columns;
#[cfg(feature = "wide")]
mod lanes;
mod log_cholesky;
pub mod manifold;
mod operations;
mod pose;
pub mod random;
mod rigid_contact;
pub mod rotation;
mod sampled;
mod scalar;
#[cfg(feature = "serde")]
mod serial;
mod sine;
mod singular;
mod sqrt;
mod state_vector;
pub mod step;
mod stiction;
mod system;
mod tanh;
mod two_sum;
mod wrench;

pub use argument::{Argument, Look};
pub use arrays::{inner_products, matrix, mirror, vector};
pub use base_motion::BaseMotion;
pub use dd::{Dd, Digits, ParseDdError};
pub use description::{Coriolis, Derivatives, Description, Frame, JointGroups, Kinematics};
#[cfg(feature = "num-dual")]
pub use dual::DualPart;
pub use dynamics::Dynamics;
pub use joint::{Limits, Motion, QuasiJoint, QuasiJointKind};
pub use joint_columns::{JOINT_COLUMNS, joint_columns};
#[cfg(feature = "wide")]
pub use lanes::LaneSingular;
pub use log_cholesky::LogCholesky;
pub use nalgebra;
#[cfg(feature = "num-dual")]
pub use num_dual;
pub use operations::Operations;
pub use pose::Pose;
pub use rigid_contact::{ContactMap, ImpactLaw, MOST_CONTACTS, MOST_EVENT_CONTACTS, RigidContact};
pub use scalar::Scalar;
#[cfg(feature = "serde")]
pub use serde;
#[cfg(feature = "serde")]
#[doc(hidden)]
pub use serial::{__read_fields, __write_fields};
/// What engines need that compute with the bits of `f64`: the kernel of sines, over a number type of their own, and the
/// bound of pivots. Not for other use: it changes without notice.
#[doc(hidden)]
pub mod kernel {
    pub use crate::float::F64_PIVOT_FLOOR;
    pub use crate::sine::{Coefficients, FUSES, SineLanes, sin_cos_in_range};
}
pub use sampled::SampledControl;
pub use singular::{ACTUATORS, Cause, OUT_OF_REACH, Singular, TASKS};
pub use state_vector::{ArrayOf, FixedVector, MatrixOf, StateVector};
pub use stiction::{mode_by_slip, resolve_stiction, resolve_stiction_by};
pub use system::{Balance, Canonical, Contact, HybridSystem, InputSlope, Slope};
#[cfg(feature = "wide")]
pub use wide;
pub use wrench::{Undetermined, Wrench};

/// Without the feature `serde` it expands to nothing.
#[cfg(not(feature = "serde"))]
#[doc(hidden)]
#[macro_export]
macro_rules! __serde {
    ($($struct:tt)*) => {};
}

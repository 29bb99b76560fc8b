//! Rigid-body dynamics generated at compile time: a mechanism in YAML becomes straight-line,
//! `no_std` Rust.
//!
//! ```
//! use bgdyn::nalgebra::SVector;
//!
//! bgdyn::bgdyn!("scara.yaml"); // specs/scara.yaml becomes pub mod scara { … }
//!
//! let arm = scara::Scara::<f64>::default();
//! let (q, rest) = (SVector::from([0.3, -0.5, 0.1, 0.0]), SVector::zeros());
//! let tau = arm.inverse_dynamics(&q, &rest, &rest);
//! let acceleration = arm.forward_dynamics(&q, &rest, &tau)?;
//! assert!(acceleration.amax() < 1e-12);
//! # Ok::<(), bgdyn::Singular>(())
//! ```
//!
//! SI units and radians; spatial vectors have the angular part first; Jacobians are in world axes, at the
//! frame's origin; gravity is the acceleration of free fall, `[0, 0, -9.81]` by default. [`runtime`]
//! defines all conventions.
//!
//! The repository has a book in `docs/`, from a first model to the equations behind it.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "macros")]
pub use bgdyn_macros::bgdyn;
pub use bgdyn_runtime as runtime;
pub use bgdyn_runtime::{
    Coriolis, Derivatives, Description, Dynamics, Frame, JointGroups, Kinematics, Scalar, Singular,
};
pub use nalgebra;

/// The book's examples, compiled and run by `cargo test --doc -p bgdyn`.
#[cfg(all(doctest, feature = "macros"))]
mod pages {
    #[doc = include_str!("../README.md")]
    struct Readme;

    #[doc = include_str!("../docs/methods.md")]
    struct Methods;

    #[doc = include_str!("../docs/bundles.md")]
    struct Bundles;

    #[doc = include_str!("../docs/steps.md")]
    struct Steps;

    #[doc = include_str!("../docs/spec.md")]
    struct Spec;

    #[doc = include_str!("../docs/scenes.md")]
    struct Scenes;

    #[doc = include_str!("../docs/simulation.md")]
    struct Simulation;
}

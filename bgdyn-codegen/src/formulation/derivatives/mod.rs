//! Formulations of methods that are derivatives of others, by differentiation of expressions.
//!
//! | file | computes |
//! |---|---|
//! | `differentiate.rs` | derivatives of a function's results by the coordinates' leaves |
//! | `forward_dynamics.rs` | derivatives of forward dynamics from those of inverse dynamics |
//! | `by_parameters.rs` | derivatives of the accelerations by parameters |
//! | `directional.rs` | derivatives along one direction, and adjoints |
//! | `second.rs` | second derivatives of all efforts |
//! | `mass_matrix_rate.rs` | the rate of the mass matrix |
//! | `by_differentiation.rs` | the formulations of matrices |
//!
//! Composite-body derivatives of inverse dynamics are in `recursion/derivatives/`.

mod by_differentiation;
mod by_parameters;
mod differentiate;
mod directional;
mod forward_dynamics;
mod mass_matrix_rate;
mod second;

pub(super) use by_differentiation::{Differentiated, ForwardDynamicsDerivatives};
pub(super) use by_parameters::ByParameters;
pub(crate) use differentiate::rates_along;
pub(super) use directional::AlongDirections;
pub(super) use mass_matrix_rate::MassMatrixRate;

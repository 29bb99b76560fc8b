//! Formulations of methods that are derivatives of others, by differentiation of expressions.
//!
//! | file | computes |
//! |---|---|
//! | `differentiate.rs` | derivatives of a function's results by the coordinates' leaves |
//! | `forward_dynamics.rs` | derivatives of forward dynamics from those of inverse dynamics |
//! | `mass_matrix_rate.rs` | the rate of the mass matrix |
//! | `by_differentiation.rs` | the formulations |
//!
//! Composite-body derivatives of inverse dynamics are in `recursion/derivatives/`.

mod by_differentiation;
mod differentiate;
mod forward_dynamics;
mod mass_matrix_rate;

pub(super) use by_differentiation::{Differentiated, ForwardDynamicsDerivatives};
pub(super) use mass_matrix_rate::MassMatrixRate;

//! Methods that are derivatives of others, by differentiating expressions.
//!
//! | file | computes |
//! |---|---|
//! | `differentiate.rs` | derivatives of a function's results by the coordinates' leaves |
//! | `forward_dynamics.rs` | derivatives of forward dynamics from those of inverse dynamics |
//! | `by_differentiation.rs` | the formulations |
//!
//! Those of inverse dynamics by composite bodies are in `recursion/derivatives/`.

mod by_differentiation;
mod differentiate;
mod forward_dynamics;

pub(super) use by_differentiation::{Differentiated, ForwardDynamicsDerivatives};

//! Measures errors of functions in `f64` at sampled states of the mechanism.
//!
//! | file | computes or holds |
//! |---|---|
//! | `sample_states.rs` | the states: random ones, and those in which the mass matrix is nearly singular |
//! | `tree_states.rs` | the states for methods that take velocities of the open tree |
//! | `rounding_error.rs` | the error of any function, in units of rounding |
//! | `reference_solution.rs` | forward dynamics in double-double at one state, with norms of M |
//! | `error_bounds.rs` | errors of forward dynamics compared with bounds |

pub(crate) mod error_bounds;
mod reference_solution;
pub mod rounding_error;
pub(crate) mod sample_states;
pub(crate) mod tree_states;

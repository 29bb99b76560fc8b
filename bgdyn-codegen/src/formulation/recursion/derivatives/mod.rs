//! Derivatives of inverse dynamics and the Coriolis matrix, from composite bodies.
//!
//! | file | computes |
//! |---|---|
//! | `composite_flow.rs` | inertia, flow of mass and force of all bodies outboard of a joint |
//! | `axis_changes.rs` | changes of forces and momenta with a joint's position and rate |
//! | `outboard_joint.rs` | quantities of a joint for the derivatives of inboard joints |
//! | `joint_partials.rs` | the contribution of one joint |
//! | `reference_body.rs` | the body and axes for expressing it, chosen by counting |
//! | `inverse_dynamics.rs` | the derivatives, from the tips to the base |

mod axis_changes;
pub(super) mod composite_flow;
mod inverse_dynamics;
mod joint_partials;
pub(super) mod outboard_joint;
mod reference_body;

pub(super) use inverse_dynamics::{coriolis_matrix, effort_derivatives};
pub(super) use reference_body::{choose_length_unit, choose_partials};

//! Derivatives of inverse dynamics and the Coriolis matrix, from composite bodies.
//!
//! | file | computes |
//! |---|---|
//! | `composite_flow.rs` | inertia, flow of mass and force of all bodies outboard of a joint |
//! | `outboard_joint.rs` | a joint as the joints inboard of it need it |
//! | `joint_partials.rs` | what one joint contributes |
//! | `reference_body.rs` | the body and axes in which that is expressed, chosen by counting |
//! | `inverse_dynamics.rs` | the derivatives, from the tips to the base |

pub(super) mod composite_flow;
mod inverse_dynamics;
mod joint_partials;
pub(super) mod outboard_joint;
mod reference_body;

pub(super) use inverse_dynamics::{coriolis_matrix, effort_derivatives};
pub(super) use reference_body::{choose_length_unit, choose_partials};

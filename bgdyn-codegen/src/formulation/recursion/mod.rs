//! The recursion in link axes: equation (6) summed over the bodies outboard of each joint.
//!
//! It uses base parameters, the common-axis method, sliding origins and groups of parallel axes.
//!
//! | file | computes |
//! |---|---|
//! | `geometry.rs` | a frame for every moving body: z along its joint's axis, x along the common normal with the next axis |
//! | `rotation.rs` | rotations of bodies, about z or about any axis |
//! | `joint_columns.rs` | the velocities of a joint and their directions |
//! | `frames.rs` | these frames as expressions, for one [`Plan`] (`plan.rs`) |
//! | `inertia_ratio.rs` | each joint's own inertia over the inertia that it moves |
//! | `base_parameters.rs` | base parameters: inertia moved inboard, known parts always, run-time parameters by the plan |
//! | `motion.rs` | velocities and accelerations, outboard |
//! | `inverse_dynamics.rs` | forces, moments and efforts, inboard |
//! | `mass_matrix.rs` | the mass matrix, from the momenta of composite bodies |
//! | `energies.rs` | kinetic and potential energy |
//! | `derivatives/` | first derivatives and the Coriolis matrix, from composite bodies |
//! | `kinematics.rs` | poses, velocities and Jacobians of sites |
//! | `expressions.rs` | the expressions of a method under a plan, from the files above |
//! | `plan_search.rs`, `plans.rs` | the cheapest plan, by counting: one choice at a time, in a bounded number of steps |
//! | `formulation.rs` | the recursion as a formulation |
//! | `standard_parameters.rs` | the same with each body's own inertia |
//! | `common_axes.rs` | the mass matrix of long chains |
//! | `articulated/` | forward dynamics by articulated bodies |
//! | `rotors.rs` | rotors behind gears |
//! | `centroidal/` | the centre of mass, and the momentum about it |
//! | `regressor/` | regressors and base parameters |
//!
//! A plan states how far origins slide, the unit of length, which parallel joints have a common basis, for
//! which bodies the inertia is rotated instead of the vectors, how far run-time parameters move inboard,
//! and which point masses have a separate force. In small mechanisms the four cheapest plans are factored
//! before one is chosen.

mod articulated;
mod base_parameter_cache;
mod base_parameters;
mod body_joint;
mod centroidal;
mod common_axes;
mod contents;
mod derivatives;
mod energies;
pub(crate) mod expressions;
mod formulation;
mod frames;
pub(crate) mod geometry;
mod inertia;
mod inertia_ratio;
mod inverse_dynamics;
mod joint_columns;
mod kinematics;
mod mass_matrix;
mod motion;
mod names;
mod plan;
pub(super) mod plan_search;
mod plans;
pub(super) mod regressor;
mod rotation;
mod rotors;
mod standard_parameters;

pub(super) use articulated::Articulated;
pub(super) use centroidal::geometry_of_momenta;
pub(super) use common_axes::CommonAxes;
pub(super) use formulation::Recursion;
pub(super) use regressor::ParameterColumns;
pub(super) use standard_parameters::OwnInertia;

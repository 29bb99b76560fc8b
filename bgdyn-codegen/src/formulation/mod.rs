//! Formulations: regroupings of equation (6), each of which computes the methods from the bond graph.
//!
//! One file or folder each, one line each in [`FORMULATIONS`]. The literal sum is the specification; the
//! others must equal it. A formulation receives the mechanism as [`Prepared`], makes an [`Offer`] for each
//! method, and creates the function. `choice/` chooses among the functions, by cost and by the errors that
//! `conditioning/` measures; formulations depend on neither.

mod actuators;
mod arguments;
mod base_twist;
mod closed_loops;
mod closing_loads;
mod contacts;
mod definition;
mod derivatives;
mod elimination;
mod joint_motion;
mod literal;
mod loop_methods;
mod loop_rows;
mod loops;
mod operational;
mod placed_sites;
mod placement;
mod prepared;
mod prescribed;
mod recursion;
mod site;
mod slopes;
mod solve;
mod subspaces;
mod velocity_map;

pub(crate) use actuators::solve_square;

use crate::bond_graph::BondGraph;
use crate::expr::{Graph, Signed};
pub(crate) use contacts::PairFrame;
pub use definition::{Formulation, Offer};
pub(crate) use derivatives::rates_along;
pub(crate) use joint_motion::{pose_in_joint, position_rates, unit_tangents};
pub use prepared::Prepared;
pub(crate) use prepared::{Candidate, Candidates};
pub(crate) use prescribed::create;
pub(crate) use recursion::expressions::mass_and_bias;
pub(crate) use recursion::geometry;
pub(crate) use recursion::regressor::base_parameter_formulas;
pub(crate) use solve::ltdl as solve_symmetric;
pub use velocity_map::RowChoice;
pub(crate) use velocity_map::velocity_map;

/// The name of the literal sum.
pub(crate) const LITERAL: &str = literal::NAME;

/// All formulations that the user can select.
pub static FORMULATIONS: [&dyn Formulation; 7] = [
    &literal::Literal,
    &recursion::Recursion,
    &recursion::OwnInertia,
    &recursion::CommonAxes,
    &recursion::Articulated::Own,
    &recursion::Articulated::Base,
    &subspaces::Subspaces,
];

/// Formulations that use functions chosen for other methods, or for the open tree of a mechanism with loops. They
/// make offers for any selected formulation, because those functions belong to it; or the only formulations of methods, as
/// that of regressors.
pub(crate) static DERIVED: [&dyn Formulation; 14] = [
    &loops::Elimination,
    &base_twist::BaseTwist(0),
    &base_twist::BaseTwist(1),
    &base_twist::BaseTwist(2),
    &closed_loops::ClosedLoops,
    &derivatives::Differentiated,
    &derivatives::ForwardDynamicsDerivatives,
    &derivatives::AlongDirections,
    &derivatives::ByParameters,
    &contacts::PlacedContacts,
    &operational::ByDrives,
    &operational::Factored,
    &recursion::ParameterColumns,
    &derivatives::MassMatrixRate,
];

/// Returns the expressions of the mass matrix, its lower triangle, and then of the bias, for joints of any type.
pub(crate) fn mass_and_bias_of_any_joint(graph: &BondGraph) -> (Graph, Vec<Signed>) {
    let released = graph.released.as_deref();
    let made = released.and_then(|r| prescribed::mass_and_bias(&subspaces::Subspaces, r));
    let made = made.or_else(|| loops::mass_and_bias(&subspaces::Subspaces, graph));
    made.unwrap_or_else(|| subspaces::mass_and_bias(graph))
}

/// Returns the literal sum of equation (6), which every other formulation must equal.
pub fn specification() -> &'static dyn Formulation {
    &literal::Literal
}

/// Returns the formulation of regressors.
pub(crate) fn columns() -> &'static dyn Formulation {
    &recursion::ParameterColumns
}

/// Returns the formulation with this name.
pub fn by_name(name: &str) -> Option<&'static dyn Formulation> {
    FORMULATIONS.into_iter().find(|f| f.name() == name)
}

//! Formulations: equation (6) regrouped, each a way to compute the methods from the bond graph.
//!
//! One file or folder each, one line each in [`FORMULATIONS`]. The literal sum is the
//! specification; the others must equal it. A formulation gets the mechanism [`Prepared`], makes an
//! [`Offer`] for each method, and writes the function. What is taken is decided in `choice/`, by cost
//! and by the errors that `conditioning/` measures: nothing here knows either.

mod arguments;
mod definition;
mod derivatives;
mod literal;
mod placement;
mod prepared;
mod recursion;
mod site;
mod solve;

pub use definition::{Formulation, Offer};
pub use prepared::Prepared;
pub(crate) use prepared::{Candidate, Candidates};
pub(crate) use recursion::expressions::mass_and_bias;
pub(crate) use recursion::geometry;
pub(crate) use solve::ltdl as solve_symmetric;

/// The name of the literal sum.
pub(crate) const LITERAL: &str = literal::NAME;

/// Every formulation that can be asked for.
pub static FORMULATIONS: [&dyn Formulation; 6] = [
    &literal::Literal,
    &recursion::Recursion,
    &recursion::OwnInertia,
    &recursion::CommonAxes,
    &recursion::Articulated::Own,
    &recursion::Articulated::Base,
];

/// Formulations that differentiate the functions chosen for other methods. They offer themselves
/// whichever formulation is asked for, as those functions are that one's.
pub(crate) static DERIVED: [&dyn Formulation; 2] = [
    &derivatives::Differentiated,
    &derivatives::ForwardDynamicsDerivatives,
];

/// The literal sum of equation (6), which every other formulation must equal.
pub fn specification() -> &'static dyn Formulation {
    &literal::Literal
}

/// The formulation with this name.
pub fn by_name(name: &str) -> Option<&'static dyn Formulation> {
    FORMULATIONS.into_iter().find(|f| f.name() == name)
}

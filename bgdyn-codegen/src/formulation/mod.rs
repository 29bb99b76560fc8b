//! Formulations: equation (6) regrouped, each a way to compute the methods from the bond graph.
//!
//! One file or folder each, one line each in [`FORMULATIONS`]. The literal sum is the
//! specification; the others must equal it, and the cheapest is found by counting, for each
//! mechanism and each method. `conditioning/` measures their errors.

mod accurate;
mod arguments;
pub mod conditioning;
mod derivatives;
mod literal;
mod placement;
mod recursion;
mod search;
mod site;
mod solve;

pub use search::Search;

use crate::expr::{Builder, Ex};
use crate::function::Function;
use crate::method::Method;
pub use accurate::most_accurate;

/// A way to compute methods from the bond graph.
pub trait Formulation: Sync {
    /// The name by which it is chosen.
    fn name(&self) -> &'static str;

    /// One line: how it groups equation (6).
    fn summary(&self) -> &'static str;

    /// Whether it knows the method, or what the method is derived from.
    fn knows(&self, _: Method) -> bool {
        true
    }

    /// The method's function; `None` where this formulation does not know the method.
    fn function(&self, search: &Search<'_>, method: Method) -> Option<Function>;
}

impl std::fmt::Debug for dyn Formulation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// Every formulation there is.
pub static FORMULATIONS: [&dyn Formulation; 6] = [
    &literal::Literal,
    &recursion::Recursion,
    &recursion::OwnInertia,
    &recursion::CommonAxes,
    &recursion::Articulated::Own,
    &recursion::Articulated::Base,
];

/// The literal sum of equation (6), which every other formulation must equal.
pub fn specification() -> &'static dyn Formulation {
    &literal::Literal
}

/// The formulation with this name.
pub fn by_name(name: &str) -> Option<&'static dyn Formulation> {
    FORMULATIONS.into_iter().find(|f| f.name() == name)
}

/// Solves M x = f for a symmetric M, given by its lower triangle; every pivot is checked.
pub(crate) fn solve_symmetric<'g>(
    b: &'g Builder,
    mass: Vec<Vec<Ex<'g>>>,
    f: Vec<Ex<'g>>,
) -> Vec<Ex<'g>> {
    solve::ltdl(b, mass, f)
}

//! The trait of formulations: name, offer for each method, functions.

use super::prepared::Prepared;
use crate::bond_graph::{BondGraph, LinkFrame, Multibody};
use crate::function::Function;
use crate::method::Method;

/// A way to compute methods from the bond graph.
pub trait Formulation: Sync {
    /// Returns its name, by which the user can select it.
    fn name(&self) -> &'static str;

    /// Returns one line: how it groups equation (6).
    fn summary(&self) -> &'static str;

    /// Returns whether it only combines functions of other methods ([`Formulation::reads`]): it knows the methods for which
    /// it reads some, and serves the joints and the loops that these functions serve.
    fn combines(&self) -> bool {
        false
    }

    /// Returns whether its forward dynamics eliminates with the factors of the mass matrix.
    fn factors_mass(&self) -> bool {
        true
    }

    /// Returns whether it supports the method, or the method that this one is derived from.
    fn knows(&self, method: Method) -> bool {
        match self.combines() {
            true => !self.reads(method).is_empty(),
            false => !method.is_derived(),
        }
    }

    /// Returns the first link whose joint it does not serve. By default it serves rotations and translations
    /// that follow no other joint.
    fn unserved<'a>(&self, graph: &'a Multibody) -> Option<&'a LinkFrame> {
        match self.combines() {
            true => None,
            false => graph.first_compound(),
        }
    }

    /// Returns whether it serves mechanisms with loops. Other formulations serve their open tree.
    fn serves_loops(&self) -> bool {
        self.combines()
    }

    /// Returns whether it serves this mechanism.
    fn serves(&self, graph: &BondGraph) -> bool {
        (self.serves_loops() || graph.closed.is_none()) && self.unserved(graph).is_none()
    }

    /// Returns its offer for a method that it supports, if no formulation is selected.
    fn offer(&self, _: &Prepared<'_>, _: Method) -> Offer {
        Offer::Candidate
    }

    /// Returns the other methods whose functions it uses: [`Prepared::function`] returns them when
    /// [`Formulation::function`] is called.
    fn reads(&self, _: Method) -> Vec<Method> {
        Vec::new()
    }

    /// Returns the methods of the open tree whose functions it uses, for mechanisms with loops:
    /// [`Prepared::tree_function`] returns them when [`Formulation::function`] is called.
    fn reads_of_tree(&self, _: Method) -> Vec<Method> {
        Vec::new()
    }

    /// Returns the methods of the open tree with masses moved across pins whose functions it uses:
    /// [`Prepared::moved_tree_function`] returns them when [`Formulation::function`] is called.
    fn reads_of_moved_tree(&self, _: Method) -> Vec<Method> {
        Vec::new()
    }

    /// Returns the methods of the open tree on a free base whose functions it uses, each with the index of the base:
    /// [`Prepared::function_on_free_base`] returns them when [`Formulation::function`] is called.
    fn reads_of_free_base(&self, _: Method) -> Vec<(usize, Method)> {
        Vec::new()
    }

    /// Returns whether it computes dependent positions of loops from the independent ones, instead of reading them.
    fn closes_loops(&self) -> bool {
        false
    }

    /// Returns further functions of the method, for bundles: by themselves they may cost more, but they share expressions
    /// with functions of the `others`.
    fn sharing(&self, _: &Prepared<'_>, _: Method, _others: &[Method]) -> Vec<Function> {
        Vec::new()
    }

    /// Returns the method's function; `None` if this formulation cannot create it for this mechanism, which has no
    /// prescribed joints unless [`Formulation::reads`] names other methods.
    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function>;
}

impl std::fmt::Debug for dyn Formulation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// The offer of a formulation for one method of one mechanism.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Offer {
    /// Created only if selected by name.
    Never,
    /// Created if no other function, not even a reserve, meets the error bounds.
    LastResort,
    /// Created if no candidate meets the error bounds, or if there is none.
    Reserve,
    /// Created and compared with the other candidates.
    Candidate,
    /// Created in place of the candidates; with the reason, if it is of interest to readers of the
    /// function.
    Instead(Option<String>),
}

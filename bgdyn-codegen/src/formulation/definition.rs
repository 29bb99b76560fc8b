//! What a formulation is: its name, its offer for each method, its functions.

use super::prepared::Prepared;
use crate::function::Function;
use crate::method::Method;

/// A way to compute methods from the bond graph.
pub trait Formulation: Sync {
    /// The name by which it is asked for.
    fn name(&self) -> &'static str;

    /// One line: how it groups equation (6).
    fn summary(&self) -> &'static str;

    /// Whether it knows the method, or what the method is derived from.
    fn knows(&self, _: Method) -> bool {
        true
    }

    /// How it offers itself for a method that it knows, where no formulation is asked for.
    fn offer(&self, prepared: &Prepared<'_>, method: Method) -> Offer;

    /// The other methods whose functions it is made of: [`Prepared::function`] has them when
    /// [`Formulation::function`] is called.
    fn reads(&self, _: Method) -> &'static [Method] {
        &[]
    }

    /// The method's function; `None` where this formulation does not make it for this mechanism.
    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function>;
}

impl std::fmt::Debug for dyn Formulation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// How a formulation offers itself for one method of one mechanism.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Offer {
    /// Made only where it is asked for by name.
    Never,
    /// Made where nothing else keeps its digits, not even a reserve.
    LastResort,
    /// Made where no candidate keeps its digits, or where there is none.
    Reserve,
    /// Made and compared with the other candidates.
    Candidate,
    /// Made in place of the candidates; why, where a reader of the function should know.
    Instead(Option<String>),
}

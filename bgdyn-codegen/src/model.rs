//! A mechanism with its bond graph and the functions generated for it.

use crate::bond_graph::BondGraph;
use crate::function::Function;
use crate::mechanism::Mechanism;
use crate::method::Method;

/// A mechanism with the functions generated for it.
pub struct Model {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// Its bond graph.
    pub bond_graph: BondGraph,
    /// Whether the module has `assemble`.
    pub assembles: bool,
    /// One function per generated method.
    pub functions: Vec<Function>,
}

impl Model {
    /// Returns the function of a method.
    pub fn function(&self, method: Method) -> Option<&Function> {
        self.functions.iter().find(|f| f.method == method)
    }
}

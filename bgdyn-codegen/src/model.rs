//! A mechanism with its bond graph and the functions generated for it.

use std::ops::Range;

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
    /// Functions with the results of several methods.
    pub bundles: Vec<Bundle>,
}

/// The results of several methods by one function.
#[derive(Clone, Debug)]
pub struct Bundle {
    /// The function: its results are those of its parts, one after the other.
    pub function: Function,
    /// The methods in the order in which they were asked for.
    pub parts: Vec<BundlePart>,
}

/// A method of a bundle.
#[derive(Clone, Debug)]
pub struct BundlePart {
    /// The method.
    pub method: Method,
    /// Its name in the generated code.
    pub name: String,
    /// Its results among those of the bundle.
    pub outputs: Range<usize>,
}

impl Bundle {
    /// Returns the function of a part: the code of the bundle with the results of this part alone.
    pub fn function_of(&self, part: &BundlePart) -> Function {
        let mut function = Function {
            method: part.method,
            name: format!("{} of {}", part.name, self.function.name()),
            ..self.function.clone()
        };
        if let Some(last) = function.blocks.last_mut() {
            last.outputs = last.outputs[part.outputs.clone()].to_vec();
        }
        function
    }
}

impl Model {
    /// Returns the function of a method.
    pub fn function(&self, method: Method) -> Option<&Function> {
        self.functions.iter().find(|f| f.method == method)
    }
}

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
    /// The base parameters as formulas of the parameters of the bodies, if a method has columns or elements for them.
    pub base_parameters: Vec<String>,
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
    /// Returns whether a method, or a part of a bundle, has columns or elements for parameters of the bodies.
    pub fn has_regressors(&self) -> bool {
        let mut methods = self.all_methods();
        methods.any(Method::has_body_parameters)
    }

    /// Returns the methods of the functions, and those that are parts of bundles.
    pub fn all_methods(&self) -> impl Iterator<Item = Method> {
        let parts = self.bundles.iter().flat_map(|bundle| &bundle.parts);
        let methods = self.functions.iter().map(|f| f.method);
        methods.chain(parts.map(|part| part.method))
    }

    /// Returns the names of the contacts, if it has a method of them; else none.
    pub fn contact_names(&self) -> Vec<&str> {
        let has = self.all_methods().any(|m| matches!(m, Method::Contact(_)));
        let pairs = self.mechanism.contact_pairs().iter().filter(|_| has);
        pairs.map(|pair| pair.name.as_str()).collect()
    }

    /// Returns the names of the bodies whose parameters regressors have.
    pub fn body_names(&self) -> Vec<&str> {
        let links = self.bond_graph.moving_links().into_iter();
        let frames = &self.bond_graph.frames;
        links.map(|link| frames[link.0].name.as_str()).collect()
    }

    /// Returns the function of a method.
    pub fn function(&self, method: Method) -> Option<&Function> {
        self.functions.iter().find(|f| f.method == method)
    }
}

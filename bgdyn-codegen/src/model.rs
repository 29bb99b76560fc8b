//! The steps in order: from a spec's text to a model, from a model to code.

use std::path::Path;
use std::rc::Rc;

use proc_macro2::TokenStream;

use crate::bond_graph::{self, BondGraph};
use crate::cut::cut;
use crate::emit;
use crate::fault::Faults;
use crate::formulation::Search;
use crate::function::Function;
use crate::interface::Interface;
use crate::mechanism::Mechanism;
use crate::method::Method;
pub use crate::options::{DYNAMICS, List, Options, Unknown, formulation_named};

/// A mechanism with the functions generated for it.
pub struct Model {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// Its bond graph.
    pub bond_graph: BondGraph,
    /// One function per method generated.
    pub functions: Vec<Function>,
}

impl Model {
    /// Builds the bond graph and chooses a function for each method asked for.
    ///
    /// # Errors
    /// Every name asked for that the mechanism does not have.
    pub fn new(mechanism: Mechanism, options: &Options) -> Result<Self, Vec<Unknown>> {
        let bond_graph = bond_graph::build(&mechanism);
        let methods = options.select(&bond_graph.sites, bond_graph.coordinates.len())?;
        let search = Search::new(&bond_graph, options.formulation);
        let found = methods.into_iter().filter_map(|m| search.function(m));
        let found: Vec<Rc<Function>> = found.collect();
        drop(search);
        let functions = found.into_iter().map(Rc::unwrap_or_clone).map(cut);
        let functions = functions.collect();
        Ok(Model {
            mechanism,
            bond_graph,
            functions,
        })
    }

    /// The function of a method.
    pub fn function(&self, method: Method) -> Option<&Function> {
        self.functions.iter().find(|f| f.method == method)
    }
}

/// One function of a mechanism, without the others.
pub fn function(mechanism: &Mechanism, method: Method, options: &Options) -> Option<Function> {
    let graph = bond_graph::build(mechanism);
    let found = Search::new(&graph, options.formulation).function(method)?;
    Some(cut(Rc::unwrap_or_clone(found)))
}

/// Why there is no module.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// What is wrong with the spec.
    Spec(Faults),
    /// Names asked for that the mechanism does not have.
    Options(Vec<Unknown>),
}

/// From a spec's text to the tokens of its module, with warnings if there are any. `stem` is the
/// file's stem, `place` says where and from what the code is generated.
///
/// # Errors
/// Every fault found in the spec; or, where it has none, every name asked for that it lacks.
pub fn generate(
    text: &str,
    stem: &str,
    place: &emit::Place,
    options: &Options,
) -> Result<(TokenStream, Faults), Refusal> {
    let (mechanism, findings) = crate::read(text, Some(stem));
    let Some(mechanism) = mechanism else {
        return Err(Refusal::Spec(findings));
    };
    let model = Model::new(mechanism, options).map_err(Refusal::Options)?;
    Ok((emit::module(&model, place), findings))
}

/// The module of a refused spec, or of one that could not be read (`text` is empty then): all a
/// caller can name, nothing that runs. Nothing where the stem cannot name a module.
pub fn fallback(text: &str, stem: &str, place: &emit::Place) -> Option<TokenStream> {
    Interface::guess(text, stem).map(|interface| emit::fallback(&interface, place))
}

/// The name of a spec's module: the file's name up to its first dot.
pub fn stem(path: &Path) -> String {
    let name = path.file_name().map(|n| n.to_string_lossy());
    let stem = name.as_deref().and_then(|n| n.split('.').next());
    stem.unwrap_or_default().to_string()
}

//! The steps in order: from a spec's text to a model, from a model to code.

use proc_macro2::TokenStream;

use crate::bond_graph::{self, BondGraph, SiteId};
use crate::cut::cut;
use crate::emit;
use crate::fault::Faults;
use crate::formulation::{self, Formulation};
use crate::function::Function;
use crate::interface::Interface;
use crate::mechanism::Mechanism;
use crate::method::Method;

/// What the caller may ask for.
#[derive(Clone, Copy, Default)]
pub struct Options {
    /// The formulation to use for every method; the cheapest of each where `None`.
    pub formulation: Option<&'static dyn Formulation>,
    /// Whether first derivatives of inverse and forward dynamics are wanted.
    pub derivatives: bool,
}

/// Velocities beyond which the Coriolis matrix comes only to those who ask: its code grows with
/// the square of their number.
const COMPACT: usize = 16;

impl Options {
    /// The methods to generate.
    fn methods(&self, graph: &BondGraph) -> Vec<Method> {
        let mut methods = Method::ALL.to_vec();
        if graph.coordinates.len() <= COMPACT {
            methods.push(Method::CoriolisMatrix);
        }
        if self.derivatives {
            methods.push(Method::InverseDynamicsDerivatives);
            methods.push(Method::ForwardDynamicsDerivatives);
        }
        let prominent = (0..graph.sites.len()).filter(|&i| graph.sites[i].prominent);
        methods.extend(prominent.flat_map(|i| Method::of_site(SiteId(i))));
        methods
    }
}

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
    /// Builds the bond graph and chooses a function for each method.
    pub fn new(mechanism: Mechanism, options: &Options) -> Self {
        let bond_graph = bond_graph::build(&mechanism);
        let function = |method| function_of(&bond_graph, method, options);
        let functions = options
            .methods(&bond_graph)
            .into_iter()
            .filter_map(function)
            .collect();
        Model {
            mechanism,
            bond_graph,
            functions,
        }
    }

    /// The function of a method.
    pub fn function(&self, method: Method) -> Option<&Function> {
        self.functions.iter().find(|f| f.method == method)
    }
}

/// One function of a mechanism, without the others.
pub fn function(mechanism: &Mechanism, method: Method, options: &Options) -> Option<Function> {
    function_of(&bond_graph::build(mechanism), method, options)
}

fn function_of(graph: &BondGraph, method: Method, options: &Options) -> Option<Function> {
    formulation::choose(graph, method, options.formulation).map(cut)
}

/// From a spec's text to the tokens of its module. `stem` is the file's stem, `place` says where
/// and from what the code is generated.
///
/// # Errors
/// Every fault found in the spec.
pub fn generate(
    text: &str,
    stem: &str,
    place: &emit::Place,
    options: &Options,
) -> Result<TokenStream, Faults> {
    let (mechanism, faults) = crate::read(text, Some(stem));
    let mechanism = mechanism.ok_or(faults)?;
    let model = Model::new(mechanism, options);
    Ok(emit::module(&model, place))
}

/// The module of a refused spec, or of one that could not be read (`text` is empty then): all a
/// caller can name, nothing that runs. Nothing where the stem cannot name a module.
pub fn fallback(text: &str, stem: &str, place: &emit::Place) -> Option<TokenStream> {
    Interface::guess(text, stem).map(|interface| emit::fallback(&interface, place))
}

/// [`generate`] as formatted source text.
///
/// # Errors
/// Every fault found in the spec.
#[cfg(feature = "source")]
pub fn generate_source(
    text: &str,
    stem: &str,
    place: &emit::Place,
    options: &Options,
) -> Result<String, Faults> {
    let tokens = generate(text, stem, place, options)?;
    let file = syn::parse2(tokens).expect("the emitter writes valid Rust");
    Ok(prettyplease::unparse(&file))
}

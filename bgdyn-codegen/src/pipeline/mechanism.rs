//! Converts a mechanism's text to a model and to tokens, step by step.

use proc_macro2::TokenStream;

use crate::bond_graph;
use crate::choice::{Choice, prefer};
use crate::emit;
use crate::fault::Faults;
use crate::function::Function;
use crate::mechanism::Mechanism;
use crate::method::Method;
use crate::model::Model;
use crate::options::{Options, UnknownName};
use crate::read::read;
use crate::refusal::Refusal;
use crate::verify::check_functions;

/// Converts a mechanism's text to the tokens of its module; see [`super::generate_file`].
///
/// # Errors
/// Every fault in the spec; or, if there is none, every requested name that it does not have.
pub fn generate(
    text: &str,
    stem: &str,
    output: &emit::OutputOptions,
    options: &Options,
) -> Result<(TokenStream, Faults), Refusal> {
    let (model, findings) = checked_model(text, stem, options)?;
    Ok((emit::module(&model, output), findings))
}

/// Converts a mechanism's text to its model, compared with equation (6), with its warnings.
pub(super) fn checked_model(
    text: &str,
    stem: &str,
    options: &Options,
) -> Result<(Model, Faults), Refusal> {
    let (mechanism, findings) = read(text, Some(stem));
    let Some(mechanism) = mechanism else {
        return Err(Refusal::Spec(findings));
    };
    let model = model(mechanism, options).map_err(Refusal::Options)?;
    verify(&model, options)?;
    Ok((model, findings))
}

/// Compares the model's functions with equation (6), unless the options leave that out.
///
/// # Errors
/// [`Refusal::Unequal`] with every difference.
pub fn verify(model: &Model, options: &Options) -> Result<(), Refusal> {
    if !options.verify {
        return Ok(());
    }
    let name = model.mechanism.name();
    Refusal::unless_equal(check_functions(name, &model.bond_graph, &model.functions))
}

/// Builds the bond graph of a mechanism and chooses a function for each selected method.
///
/// # Errors
/// Every requested name that the mechanism does not have.
pub fn model(mechanism: Mechanism, options: &Options) -> Result<Model, Vec<UnknownName>> {
    let bond_graph = bond_graph::build(&mechanism);
    options.check_formulation(&bond_graph)?;
    let methods = options.select(&bond_graph)?;
    let choice = Choice::new(&bond_graph, options.formulation);
    let chosen = methods
        .into_iter()
        .filter_map(|method| prefer(&choice, method, options.prefer));
    let functions = chosen.map(|f| named(f, &bond_graph)).collect();
    drop(choice);
    Ok(Model {
        assembles: options.assembles(&bond_graph),
        mechanism,
        bond_graph,
        functions,
    })
}

/// Returns one function of a mechanism, without the others; `None` if the selected formulation does not
/// compute the method, or does not serve the mechanism.
pub fn function(mechanism: &Mechanism, method: Method, options: &Options) -> Option<Function> {
    let graph = bond_graph::build(mechanism);
    options.check_formulation(&graph).ok()?;
    let choice = Choice::new(&graph, options.formulation);
    prefer(&choice, method, options.prefer).map(|function| named(function, &graph))
}

/// Returns the function with its name in the module of this mechanism.
fn named(function: Function, graph: &bond_graph::BondGraph) -> Function {
    let name = function
        .method
        .name_in(graph.closed.as_deref(), &graph.sites);
    Function { name, ..function }
}

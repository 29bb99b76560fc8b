//! A mechanism: its text to a model and to tokens, step by step.

use std::rc::Rc;

use proc_macro2::TokenStream;

use crate::fault::Faults;
use crate::formulation::{Search, most_accurate};
use crate::function::Function;
use crate::mechanism::Mechanism;
use crate::method::Method;
use crate::model::Model;
use crate::options::{Options, Preference, Unknown};
use crate::passes::{finish, finish_in_order};
use crate::read::read;
use crate::refusal::Refusal;
use crate::verify::check_functions;
use crate::{bond_graph, emit};

/// From a mechanism's text to the tokens of its module; see [`super::generate_file`].
///
/// # Errors
/// Every fault found in the spec; or, where it has none, every name asked for that it lacks.
pub fn generate(
    text: &str,
    stem: &str,
    place: &emit::OutputOptions,
    options: &Options,
) -> Result<(TokenStream, Faults), Refusal> {
    let (mechanism, findings) = read(text, Some(stem));
    let Some(mechanism) = mechanism else {
        return Err(Refusal::Spec(findings));
    };
    let model = model(mechanism, options).map_err(Refusal::Options)?;
    if options.verify {
        let name = model.mechanism.name();
        Refusal::unless_equal(check_functions(name, &model.bond_graph, &model.functions))?;
    }
    Ok((emit::module(&model, place), findings))
}

/// Builds the bond graph of a mechanism and chooses a function for each method asked for.
///
/// # Errors
/// Every name asked for that the mechanism does not have.
pub fn model(mechanism: Mechanism, options: &Options) -> Result<Model, Vec<Unknown>> {
    let bond_graph = bond_graph::build(&mechanism);
    let methods = options.select(&bond_graph.sites, bond_graph.coordinates.len())?;
    let search = Search::new(&bond_graph, options.formulation);
    let functions = methods.into_iter();
    let functions = functions
        .filter_map(|m| chosen(&search, m, options))
        .collect();
    drop(search);
    Ok(Model {
        mechanism,
        bond_graph,
        functions,
    })
}

/// One function of a mechanism, without the others.
pub fn function(mechanism: &Mechanism, method: Method, options: &Options) -> Option<Function> {
    let graph = bond_graph::build(mechanism);
    chosen(&Search::new(&graph, options.formulation), method, options)
}

/// The function of a method that these options mean.
fn chosen(search: &Search<'_>, method: Method, options: &Options) -> Option<Function> {
    match options.prefer {
        Preference::Operations => search
            .function(method)
            .map(|f| finish(Rc::unwrap_or_clone(f))),
        Preference::Accuracy => {
            most_accurate(search.graph, method, options.formulation).map(finish_in_order)
        }
    }
}

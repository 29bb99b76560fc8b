//! The steps in order: from a spec's text to a model, from a model to tokens.

use std::path::Path;
use std::rc::Rc;

use proc_macro2::TokenStream;

use crate::bond_graph;
use crate::cut::cut;
use crate::emit;
use crate::fault::Faults;
use crate::files::{mechanism_of, stem as stem_of};
use crate::formulation::{self, Search};
use crate::function::Function;
use crate::interface::{Interface, SceneInterface};
use crate::mechanism::Mechanism;
use crate::method::Method;
use crate::model::Model;
use crate::options::{Options, Preference, Unknown};
use crate::read::{read, read_scene};
use crate::refusal::Refusal;
use crate::spec::is_scene;
use crate::system::System;
use crate::verify::{Difference, check_functions, check_scene};

/// From a spec's text to the tokens of its module, with warnings if there are any. `stem` is the
/// file's stem, `place` says where and from what the code is generated.
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
        equal(check_functions(name, &model.bond_graph, &model.functions))?;
    }
    Ok((emit::module(&model, place), findings))
}

/// The same for a file that may be a mechanism's or a scene's. A scene's mechanism is read by
/// `load`, from the path that the scene writes.
///
/// # Errors
/// As [`generate`], and as [`read_scene`].
pub fn generate_file(
    text: &str,
    stem: &str,
    place: &emit::OutputOptions,
    options: &Options,
    load: impl FnOnce(&str) -> Result<String, String>,
) -> Result<(TokenStream, Faults), Refusal> {
    if !is_scene(text) {
        return generate(text, stem, place, options);
    }
    let (system, findings) = read_scene(text, stem, load)?;
    let misplaced = options.of_mechanisms();
    if !misplaced.is_empty() {
        return Err(Refusal::Options(misplaced));
    }
    let functions = scene_functions(&system, options);
    if options.verify {
        equal(check_scene(&system, &functions))?;
    }
    Ok((emit::scene_module(&system, &functions, place), findings))
}

fn equal(differences: Vec<Difference>) -> Result<(), Refusal> {
    match differences.is_empty() {
        true => Ok(()),
        false => Err(Refusal::Unequal(differences)),
    }
}

/// The module of a refused spec, or of one that could not be read (`text` is empty then): all a
/// caller can name, nothing that runs. `load` gives the text of a scene's mechanism. Nothing where the
/// stem cannot name a module.
pub fn fallback(
    text: &str,
    stem: &str,
    place: &emit::OutputOptions,
    load: impl FnOnce(&str) -> Result<String, String>,
) -> Option<TokenStream> {
    if is_scene(text) {
        let path = mechanism_of(text).unwrap_or_default();
        let written = load(&path).ok();
        let of = stem_of(Path::new(&path));
        let mechanism = written.as_deref().map(|written| (written, of.as_str()));
        let scene = SceneInterface::guess(text, stem, mechanism);
        return scene.map(|scene| emit::scene_fallback(&scene, place));
    }
    Interface::guess(text, stem).map(|interface| emit::fallback(&interface, place))
}

/// Builds the bond graph of a mechanism and chooses a function for each method asked for.
///
/// # Errors
/// Every name asked for that the mechanism does not have.
pub fn model(mechanism: Mechanism, options: &Options) -> Result<Model, Vec<Unknown>> {
    let bond_graph = bond_graph::build(&mechanism);
    let methods = options.select(&bond_graph.sites, bond_graph.coordinates.len())?;
    let search = Search::new(&bond_graph, options.formulation);
    let found = methods
        .into_iter()
        .filter_map(|m| chosen(&search, m, options));
    let found: Vec<Function> = found.collect();
    drop(search);
    let functions = found.into_iter().map(|f| finished(f, options)).collect();
    Ok(Model {
        mechanism,
        bond_graph,
        functions,
    })
}

/// One function of a mechanism, without the others.
pub fn function(mechanism: &Mechanism, method: Method, options: &Options) -> Option<Function> {
    let graph = bond_graph::build(mechanism);
    let chosen = chosen(&Search::new(&graph, options.formulation), method, options);
    chosen.map(|f| finished(f, options))
}

/// The functions of a scene: the usual ones, what its method of integration needs, and what is
/// asked for.
pub fn scene_functions(system: &System, options: &Options) -> Vec<Function> {
    let roles = system.roles_with(options.jacobian, options.canonical);
    let roles = roles.into_iter();
    roles.map(|role| system.function(role)).collect()
}

/// The function of a method that these options mean.
fn chosen(search: &Search<'_>, method: Method, options: &Options) -> Option<Function> {
    match options.prefer {
        Preference::Operations => search.function(method).map(Rc::unwrap_or_clone),
        Preference::Accuracy => {
            formulation::most_accurate(search.graph, method, options.formulation)
        }
    }
}

/// The last passes. What was chosen for its digits keeps the order of its sums: among more orders the
/// choice would go by chance.
fn finished(function: Function, options: &Options) -> Function {
    let function = match options.prefer {
        Preference::Operations => function.arranged(),
        Preference::Accuracy => function,
    };
    cut(function.fused())
}

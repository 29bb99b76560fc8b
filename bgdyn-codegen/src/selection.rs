//! The functions of a mechanism or of a scene that the options select, each by its cheapest formulation.

use crate::bond_graph::{self, BondGraph};
use crate::bundle::bundle;
use crate::choice::{Choice, prefer};
use crate::function::Function;
use crate::mechanism::Mechanism;
use crate::method::{Method, SceneFunction};
use crate::model::{Bundle, Model};
use crate::options::{Options, UnknownName};
use crate::system::SceneEquations;

/// Builds the bond graph of a mechanism and chooses a function for each selected method.
///
/// # Errors
/// Every requested name that the mechanism does not have.
pub fn model(mechanism: Mechanism, options: &Options) -> Result<Model, Vec<UnknownName>> {
    let bond_graph = bond_graph::build(&mechanism);
    options.check_formulation(&bond_graph)?;
    let asked = options.select(&bond_graph);
    let (methods, bundles) = match (asked, options.select_bundles(&bond_graph, mechanism.name())) {
        (Ok(methods), Ok(bundles)) => (methods, bundles),
        (methods, bundles) => {
            let wrong = methods.err().into_iter().chain(bundles.err());
            return Err(wrong.flatten().collect());
        }
    };
    let choice = Choice::new(&bond_graph, options.formulation);
    let chosen = methods
        .into_iter()
        .filter_map(|method| prefer(&choice, method, options.prefer));
    let functions: Vec<Function> = chosen.map(|f| named(f, &bond_graph)).collect();
    let bundles = bundles.iter().filter_map(|(name, methods)| {
        bundle(&choice, &bond_graph, (name, methods), options.prefer)
    });
    let bundles: Vec<Bundle> = bundles.collect();
    let parts = bundles.iter().flat_map(|bundle| &bundle.parts);
    let all = functions.iter().map(|f| f.method);
    let mut all = all.chain(parts.map(|part| part.method));
    let has_regressors = all.any(Method::has_body_parameters);
    let base_parameters = match has_regressors {
        true => choice.base_parameter_formulas(),
        false => Vec::new(),
    };
    drop(choice);
    Ok(Model {
        assembles: options.assembles(&bond_graph),
        mechanism,
        bond_graph,
        functions,
        bundles,
        base_parameters,
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
fn named(function: Function, graph: &BondGraph) -> Function {
    let name = function
        .method
        .name_in(graph.closed.as_deref(), &graph.sites);
    Function { name, ..function }
}

/// Returns the functions of a scene: the default ones, those that its integrator needs, and those that the
/// options select.
pub fn scene_functions(equations: &SceneEquations, options: &Options) -> Vec<Function> {
    let mut roles = equations.roles_with(options.jacobian, options.canonical);
    if options.input_jacobian && equations.has_input_jacobian() {
        roles.push(SceneFunction::InputJacobian);
    }
    let roles = roles.into_iter();
    roles.map(|role| equations.function(role)).collect()
}

//! The functions that are compared.

use bgdyn_codegen::bond_graph;
use bgdyn_codegen::choice::{Choice, Preference, prefer};
use bgdyn_codegen::formulation::by_name;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::system::SceneEquations;

/// Mechanisms with more velocities have no derivatives here, and those with more than half as many no regressors, payloads,
/// directions and derivatives by parameters: these are created slowly.
const LARGE: usize = 8;
/// Sites of a mechanism whose functions are compared.
const SITES: usize = 2;

/// Returns the functions of a mechanism by a formulation, or by the generator's choice.
pub fn functions(mechanism: &Mechanism, formulation: Option<&str>) -> Vec<Function> {
    let graph = bond_graph::build(mechanism);
    let formulation = formulation.map(|name| by_name(name).expect("a formulation"));
    let choice = Choice::new(&graph, formulation);
    let slow = [
        Method::CoriolisMatrix,
        Method::MassMatrixRate,
        Method::InverseDynamicsDerivatives,
        Method::ForwardDynamicsDerivatives,
        Method::JointReactions,
    ];
    let methods = Method::possible_of(&graph).into_iter().filter(|method| {
        let sites = if method.is_derived() { 1 } else { SITES };
        let first = method.site().is_none_or(|site| site.0 < sites);
        let is_slow =
            slow.contains(method) || matches!(method, Method::Operational(_) | Method::Contact(_));
        let is_long = method.is_derived() && !is_slow;
        // They have formulations of their own.
        let chosen = formulation.is_none() || !method.is_derived();
        first
            && chosen
            && (mechanism.nv() <= LARGE || !is_slow)
            && (mechanism.nv() <= LARGE / 2 || !is_long)
    });
    methods
        .filter_map(|method| prefer(&choice, method, Preference::default()))
        .collect()
}

/// Returns the functions of a scene.
pub fn scene_functions(system: &SceneEquations) -> Vec<Function> {
    let roles = system.roles_with(true, true).into_iter();
    roles.map(|role| system.function(role)).collect()
}

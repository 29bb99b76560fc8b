//! `prefer: accuracy`: the function that loses the fewest digits in `f64`, whatever it costs.
//!
//! Every formulation that knows the method takes part, factored and not, and is judged at the sampled
//! states. Losses that agree to a tenth of a rounding are equal; then the count decides. To have no answer
//! where another way has one is worse than any error. The literal sum takes part for up to 8 joints, its
//! derivatives for up to 4.

use super::derivatives::by_differentiation;
use super::{FORMULATIONS, Formulation, Search, literal};
use crate::bond_graph::BondGraph;
use crate::formulation::conditioning::rounding_error::{exact_results, rounding_error_at};
use crate::function::Function;
use crate::method::Method;
use crate::passes::factor;

/// Joints up to which the literal sum is tried: its graph grows with the cube of their number.
const LITERAL: usize = 8;

/// The same for methods that come from differentiating it.
const LITERAL_DERIVED: usize = 4;

/// The method's function that loses the fewest digits at the sampled states, by the formulation
/// asked for, where it knows the method, else by any; factored, or with its operations as the
/// formulation has them. Losses that agree to a tenth of a rounding are equal: then operations
/// decide.
pub fn most_accurate(
    graph: &BondGraph,
    method: Method,
    asked: Option<&'static dyn Formulation>,
) -> Option<Function> {
    let asked = asked.filter(|f| f.knows(method));
    let all = FORMULATIONS.into_iter();
    let tried = all.filter(|f| match asked {
        Some(asked) => f.name() == asked.name(),
        None => f.knows(method) && affordable(graph, method, *f),
    });
    let ways: Vec<Function> = tried.flat_map(|f| variants(graph, method, f)).collect();
    let answers = exact_results(&ways, graph);
    ways.into_iter().min_by_key(|way| {
        let lost = rounding_error_at(way, &answers).unwrap_or_default();
        (lost.rank(), way.cost().weighted())
    })
}

fn affordable(graph: &BondGraph, method: Method, formulation: &dyn Formulation) -> bool {
    let most = match method {
        Method::CoriolisMatrix
        | Method::InverseDynamicsDerivatives
        | Method::ForwardDynamicsDerivatives => LITERAL_DERIVED,
        _ => LITERAL,
    };
    formulation.name() != literal::NAME || graph.coordinates.len() <= most
}

/// A formulation's function, factored and not.
fn variants(
    graph: &BondGraph,
    method: Method,
    formulation: &'static dyn Formulation,
) -> Vec<Function> {
    let search = Search::new(graph, Some(formulation));
    let derived = by_differentiation::function(&search, method);
    let Some(plain) = derived.or_else(|| formulation.function(&search, method)) else {
        return Vec::new();
    };
    let factored = factor(plain.clone());
    if factored.operations() == plain.operations() {
        return vec![factored];
    }
    let formulation = format!("{}; not factored", plain.formulation);
    let plain = Function {
        formulation,
        ..plain
    };
    vec![factored, plain]
}

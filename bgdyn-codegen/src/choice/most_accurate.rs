//! Chooses the function that loses the fewest digits in `f64`, at any cost (`prefer: accuracy`).
//!
//! Every formulation that supports the method is a candidate, factored and not factored, and is measured
//! at the sampled states. Errors that agree to a tenth of a rounding count as equal; then the number of
//! operations decides. A failure where another candidate has a result is worse than any error. The literal
//! sum is a candidate for up to 8 joints, its derivatives for up to 4. Loops in closed form are none: towards singular
//! positions they lose digits that elimination keeps (`docs/hard_cases.md`).

use super::choose::Choice;
use crate::bond_graph::BondGraph;
use crate::conditioning::rounding_error::{exact_results, rounding_error_at};
use crate::formulation::{FORMULATIONS, Formulation, LITERAL};
use crate::function::Function;
use crate::method::Method;
use crate::passes::factor;

/// Joints up to which the literal sum is tried: its graph grows with the cube of their number.
const MAX_LITERAL: usize = 8;

/// The same limit for methods that differentiate the literal sum.
const MAX_LITERAL_DERIVED: usize = 4;

/// Returns the method's function that loses the fewest digits at the sampled states: of the selected
/// formulation, if it supports the method, else of any formulation; factored, or with the operations of
/// the formulation. Errors that agree to a tenth of a rounding count as equal; then the number of
/// operations decides.
pub(super) fn most_accurate(
    graph: &BondGraph,
    method: Method,
    asked: Option<&'static dyn Formulation>,
) -> Option<Function> {
    if let Method::Regressor(_) | Method::Payload(_) = method {
        // They have one formulation, whatever the others are.
        let function = Choice::by_elimination(graph, asked).function(method);
        return function.map(|function| (*function).clone());
    }
    let knows = |f: &dyn Formulation| f.knows(method) || method.is_derived();
    let asked = asked.filter(|f| knows(*f));
    let tried = FORMULATIONS.into_iter().filter(|f| match asked {
        Some(asked) => f.name() == asked.name(),
        None => knows(*f) && f.serves(computed(graph)) && is_affordable(graph, method, *f),
    });
    let candidates: Vec<Function> = tried.flat_map(|f| variants(graph, method, f)).collect();
    let exact = exact_results(&candidates, graph);
    candidates.into_iter().min_by_key(|candidate| {
        let error = rounding_error_at(candidate, &exact).unwrap_or_default();
        (error.rank(), candidate.cost().weighted())
    })
}

/// Returns the graph that formulations compute functions of: with loops that of the open tree.
fn computed(graph: &BondGraph) -> &BondGraph {
    graph.closed.as_deref().map_or(graph, |closed| &closed.tree)
}

fn is_affordable(graph: &BondGraph, method: Method, formulation: &dyn Formulation) -> bool {
    let most = match method {
        Method::CoriolisMatrix | Method::MassMatrixRate => MAX_LITERAL_DERIVED,
        method if method.differentiates_dynamics() || method.is_derived() => MAX_LITERAL_DERIVED,
        _ => MAX_LITERAL,
    };
    formulation.name() != LITERAL || computed(graph).coordinates.len() <= most
}

/// Returns a formulation's function, factored and not factored.
fn variants(
    graph: &BondGraph,
    method: Method,
    formulation: &'static dyn Formulation,
) -> Vec<Function> {
    let choice = Choice::by_elimination(graph, Some(formulation));
    let plain = match method {
        // These methods share their functions in the factored form.
        Method::CoriolisMatrix
        | Method::InverseDynamicsDerivatives
        | Method::InverseDerivativesByTree => choice.function(method).map(|f| (*f).clone()),
        // They combine functions of the formulation.
        Method::MassMatrixRate => choice.function(method).map(|f| (*f).clone()),
        method if method.is_derived() => choice.function(method).map(|f| (*f).clone()),
        _ if graph.closed.is_some() => choice.function(method).map(|f| (*f).clone()),
        _ => choice.asked_plain(method),
    };
    let Some(plain) = plain else {
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

//! Methods that are computed by differentiating the expressions of others.

use bgdyn_runtime::Dd;

use super::differentiate::{derivatives, finish, reopened};
use super::forward_dynamics::ForwardDerivatives;
use crate::bond_graph::BondGraph;
use crate::expr::{Ex, Expr, Leaf};
use crate::formulation::{Formulation, Search, literal, recursion};
use crate::function::Function;
use crate::method::Method;
use crate::passes::{cheapest, factor};

/// Velocities up to which expressions are differentiated to see whether that costs less than
/// composite bodies.
const SMALL: usize = 4;

/// The method, if it is one of these; the others come from a formulation.
pub(in crate::formulation) fn function(search: &Search<'_>, method: Method) -> Option<Function> {
    let graph = search.graph;
    match method {
        Method::CoriolisMatrix | Method::InverseDynamicsDerivatives => {
            let literal = search.asks_for(literal::NAME);
            let own = search.asks_for(recursion::OwnInertia.name());
            let recursion: &dyn Formulation = match own {
                true => &recursion::OwnInertia,
                false => &recursion::Recursion,
            };
            let regrouped = (!literal).then(|| recursion.function(search, method));
            let regrouped = regrouped.flatten();
            // Differentiating is cheaper for a few joints at most, and slow for many.
            let small = graph.coordinates.len() <= SMALL;
            let differentiated = (literal || small).then(|| differentiated(search, method));
            let ways = regrouped.into_iter().chain(differentiated.flatten());
            cheapest(ways.map(factor))
        }
        Method::ForwardDynamicsDerivatives => {
            let slopes = search.effort_derivatives()?;
            let ways = search
                .differentiable()
                .map(|forward| forward_derivatives(graph, method, slopes, forward));
            cheapest(ways)
        }
        _ => None,
    }
}

/// The method by differentiating the graph of what it is a derivative of.
fn differentiated(search: &Search<'_>, method: Method) -> Option<Function> {
    let graph = search.graph;
    let n = graph.coordinates.len();
    if method == Method::CoriolisMatrix {
        // The bias is quadratic in v with Christoffel's symbols: C = ½ ∂bias/∂v.
        let bias = search.function(Method::Bias)?;
        let (b, x) = reopened(&bias);
        let half = |e: Ex<'_>| (e * Dd::from_f64(0.5)).expr();
        let columns = derivatives(&b, &x, n, Leaf::Velocity);
        let outputs = rows(&columns).into_iter().map(|e| half(b.ex(e))).collect();
        return Some(finish(graph, method, &bias, b, outputs));
    }
    let inverse = search.function(Method::InverseDynamics)?;
    let (b, x) = reopened(&inverse);
    let mut outputs = rows(&derivatives(&b, &x, n, Leaf::Position));
    outputs.extend(rows(&derivatives(&b, &x, n, Leaf::Velocity)));
    Some(finish(graph, method, &inverse, b, outputs))
}

/// ∂q̈/∂x = −M⁻¹ ∂τ/∂x at τ = inverse dynamics(q, v, q̈), and ∂q̈/∂τ = M⁻¹.
///
/// Forward dynamics is linear in τ: its derivative along dτ is M⁻¹ dτ, by whatever way it was
/// found to be stable and cheap. Columns that are alike run in a loop, where that takes no operation
/// more.
fn forward_derivatives(
    graph: &BondGraph,
    method: Method,
    slopes: &Function,
    forward: &Function,
) -> Function {
    let columns = ForwardDerivatives::new(graph, slopes, forward);
    let groups = columns.alike();
    let written_out = columns.clone().function(graph, method, forward, &[]);
    if groups.is_empty() {
        return written_out;
    }
    let looped = columns.function(graph, method, forward, &groups);
    match looped.operations().total() <= written_out.operations().total() {
        true => looped,
        false => written_out,
    }
}

/// Columns as one matrix, row by row.
fn rows(columns: &[Vec<Expr>]) -> Vec<Expr> {
    (0..columns.len())
        .flat_map(|i| columns.iter().map(move |c| c[i]))
        .collect()
}

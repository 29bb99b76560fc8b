//! Methods that follow from others by differentiating their expressions.

use bgdyn_runtime::Dd;

use super::{Formulation, Search, literal, recursion};
use crate::bond_graph::BondGraph;
use crate::expr::{Builder, Ex, Expr, Graph, Leaf, Tangent, copy_into};
use crate::function::Function;
use crate::method::{Method, Shape};

/// Velocities up to which expressions are differentiated to see whether that costs less than
/// composite bodies.
const SMALL: usize = 4;

/// The method, if it is one of these; the others come from a formulation.
pub(super) fn function(search: &Search<'_>, method: Method) -> Option<Function> {
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
            Function::cheapest(ways.map(Function::factored))
        }
        Method::ForwardDynamicsDerivatives => {
            let slopes = search.slopes()?;
            let ways = search
                .differentiable()
                .map(|forward| forward_derivatives(graph, method, slopes, forward));
            Function::cheapest(ways)
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
/// found to be stable and cheap.
fn forward_derivatives(
    graph: &BondGraph,
    method: Method,
    slopes: &Function,
    forward: &Function,
) -> Function {
    let n = graph.coordinates.len();
    // The copy takes over the accelerations in place of their leaves.
    let (b, accelerations) = reopened(forward);
    let placed = |_: &mut Graph, leaf: Leaf| match leaf {
        Leaf::Acceleration(j) => Some(accelerations[j]),
        _ => None,
    };
    let slopes = {
        let results = &slopes.blocks[0].outputs;
        b.with_graph(|g| copy_into(g, &slopes.graph, results, placed))
    };
    let along = |drive: &[Expr]| -> Vec<Expr> {
        let mut tangent = Tangent::new(|_: &mut Graph, leaf| match leaf {
            Leaf::Input(j) => Some(drive[j]),
            _ => None,
        });
        b.with_graph(|g| accelerations.iter().map(|&e| tangent.of(g, e)).collect())
    };
    let mut outputs = accelerations.clone();
    for square in slopes.chunks((n * n).max(1)) {
        let minus = |row: &[Expr], j: usize| (-b.ex(row[j])).expr();
        let drive = |j: usize| -> Vec<Expr> { square.chunks(n).map(|r| minus(r, j)).collect() };
        let columns: Vec<Vec<Expr>> = (0..n).map(|j| along(&drive(j))).collect();
        outputs.extend(rows(&columns));
    }
    // Of two equal entries of M⁻¹ the one nearer to the base takes less.
    let inverse = derivatives(&b, &accelerations, n, Leaf::Input);
    let nearer = |i: usize, j: usize| inverse[i.max(j)][i.min(j)];
    outputs.extend(
        (0..n)
            .flat_map(|i| (0..n).map(move |j| (i, j)))
            .map(|(i, j)| nearer(i, j)),
    );
    debug_assert_eq!(outputs.len(), Shape::CheckedSquares.len(n));
    finish(graph, method, forward, b, outputs)
}

/// A function's graph, open for more, and its results.
fn reopened(function: &Function) -> (Builder, Vec<Expr>) {
    (
        Builder::from(function.graph.clone()),
        function.blocks[0].outputs.clone(),
    )
}

/// ∂x/∂leaf_j: a column per coordinate j.
fn derivatives(b: &Builder, x: &[Expr], n: usize, leaf: fn(usize) -> Leaf) -> Vec<Vec<Expr>> {
    let column = |j: usize| {
        let mut tangent =
            Tangent::new(|g: &mut Graph, l| (l == leaf(j)).then(|| g.constant(Dd::ONE)));
        x.iter()
            .map(|&e| b.with_graph(|g| tangent.of(g, e)))
            .collect()
    };
    (0..n).map(column).collect()
}

/// Columns as one matrix, row by row.
fn rows(columns: &[Vec<Expr>]) -> Vec<Expr> {
    (0..columns.len())
        .flat_map(|i| columns.iter().map(move |c| c[i]))
        .collect()
}

fn finish(
    graph: &BondGraph,
    method: Method,
    from: &Function,
    b: Builder,
    outputs: Vec<Expr>,
) -> Function {
    let formulation = format!("{}; differentiated", from.formulation);
    let made = Function::flat(graph, method, formulation, b.into_graph(), outputs);
    Function {
        ordered: from.ordered,
        ..made
    }
}

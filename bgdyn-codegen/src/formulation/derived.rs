//! Methods that follow from others by differentiating their expressions.

use bgdyn_runtime::Dd;

use super::{Formulation, candidates, choose};
use crate::bond_graph::BondGraph;
use crate::expr::{Builder, Ex, Expr, Graph, Leaf, Tangent, copy_into};
use crate::function::Function;
use crate::method::{Method, Shape};

/// The method, if it is one of these; the others come from a formulation.
pub(super) fn function(
    graph: &BondGraph,
    method: Method,
    asked: Option<&dyn Formulation>,
) -> Option<Function> {
    let n = graph.coordinates.len();
    match method {
        Method::CoriolisMatrix => {
            // The bias is quadratic in v with Christoffel's symbols: C = ½ ∂bias/∂v.
            let bias = choose(graph, Method::Bias, asked)?;
            let (b, x) = reopened(&bias);
            let half = |e: Ex<'_>| (e * Dd::from_f64(0.5)).expr();
            let columns = derivatives(&b, &x, n, Leaf::Velocity);
            let outputs = rows(&columns).into_iter().map(|e| half(b.ex(e))).collect();
            Some(finish(graph, method, &bias, b, outputs))
        }
        Method::InverseDynamicsDerivatives => {
            let inverse = choose(graph, Method::InverseDynamics, asked)?;
            let (b, x) = reopened(&inverse);
            let mut outputs = rows(&derivatives(&b, &x, n, Leaf::Position));
            outputs.extend(rows(&derivatives(&b, &x, n, Leaf::Velocity)));
            Some(finish(graph, method, &inverse, b, outputs))
        }
        Method::ForwardDynamicsDerivatives => {
            let inverse = choose(graph, Method::InverseDynamics, asked)?;
            candidates(graph, Method::ForwardDynamics, asked)
                .iter()
                .map(|forward| forward_derivatives(graph, method, &inverse, forward))
                .min_by_key(|f| f.operations().total())
        }
        _ => None,
    }
}

/// ∂q̈/∂x = −M⁻¹ ∂τ/∂x at τ = inverse dynamics(q, v, q̈), and ∂q̈/∂τ = M⁻¹.
///
/// Forward dynamics is linear in τ: its derivative along dτ is M⁻¹ dτ, by whatever way it was
/// found to be stable and cheap.
fn forward_derivatives(
    graph: &BondGraph,
    method: Method,
    inverse: &Function,
    forward: &Function,
) -> Function {
    let n = graph.coordinates.len();
    let (b, tau) = reopened(inverse);
    let mut slopes = derivatives(&b, &tau, n, Leaf::Position);
    slopes.extend(derivatives(&b, &tau, n, Leaf::Velocity));
    let results = &forward.blocks[0].outputs;
    let accelerations = b.with_graph(|g| copy_into(g, &forward.graph, results, |_, _| None));
    // The accelerations take the place of their leaves.
    let placed = |_: &mut Graph, leaf: Leaf| match leaf {
        Leaf::Acceleration(j) => Some(accelerations[j]),
        _ => None,
    };
    let slopes = replaced(&b, &slopes, placed);
    let along = |drive: &[Expr]| {
        let mut tangent = Tangent::new(|_: &mut Graph, leaf| match leaf {
            Leaf::Input(j) => Some(drive[j]),
            _ => None,
        });
        b.with_graph(|g| accelerations.iter().map(|&e| tangent.of(g, e)).collect())
    };
    let minus = |column: &Vec<Expr>| column.iter().map(|&e| (-b.ex(e)).expr()).collect();
    let columns: Vec<Vec<Expr>> = slopes
        .iter()
        .map(minus)
        .map(|c: Vec<_>| along(&c))
        .collect();
    let inertia = derivatives(&b, &accelerations, n, Leaf::Input);
    let mut outputs = accelerations.clone();
    for square in columns.chunks(n.max(1)).chain([inertia.as_slice()]) {
        outputs.extend(rows(square));
    }
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

/// The columns with leaves replaced.
fn replaced(
    b: &Builder,
    columns: &[Vec<Expr>],
    mut leaf: impl FnMut(&mut Graph, Leaf) -> Option<Expr>,
) -> Vec<Vec<Expr>> {
    let all: Vec<Expr> = columns.iter().flatten().copied().collect();
    let copies = b.with_graph(|g| {
        let from = g.clone();
        copy_into(g, &from, &all, &mut leaf)
    });
    let n = columns.first().map_or(1, |c| c.len().max(1));
    copies.chunks(n).map(<[Expr]>::to_vec).collect()
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
    Function::flat(graph, method, formulation, b.into_graph(), outputs)
}

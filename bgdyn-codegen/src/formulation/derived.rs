//! Methods that follow from others by differentiating their expressions.

use bgdyn_runtime::Dd;

use super::{FORMULATIONS, Formulation, choose, literal, solve};
use crate::bond_graph::BondGraph;
use crate::expr::{Builder, Ex, Expr, Graph, Leaf, Tangent, copy_into};
use crate::function::Function;
use crate::method::{Method, Shape};

/// The method, if it is one of these; the others come from a formulation.
///
/// A formulation may know the derivatives themselves; the chosen functions' graphs can always be
/// differentiated. What costs less is taken.
pub(super) fn function(
    graph: &BondGraph,
    method: Method,
    asked: Option<&dyn Formulation>,
) -> Option<Function> {
    let differentiated = differentiated(graph, method, asked)?;
    // The literal sum knows no derivatives.
    let regrouped = FORMULATIONS.iter().filter(|f| {
        f.name() != literal::NAME && asked.is_none_or(|asked| asked.name() == f.name())
    });
    regrouped
        .filter_map(|f| f.function(graph, method))
        .chain([differentiated])
        .min_by_key(|f| f.operations().total())
}

/// The method by differentiating the graph of the function that it is a derivative of.
fn differentiated(
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
            let half = |e: Ex<'_>| (e * Dd::from_f64(0.5)).expr;
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
        Method::ForwardDynamicsDerivatives => forward_derivatives(graph, method, asked),
        _ => None,
    }
}

/// ∂q̈/∂x = −M⁻¹ ∂τ/∂x at τ = inverse dynamics(q, v, q̈), and ∂q̈/∂τ = M⁻¹.
fn forward_derivatives(
    graph: &BondGraph,
    method: Method,
    asked: Option<&dyn Formulation>,
) -> Option<Function> {
    let n = graph.coordinates.len();
    let inverse = choose(graph, Method::InverseDynamics, asked)?;
    let mass = choose(graph, Method::MassMatrix, asked)?;
    let bias = choose(graph, Method::Bias, asked)?;
    let (b, tau) = reopened(&inverse);
    let mut slopes = derivatives(&b, &tau, n, Leaf::Position);
    slopes.extend(derivatives(&b, &tau, n, Leaf::Velocity));
    let keep = |_: &mut Graph, _: Leaf| None;
    let copied = |f: &Function| -> Vec<Expr> {
        let outputs = &f.blocks[0].outputs;
        b.with_graph(|g| copy_into(g, &f.graph, outputs, keep))
    };
    let (mass, bias) = (copied(&mass), copied(&bias));
    let outputs = {
        let triangle = (0..n).map(|i| {
            (0..=i)
                .map(|j| b.ex(mass[i * (i + 1) / 2 + j]))
                .collect::<Vec<_>>()
        });
        let factor = solve::Factor::new(&b, triangle.collect());
        let drive = (0..n)
            .map(|j| b.leaf(Leaf::Input(j)) - b.ex(bias[j]))
            .collect();
        let accelerations = factor.solve(drive);
        // The accelerations take the place of their leaves.
        let placed = |_: &mut Graph, leaf: Leaf| match leaf {
            Leaf::Acceleration(j) => Some(accelerations[j].expr),
            _ => None,
        };
        let slopes = replaced(&b, &slopes, placed);
        let row = |square: &[Vec<Expr>], i: usize| square.iter().map(|c| b.ex(c[i])).collect();
        let squares: Vec<Vec<Vec<Ex<'_>>>> = slopes
            .chunks(n.max(1))
            .map(|square| (0..n).map(|i| row(square, i)).collect())
            .collect();
        let results = factor.accelerations_and_slopes(accelerations, &squares);
        results.into_iter().map(|e| e.expr).collect::<Vec<_>>()
    };
    debug_assert_eq!(outputs.len(), Shape::CheckedSquares.len(n));
    Some(finish(graph, method, &inverse, b, outputs))
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

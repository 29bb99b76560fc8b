//! Differentiates a function's results by the leaves of its graph.

use bgdyn_runtime::Dd;

use crate::bond_graph::{BondGraph, ClosedTree, Multibody};
use crate::expr::{Builder, Expr, Leaf, Signed, Tangent};
use crate::formulation::joint_motion::{along, tangents, unit_tangents};
use crate::formulation::loop_rows::{LoopForm, loop_rows};
use crate::formulation::velocity_map::VelocityMap;
use crate::function::Function;
use crate::method::Method;

/// Returns a function's graph, for adding nodes, and its results.
pub(super) fn reopen(function: &Function) -> (Builder, Vec<Signed>) {
    (
        Builder::from(function.graph.clone()),
        function.blocks[0].outputs.clone(),
    )
}

/// Returns the pairs of functions to try, of two lists with the cheapest ones first: the first efforts with each forward
/// dynamics, and the first forward dynamics with each other efforts.
pub(super) fn pairs_with_cheapest<'a>(
    efforts: &[&'a Function],
    forward: &[&'a Function],
) -> Vec<(&'a Function, &'a Function)> {
    let of_first = efforts.iter().take(1);
    let of_first = of_first.flat_map(|e| forward.iter().map(move |f| (*e, *f)));
    let others = efforts.iter().skip(1);
    let others = others.flat_map(|e| forward.iter().take(1).map(move |f| (*e, *f)));
    of_first.chain(others).collect()
}

/// Returns the derivatives along the tangent: column j is d/dε x(q + ε q̇) with q̇ = N(q) e_j. Where conditions on
/// velocities alone leave more ways to move than velocities, there is a column for each velocity of the open tree.
pub(super) fn position_derivatives(
    b: &Builder,
    x: &[Signed],
    graph: &BondGraph,
) -> Vec<Vec<Signed>> {
    let tangents = position_tangents(b, graph);
    let column = |rates: &Vec<Signed>| {
        let mut tangent = Tangent::new(along(rates.clone()));
        x.iter()
            .map(|&e| b.with_graph(|g| tangent.of(g, e)))
            .collect()
    };
    tangents.iter().map(column).collect()
}

/// Returns the rates of all positions for a unit of each velocity: of the independent ones, or of those of the open
/// tree where positions close along it.
pub(super) fn position_tangents(b: &Builder, graph: &BondGraph) -> Vec<Vec<Signed>> {
    let n = graph.coordinates.len();
    let Some(closed) = &graph.closed else {
        return (0..n).map(|j| unit_tangents(b, graph, j)).collect();
    };
    let q: Vec<Expr<'_>> = (0..graph.positions.len())
        .map(|p| b.leaf(Leaf::Position(p)))
        .collect();
    if closed.closure.nonholonomic() {
        return closed_tangents(b, closed, &q);
    }
    let (form, closure) = (LoopForm::default(), &closed.closure);
    let rows = loop_rows(b, closure, &q, form);
    let map = VelocityMap::new(b, closure, (rows, form), None).map;
    let column = |j: usize| map.iter().map(|row| row[j]).collect::<Vec<_>>();
    (0..n)
        .map(|j| tangents(b, &closed.tree, &column(j)))
        .collect()
}

/// Returns the rates of all positions along velocities: with loops along those of the open tree, S v.
pub(crate) fn rates_along(b: &Builder, graph: &BondGraph, v: &[Expr<'_>]) -> Vec<Signed> {
    let Some(closed) = &graph.closed else {
        return tangents(b, graph, v);
    };
    let q: Vec<Expr<'_>> = (0..graph.positions.len())
        .map(|p| b.leaf(Leaf::Position(p)))
        .collect();
    let (form, closure) = (LoopForm::default(), &closed.closure);
    let rows = loop_rows(b, closure, &q, form);
    let map = VelocityMap::new(b, closure, (rows, form), None);
    tangents(b, &closed.tree, &map.velocities(v))
}

/// Returns, for each velocity k of the open tree, the rates of all positions along e_k − J⁺ J e_k, with the rows J of
/// the conditions on positions and the least change J⁺ of the velocities along which they close.
fn closed_tangents(b: &Builder, closed: &ClosedTree, q: &[Expr<'_>]) -> Vec<Vec<Signed>> {
    let closure = &closed.closure;
    let form = LoopForm {
        of_plane: true,
        by_vectors: true,
        ..LoopForm::default()
    };
    let rows = loop_rows(b, closure, q, form);
    let map = VelocityMap::new(b, closure, (rows, form), None);
    let n = closure.positions.len();
    let column = |k: usize| {
        let open: Vec<Expr<'_>> = map.rates().iter().map(|row| row[k]).collect();
        let unit = |j: usize| b.constant(if j == k { Dd::ONE } else { Dd::ZERO });
        let closing = map.steps(&open).into_iter().enumerate();
        let moved: Vec<Expr<'_>> = closing.map(|(j, step)| unit(j) - step).collect();
        tangents(b, &closed.tree, &moved)
    };
    (0..n).map(column).collect()
}

/// Returns a function of the differentiated graph; its operations are in a fixed order if those of the
/// original function are.
pub(super) fn finish(
    graph: &Multibody,
    method: Method,
    from: &Function,
    b: Builder,
    outputs: Vec<Signed>,
) -> Function {
    let formulation = format!("{}; differentiated", from.formulation);
    let made = Function::flat(graph, method, formulation, b.into_graph(), outputs);
    Function {
        ordered: from.ordered,
        ..made
    }
}

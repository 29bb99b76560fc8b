//! Derivatives of a function's results by the leaves of its graph.

use bgdyn_runtime::Dd;

use crate::bond_graph::Multibody;
use crate::expr::{Builder, Graph, Leaf, Signed, Tangent};
use crate::function::Function;
use crate::method::Method;

/// A function's graph, open for more, and its results.
pub(super) fn reopened(function: &Function) -> (Builder, Vec<Signed>) {
    (
        Builder::from(function.graph.clone()),
        function.blocks[0].outputs.clone(),
    )
}

/// ∂x/∂leaf_j: a column per coordinate j.
pub(super) fn derivatives(
    b: &Builder,
    x: &[Signed],
    n: usize,
    leaf: fn(usize) -> Leaf,
) -> Vec<Vec<Signed>> {
    let column = |j: usize| {
        let mut tangent =
            Tangent::new(|g: &mut Graph, l| (l == leaf(j)).then(|| g.constant(Dd::ONE)));
        x.iter()
            .map(|&e| b.with_graph(|g| tangent.of(g, e)))
            .collect()
    };
    (0..n).map(column).collect()
}

/// A function of the differentiated graph; it keeps the order of operations where its origin does.
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

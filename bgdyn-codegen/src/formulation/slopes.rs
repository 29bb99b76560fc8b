//! Derivatives of results by leaves, and of accelerations along efforts.

use bgdyn_runtime::Dd;

use crate::expr::{Builder, Graph, Leaf, Signed, Tangent};

/// Returns ∂x/∂leaf_j: a column per coordinate j.
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

/// Returns the derivatives of accelerations along efforts: they are linear in these.
pub(super) fn along_efforts(
    b: &Builder,
    accelerations: &[Signed],
    drive: &[Signed],
) -> Vec<Signed> {
    let mut tangent = Tangent::new(|_: &mut Graph, leaf| match leaf {
        Leaf::Input(j) => Some(drive[j]),
        _ => None,
    });
    let all = accelerations.iter();
    b.with_graph(|g| all.map(|&e| tangent.of(g, e)).collect())
}

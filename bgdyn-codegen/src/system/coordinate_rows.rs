//! Rows of the equations of motion: the links' accelerations, and the inertia of other coordinates.

use super::SceneEquations;
use crate::effort_sums::EffortSums;
use crate::expr::{Expr, Graph, Leaf, Signed};
use crate::function::Function;

/// Returns the accelerations by forward dynamics under the efforts of the laws.
pub(super) fn link_accelerations<'g>(
    forward: &Function,
    sums: &EffortSums<'g, '_>,
    system: &SceneEquations,
) -> Vec<Expr<'g>> {
    let efforts: Vec<Signed> = (0..system.graph.coordinates.len())
        .map(|j| sums.effort(j).signed())
        .collect();
    let placed = |_: &mut Graph, leaf| match leaf {
        Leaf::Input(j) => Some(efforts[j]),
        _ => None,
    };
    sums.results(forward, placed)
}

/// Returns the inertia of a coordinate with a store of its own.
pub(super) fn own_inertia<'g>(sums: &EffortSums<'g, '_>, j: usize) -> Expr<'g> {
    sums.inertia_of(j).unwrap_or(sums.b.number(1.0))
}

//! Rows of the equations of motion: the links' accelerations, and the inertia of other coordinates.

use super::System;
use crate::expr::{Builder, Ex, Expr, Graph, Leaf, copy_into};
use crate::function::Function;
use crate::laws::Laws;

/// Forward dynamics under the efforts of the laws.
pub(super) fn link_accelerations<'g>(
    b: &'g Builder,
    forward: &Function,
    laws: &Laws<'g, '_>,
    system: &System,
) -> Vec<Ex<'g>> {
    let efforts: Vec<Expr> = (0..system.graph.coordinates.len())
        .map(|j| laws.effort(j).expr())
        .collect();
    let placed = |_: &mut Graph, leaf| match leaf {
        Leaf::Input(j) => Some(efforts[j]),
        _ => None,
    };
    let outputs = &forward.blocks[0].outputs;
    let copies = b.with_graph(|g| copy_into(g, &forward.graph, outputs, placed));
    copies.into_iter().map(|e| b.ex(e)).collect()
}

/// Inertia of a coordinate that stores its own momentum.
pub(super) fn own_inertia<'g>(laws: &Laws<'g, '_>, j: usize) -> Ex<'g> {
    laws.inertia_of(j).unwrap_or(laws.b.number(1.0))
}

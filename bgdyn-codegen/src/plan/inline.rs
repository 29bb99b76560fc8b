//! Counts how often values are read, and finds the operations that belong to the statement of their only reader.

use crate::expr::{Graph, Node, NodeId, Signed};
use crate::method::{Entries, Shape};

/// Largest number of operations in one statement, for readability.
const MAX_STATEMENT_OPERATIONS: usize = 6;

/// Returns how often each node is read; an output counts `reads_per_output` times.
pub(super) fn uses(
    graph: &Graph,
    needed: &[bool],
    outputs: &[Signed],
    reads_per_output: u32,
) -> Vec<u32> {
    let mut uses = vec![0; graph.len()];
    for e in outputs {
        uses[e.node.index()] += reads_per_output;
    }
    for i in (0..needed.len()).filter(|&i| needed[i]) {
        let node = graph.node(NodeId::at(i));
        node.for_each_operand(|operand| uses[operand.index()] += 1);
    }
    uses
}

/// Returns whether each operation is written within its only reader: a sum, product or quotient without a name that
/// is read once, unless the statement becomes too long.
pub(super) fn inline(graph: &Graph, needed: &[bool], uses: &[u32]) -> Vec<bool> {
    let (mut inline, mut sizes) = (vec![false; graph.len()], vec![0; graph.len()]);
    for i in (0..needed.len()).filter(|&i| needed[i]) {
        let node = graph.node(NodeId::at(i));
        if !matches!(node, Node::Add(..) | Node::Mul(..) | Node::Div(..)) {
            continue;
        }
        sizes[i] = 1;
        node.for_each_operand(|o| sizes[i] += usize::from(inline[o.index()]) * sizes[o.index()]);
        let is_short = sizes[i] < MAX_STATEMENT_OPERATIONS;
        inline[i] = uses[i] <= 1 && is_short && graph.name(NodeId::at(i)).is_none();
    }
    inline
}

/// Returns how often the result reads an output: entries off the diagonal of a symmetric matrix are written twice.
pub(super) fn reads_per_output(shape: Shape) -> u32 {
    match shape {
        Shape::Symmetric => 2,
        Shape::Checked(Entries::Joints | Entries::Task | Entries::Symmetric(_)) => 2,
        _ => 1,
    }
}

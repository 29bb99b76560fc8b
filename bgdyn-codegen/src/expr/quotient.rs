//! Replaces a product with a reciprocal by a division where the reciprocal has no other use.
//!
//! x · (1/y) becomes x/y, which saves the product and one rounding. It applies to the last pivot of a
//! factored mass matrix.

use bgdyn_runtime::Dd;

use super::copy::remade;
use super::{Graph, Node, NodeId, Signed, reads};

/// Returns the same values without reciprocals whose only reader is a product.
pub fn fold_reciprocals(from: Graph, outputs: Vec<Signed>) -> (Graph, Vec<Signed>) {
    let reads = reads(&from, &outputs);
    let is_one = |id: NodeId| matches!(from.node(id), Node::Constant(c) if c.value() == Dd::ONE);
    // y of a node 1/y with a single reader.
    let divisor = |id: NodeId| match from.node(id) {
        Node::Div(one, y) if reads[id.index()] == 1 && is_one(*one) => Some(*y),
        _ => None,
    };
    // x, y and 1/y of a product x · (1/y).
    let quotient = |id: NodeId| match from.node(id) {
        Node::Mul(a, b) => match (divisor(*a), divisor(*b)) {
            (Some(y), _) => Some((*b, y, *a)),
            (None, Some(y)) => Some((*a, y, *b)),
            (None, None) => None,
        },
        _ => None,
    };
    let mut wanted: Vec<bool> = reads.iter().map(|&n| n > 0).collect();
    let mut found = false;
    for id in (0..from.len()).map(NodeId::at) {
        if let (true, Some((_, _, reciprocal))) = (reads[id.index()] > 0, quotient(id)) {
            wanted[reciprocal.index()] = false;
            found = true;
        }
    }
    // Most functions have no division, and there are many candidates: do not copy those.
    if !found {
        return (from, outputs);
    }
    let mut to = Graph::default();
    let nodes = (0..from.len()).filter(|&i| wanted[i]);
    let outputs = remade(
        &mut to,
        &from,
        &outputs,
        nodes,
        |to, id, at| match quotient(id) {
            Some((x, y, _)) => to.div(at(Signed::plus(x)), at(Signed::plus(y))),
            None => to.rebuilt(from.node(id), at),
        },
    );
    (to, outputs)
}

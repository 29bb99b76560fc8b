//! Fuses a product with the only addition that uses it into a multiply-add, which rounds once.
//!
//! A machine with fused multiply-adds executes it as one instruction.

use super::copy::remade;
use super::{Graph, Node, NodeId, Signed, cost};

/// Copies `outputs` to a new graph, with every addition of a product without other readers as a
/// [`Node::MulAdd`]. The operation count does not change. If both operands are such products, the later
/// one is fused: the other one is computed by then.
pub fn fuse(from: &Graph, outputs: &[Signed]) -> (Graph, Vec<Signed>) {
    let reads = cost::reads(from, outputs);
    let ready = cost::ready(from, &reads);
    let is_free = |id: NodeId| reads[id.0 as usize] == 1 && matches!(from.node(id), Node::Mul(..));
    // Selects the operand of an addition that is fused; `true` for the second one.
    let joined = |node: &Node| {
        let Node::Add(a, b) = node else { return None };
        match (is_free(*a), is_free(b.node)) {
            (true, true) => Some(ready[b.node.0 as usize] >= ready[a.0 as usize]),
            (first, second) => (first || second).then_some(second),
        }
    };
    let mut inside = vec![false; from.len()];
    for node in (0..from.len())
        .filter(|&i| reads[i] > 0)
        .map(|i| &from.nodes[i])
    {
        if let (Some(second), Node::Add(a, b)) = (joined(node), node) {
            inside[if second { b.node } else { *a }.0 as usize] = true;
        }
    }
    let mut to = Graph::default();
    let nodes = (0..from.len()).filter(|&i| reads[i] > 0 && !inside[i]);
    let outputs = remade(&mut to, from, outputs, nodes, |to, id, at| {
        let node = from.node(id);
        let (Some(second), Node::Add(a, b)) = (joined(node), node) else {
            return to.rebuilt(node, at);
        };
        let a = Signed::plus(*a);
        let (product, rest) = if second { (*b, a) } else { (a, *b) };
        let Node::Mul(x, y) = from.node(product.node) else {
            unreachable!("only products are joined")
        };
        let x = at(Signed::plus(*x)).flipped(product.negative);
        to.mul_add(x, at(Signed::plus(*y)), at(rest))
    });
    (to, outputs)
}

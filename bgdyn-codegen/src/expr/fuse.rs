//! Fuses a product with the one addition that uses it into a multiply-add, which rounds once.
//!
//! A machine with fused multiply-adds executes it as one instruction.

use super::copy::remade;
use super::{Expr, Graph, Node, NodeId, cost};

/// Copies of `outputs` in a graph of their own, with every addition of a product that nothing else
/// reads as a [`Node::MulAdd`]. The count of operations stays. Of two such products the one that is
/// there later is joined: the other is done by then.
pub fn fuse(from: &Graph, outputs: &[Expr]) -> (Graph, Vec<Expr>) {
    let reads = cost::reads(from, outputs);
    let ready = cost::ready(from, &reads);
    let is_free = |id: NodeId| reads[id.0 as usize] == 1 && matches!(from.node(id), Node::Mul(..));
    // Which operand of an addition goes in with it; the second one where `true`.
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
        let a = Expr::plus(*a);
        let (product, rest) = if second { (*b, a) } else { (a, *b) };
        let Node::Mul(x, y) = from.node(product.node) else {
            unreachable!("only products are joined")
        };
        let x = at(Expr::plus(*x)).flipped(product.negative);
        to.mul_add(x, at(Expr::plus(*y)), at(rest))
    });
    (to, outputs)
}

//! Moves negations to operations where they cost nothing.
//!
//! The graph stores a sum with one of its two signs: −a·b − c is written −(a·b + c), so that equal sums
//! share a node. A machine needs an instruction for the sign in front, but none inside a fused
//! multiply-add, whose product and summand may have either sign. So a sum that is read with the opposite
//! sign is computed with it. Results are equal except for the sign of zero.

use super::copy::remade;
use super::{Graph, Node, NodeId, Signed, reachable};

/// Copies `outputs` to a new graph, without the signs that can be absorbed.
pub fn absorb_negations(from: &Graph, outputs: &[Signed]) -> (Graph, Vec<Signed>) {
    let needed = reachable(from, outputs);
    let flips = flips(from, outputs, &needed);
    let mut to = Graph::default();
    let nodes = (0..from.len()).filter(|&i| needed[i]);
    let outputs = remade(&mut to, from, outputs, nodes, |to, id, at| {
        let flip = flips[id.index()];
        let node = match *from.node(id) {
            Node::MulAdd(a, b, negative, c) => {
                let [a, b] = [a, b].map(|x| at(Signed::plus(x)));
                let product = negative ^ a.negative ^ b.negative ^ flip;
                Node::MulAdd(a.node, b.node, product, at(c).flipped(flip))
            }
            Node::Add(a, b) if flip => Node::Add(at(b).node, at(Signed::plus(a)).flipped(true)),
            ref node => node.clone().map_operands(at),
        };
        Signed::plus(to.intern(node)).flipped(flip)
    });
    (to, outputs)
}

/// Returns the sums to compute with the opposite sign: outputs and pivots read them negated more often
/// than not, and all other readers are fused sums, in which a sign costs nothing.
fn flips(graph: &Graph, outputs: &[Signed], needed: &[bool]) -> Vec<bool> {
    let mut gain = vec![0_i32; graph.len()];
    let mut bound = vec![false; graph.len()];
    let mut tally = |e: Signed| gain[e.node.index()] += if e.negative { 1 } else { -1 };
    outputs.iter().copied().for_each(&mut tally);
    for i in (0..graph.len()).filter(|&i| needed[i]) {
        match *graph.node(NodeId(i as u32)) {
            Node::MulAdd(..) => {}
            Node::Pivot(value, magnitude, _) => [value, magnitude].into_iter().for_each(&mut tally),
            ref node => node.for_each_operand(|operand| bound[operand.index()] = true),
        }
    }
    let flippable = |i: usize| match graph.node(NodeId(i as u32)) {
        Node::MulAdd(..) => true,
        Node::Add(_, b) => b.negative,
        _ => false,
    };
    (0..graph.len())
        .map(|i| needed[i] && !bound[i] && gain[i] > 0 && flippable(i))
        .collect()
}

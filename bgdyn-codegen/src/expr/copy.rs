//! Copies expressions from one graph to another and replaces leaves.

use bgdyn_runtime::Dd;

use super::{Graph, Leaf, Node, NodeId, QuickMap, Signed, reachable};

/// Copies `outputs` to `to`; `leaf` may return another expression for a leaf. All constants are folded
/// again.
pub fn copy_into(
    to: &mut Graph,
    from: &Graph,
    outputs: &[Signed],
    leaf: impl FnMut(&mut Graph, Leaf) -> Option<Signed>,
) -> Vec<Signed> {
    copy_with_pivots(to, from, outputs, leaf, Some)
}

/// Does the same, with other indices of the checked pivots; a pivot is not checked where `index` returns `None`.
pub(crate) fn copy_with_pivots(
    to: &mut Graph,
    from: &Graph,
    outputs: &[Signed],
    mut leaf: impl FnMut(&mut Graph, Leaf) -> Option<Signed>,
    index: impl Fn(usize) -> Option<usize>,
) -> Vec<Signed> {
    let needed = reachable(from, outputs);
    let wanted = (0..from.len()).filter(|&i| needed[i]);
    remade(to, from, outputs, wanted, |to, id, at| {
        match from.node(id) {
            Node::Leaf(l) => leaf(to, *l).unwrap_or_else(|| to.leaf(*l)),
            Node::Pivot(value, magnitude, joint) => match index(*joint) {
                Some(joint) => to.pivot(at(*value), at(*magnitude), joint),
                None => at(*value),
            },
            node => to.rebuilt(node, at),
        }
    })
}

/// The sum of angles that a sine or a cosine reads.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct AngleSum {
    /// The node of the sum.
    pub node: NodeId,
    /// Its terms, with a sign: arguments, or `None` for other values.
    pub terms: Vec<(Option<Leaf>, bool)>,
    /// The constant in it, rad.
    pub offset: Dd,
}

/// Returns the sums of angles whose sines or cosines the results need.
pub(crate) fn angle_sums(graph: &Graph, outputs: &[Signed]) -> Vec<AngleSum> {
    let needed = reachable(graph, outputs);
    let mut sums: Vec<AngleSum> = Vec::new();
    for id in (0..graph.len())
        .map(NodeId::at)
        .filter(|id| needed[id.index()])
    {
        let (Node::Sin(node) | Node::Cos(node)) = *graph.node(id) else {
            continue;
        };
        if sums.iter().any(|sum| sum.node == node) {
            continue;
        }
        let leaf = |id: NodeId| match graph.node(id) {
            Node::Leaf(leaf) => Some(*leaf),
            _ => None,
        };
        let (terms, offset) = match graph.node(node) {
            Node::Angle(terms, size, negative) => {
                let terms = terms.iter().map(|t| (leaf(t.node), t.negative)).collect();
                let size = size.value();
                (terms, if *negative { -size } else { size })
            }
            _ => (vec![(leaf(node), false)], Dd::ZERO),
        };
        sums.push(AngleSum {
            node,
            terms,
            offset,
        });
    }
    sums
}

/// Copies `outputs` to `to` with other leaves, and with the cosine and the sine that `turn` returns for the node of a
/// sum of angles.
pub(crate) fn copy_with_turns(
    to: &mut Graph,
    from: &Graph,
    outputs: &[Signed],
    mut leaf: impl FnMut(Leaf) -> Option<Signed>,
    turn: impl Fn(NodeId) -> Option<[Signed; 2]>,
) -> Vec<Signed> {
    let needed = reachable(from, outputs);
    let wanted = (0..from.len()).filter(|&i| needed[i]);
    remade(to, from, outputs, wanted, |to, id, at| {
        let node = from.node(id);
        match node {
            Node::Leaf(l) => leaf(*l).unwrap_or_else(|| to.leaf(*l)),
            Node::Cos(angle) => turn(*angle).map_or_else(|| to.rebuilt(node, at), |[cos, _]| cos),
            Node::Sin(angle) => turn(*angle).map_or_else(|| to.rebuilt(node, at), |[_, sin]| sin),
            node => to.rebuilt(node, at),
        }
    })
}

/// Copies `outputs` to `to` with each of these nodes replaced by the result of `make`, whose argument is
/// the copies of the operands. Names and sections are copied too.
pub(super) fn remade(
    to: &mut Graph,
    from: &Graph,
    outputs: &[Signed],
    nodes: impl Iterator<Item = usize>,
    mut make: impl FnMut(&mut Graph, NodeId, &dyn Fn(Signed) -> Signed) -> Signed,
) -> Vec<Signed> {
    let mut copies: QuickMap<NodeId, Signed> = QuickMap::default();
    let titles = to.adopt_sections(from);
    for id in nodes.map(NodeId::at) {
        to.reopen_section(from, id, titles);
        let copy = make(to, id, &|e| copies[&e.node].flipped(e.negative));
        to.copy_name(copy, from, id);
        copies.insert(id, copy);
    }
    let outputs = outputs.iter();
    outputs
        .map(|e| copies[&e.node].flipped(e.negative))
        .collect()
}

impl Graph {
    /// Returns the node's operation on other operands, folded.
    pub(crate) fn rebuilt(&mut self, node: &Node, at: impl Fn(Signed) -> Signed) -> Signed {
        let plus = |id: &NodeId| at(Signed::plus(*id));
        match node {
            Node::Constant(c) => self.constant(c.value()),
            Node::Leaf(l) => self.leaf(*l),
            Node::Add(a, b) => self.add(plus(a), at(*b)),
            Node::Mul(a, b) => self.mul(plus(a), plus(b)),
            Node::Div(a, b) => self.div(plus(a), plus(b)),
            Node::MulAdd(a, b, negative, c) => {
                self.mul_add(plus(a).flipped(*negative), plus(b), at(*c))
            }
            Node::Sqrt(a) => self.sqrt(at(*a)),
            Node::Angle(terms, offset, negative) => {
                let terms: Vec<Signed> = terms.iter().map(|&t| at(t)).collect();
                let offset = offset.value();
                self.angle(&terms, if *negative { -offset } else { offset })
            }
            Node::Sin(a) => self.sin(plus(a)),
            Node::Cos(a) => self.cos(plus(a)),
            Node::Exp(a) => self.exp(at(*a)),
            Node::Ln(a) => self.ln(at(*a)),
            Node::Tanh(a) => self.tanh(plus(a)),
            Node::Abs(a) => self.abs(plus(a)),
            Node::Min(a, b) => self.min(at(*a), at(*b)),
            Node::Max(a, b) => self.max(at(*a), at(*b)),
            Node::Sign(a) => self.sign(plus(a)),
            Node::Less(a, b) => Signed::plus(self.less(at(*a), at(*b))),
            Node::Select(condition, a, b) => {
                let condition = plus(condition).node;
                self.select(condition, at(*a), at(*b))
            }
            Node::Pivot(value, magnitude, joint) => self.pivot(at(*value), at(*magnitude), *joint),
        }
    }
}

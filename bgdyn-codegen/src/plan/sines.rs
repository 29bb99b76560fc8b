//! Groups angles whose sines and cosines are computed together.

use super::limits::PlanLimits;
use crate::expr::{Graph, Node, NodeId};

/// An angle, and which of its sine and cosine are read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AnglePair {
    /// The angle: a [`Node::Angle`], or any value.
    pub angle: NodeId,
    /// The node of its sine, if it is read.
    pub sine: Option<NodeId>,
    /// The node of its cosine, if it is read.
    pub cosine: Option<NodeId>,
}

/// Angles of a block, as far as their sines are planned.
pub(super) struct AngleGroups<'a> {
    graph: &'a Graph,
    needed: &'a [bool],
    /// Whether the sine and cosine of each node are planned.
    done: Vec<bool>,
}

impl<'a> AngleGroups<'a> {
    pub(super) fn new(graph: &'a Graph, needed: &'a [bool]) -> Self {
        let done = vec![false; graph.len()];
        AngleGroups {
            graph,
            needed,
            done,
        }
    }

    /// Returns the angles whose sines are computed when that of `angle` is needed: none if it is known. An angle
    /// that depends on arguments only is computed together with the next such angles.
    pub(super) fn group(&mut self, angle: NodeId, limits: &PlanLimits) -> Option<Vec<AnglePair>> {
        if self.done[angle.index()] {
            return None;
        }
        let together = match self.is_argument(angle) {
            true => self.next_arguments(angle, limits.sines),
            false => vec![angle],
        };
        together.iter().for_each(|a| self.done[a.index()] = true);
        Some(together.into_iter().map(|a| self.pair(a)).collect())
    }

    /// Returns whether an angle is an argument, or a sum of arguments.
    fn is_argument(&self, angle: NodeId) -> bool {
        let is_leaf = |id: NodeId| matches!(self.graph.node(id), Node::Leaf(_));
        match self.graph.node(angle) {
            Node::Angle(terms, ..) => terms.iter().all(|t| is_leaf(t.node)),
            _ => is_leaf(angle),
        }
    }

    /// Returns this angle and the next ones that depend on arguments only and are not planned yet, in the order of
    /// use, at most `most`.
    fn next_arguments(&self, angle: NodeId, most: usize) -> Vec<NodeId> {
        let mut found = vec![angle];
        for i in (0..self.needed.len()).filter(|&i| self.needed[i]) {
            if found.len() >= most {
                break;
            }
            if let Node::Sin(a) | Node::Cos(a) = self.graph.node(NodeId::at(i))
                && !found.contains(a)
                && !self.done[a.index()]
                && self.is_argument(*a)
            {
                found.push(*a);
            }
        }
        found
    }

    fn pair(&self, angle: NodeId) -> AnglePair {
        let read = |node: &Node| self.graph.find(node).filter(|id| self.needed[id.index()]);
        AnglePair {
            angle,
            sine: read(&Node::Sin(angle)),
            cosine: read(&Node::Cos(angle)),
        }
    }
}

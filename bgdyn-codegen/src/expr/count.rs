//! Counts the operations of functions exactly.
//!
//! Each distinct reachable product is one multiplication (± 1 × x is free), each + or − one addition.
//! Negation and arithmetic on constants are free; sines and cosines count as pairs; divisions and roots
//! are counted separately; comparisons, selections, minima, exponentials and checked pivots are `other`.
//! The sums of angles inside a sine are part of the sine.

use bgdyn_runtime::Operations;

use super::{Graph, Node, Signed};

/// Returns, for each node, whether the outputs need it.
pub fn reachable(graph: &Graph, outputs: &[Signed]) -> Vec<bool> {
    let mut needed = vec![false; graph.len()];
    for e in outputs {
        needed[e.node.0 as usize] = true;
    }
    for i in (0..graph.len()).rev() {
        if needed[i] {
            graph.nodes[i].for_each_operand(|operand| needed[operand.0 as usize] = true);
        }
    }
    needed
}

/// Returns the number of operations for computing the outputs once.
pub fn count(graph: &Graph, outputs: &[Signed]) -> Operations {
    let needed = reachable(graph, outputs);
    let mut counter = Counter::new(graph.len());
    for (node, needed) in graph.nodes.iter().zip(needed) {
        if needed {
            counter.add(node);
        }
    }
    counter.operations
}

/// Counts nodes; each node must be added once.
pub(super) struct Counter {
    pub operations: Operations,
    /// Whether the pair of sine and cosine of each node was counted.
    paired: Vec<bool>,
}

impl Counter {
    /// Returns a counter for a graph of this number of nodes.
    pub fn new(nodes: usize) -> Self {
        Counter {
            operations: Operations::default(),
            paired: vec![false; nodes],
        }
    }

    /// Adds the operations of a node.
    pub fn add(&mut self, node: &Node) {
        let operations = &mut self.operations;
        match node {
            Node::Constant(_) | Node::Leaf(_) | Node::Angle(..) => {}
            Node::Add(..) => operations.add += 1,
            Node::Mul(..) => operations.mul += 1,
            Node::Div(..) => operations.div += 1,
            Node::MulAdd(..) => {
                operations.mul += 1;
                operations.add += 1;
            }
            Node::Sqrt(_) => operations.sqrt += 1,
            Node::Sin(a) | Node::Cos(a) => {
                let paired = std::mem::replace(&mut self.paired[a.0 as usize], true);
                operations.sincos += usize::from(!paired);
            }
            Node::Exp(_)
            | Node::Ln(_)
            | Node::Tanh(_)
            | Node::Abs(_)
            | Node::Min(..)
            | Node::Max(..)
            | Node::Sign(_)
            | Node::Less(..)
            | Node::Select(..)
            | Node::Pivot(..) => operations.other += 1,
        }
    }
}

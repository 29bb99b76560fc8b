//! Operation counts, exact.
//!
//! Each distinct reachable product is one multiplication (± 1 × x is free), each + or − one
//! addition; negation and arithmetic on constants are free; sines and cosines count as pairs;
//! divisions and roots apart; comparisons, selections, minima, exponentials and checked pivots are
//! `other`. The sums of angles inside a sine are part of the sine.

use std::collections::BTreeSet;

use bgdyn_runtime::Operations;

use super::{Expr, Graph, Node, NodeId};

/// Which nodes the outputs need: one truth value per node.
pub fn reachable(graph: &Graph, outputs: &[Expr]) -> Vec<bool> {
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

/// The operations that computing the outputs once takes.
pub fn count(graph: &Graph, outputs: &[Expr]) -> Operations {
    let needed = reachable(graph, outputs);
    let mut operations = Operations::default();
    let mut angles: BTreeSet<NodeId> = BTreeSet::new();
    for (node, _) in graph
        .nodes
        .iter()
        .zip(&needed)
        .filter(|(_, needed)| **needed)
    {
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
                angles.insert(*a);
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
    operations.sincos = angles.len();
    operations
}

//! Expressions without the nodes that their results do not need, to find functions that are the same.

use super::{Graph, Node, NodeId, Signed, reachable};

/// The nodes that the results need, numbered from zero in their order, and the results. They are equal for functions
/// whose operations are created in the same order: every pass then gives both the same operations.
#[derive(Debug, PartialEq, Eq, Hash)]
pub(crate) struct NeededNodes {
    nodes: Vec<Node>,
    outputs: Vec<Signed>,
}

impl NeededNodes {
    /// Returns the nodes of the graph that the outputs need.
    pub fn new(graph: &Graph, outputs: &[Signed]) -> Self {
        let needed = reachable(graph, outputs);
        let mut numbers = vec![0; graph.len()];
        let mut nodes: Vec<Node> = Vec::new();
        let renumbered = |numbers: &[u32], e: Signed| {
            let node = NodeId(numbers[e.node.0 as usize]);
            Signed { node, ..e }
        };
        for i in (0..graph.len()).filter(|&i| needed[i]) {
            numbers[i] = nodes.len() as u32;
            let node = graph.nodes[i].clone();
            nodes.push(node.map_operands(|e| renumbered(&numbers, e)));
        }
        let outputs = outputs.iter().map(|&e| renumbered(&numbers, e)).collect();
        NeededNodes { nodes, outputs }
    }
}

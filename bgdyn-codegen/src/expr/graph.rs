//! The expression graph: each node once, with its name and its section for readers of the output.

use std::collections::BTreeMap;

use bgdyn_runtime::Dd;

use super::index::Index;
use super::naming::{Name, Section, Title};
use super::node::{Constant, Node, NodeId, Signed};

/// The nodes, operands before users.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    pub(super) nodes: Vec<Node>,
    /// The nodes by their hash.
    index: Index,
    pub(super) names: BTreeMap<NodeId, Name>,
    /// Titles of the sections, and for each node the section in which it was created.
    pub(super) titles: Vec<Title>,
    pub(super) sections: Vec<Section>,
    /// The current section.
    pub(super) open: Section,
    /// The unit of length of the following sections.
    pub(super) unit: Option<Dd>,
    /// Names of numbers without their sign; `None` if several quantities have the value.
    pub(super) constant_names: BTreeMap<Constant, Option<Name>>,
}

impl Graph {
    /// Returns the node with this id.
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.0 as usize]
    }

    /// Returns the number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Returns whether the graph is empty.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Returns the unique node equal to `node`, and adds it if it is new.
    pub(crate) fn intern(&mut self, node: Node) -> NodeId {
        let hash = node.quick_hash();
        if let Some(id) = self.found(hash, &node) {
            return id;
        }
        let id = u32::try_from(self.nodes.len()).expect("fewer than 2^32 nodes");
        self.index.insert(hash, id);
        self.nodes.push(node);
        self.sections.push(self.open);
        NodeId(id)
    }

    /// Returns the node equal to `node`, if it exists.
    pub fn find(&self, node: &Node) -> Option<NodeId> {
        self.found(node.quick_hash(), node)
    }

    fn found(&self, hash: u64, node: &Node) -> Option<NodeId> {
        let is_it = |id: u32| self.nodes[id as usize] == *node;
        self.index.find(hash, is_it).map(NodeId)
    }

    /// Returns the value of a constant expression.
    pub fn constant_of(&self, e: Signed) -> Option<Dd> {
        match self.node(e.node) {
            Node::Constant(c) => Some(if e.negative { -c.value() } else { c.value() }),
            _ => None,
        }
    }
}

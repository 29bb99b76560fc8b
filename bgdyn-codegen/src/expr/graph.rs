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
    /// Titles of the sections, and for each node the one in which it was made.
    pub(super) titles: Vec<Title>,
    pub(super) sections: Vec<Section>,
    /// The section that is open.
    pub(super) open: Section,
    /// The unit of length of the sections that are begun.
    pub(super) unit: Option<Dd>,
    /// Names of numbers without their sign; nothing where several quantities have the value.
    pub(super) constant_names: BTreeMap<Constant, Option<Name>>,
}

impl Graph {
    /// The node with this id.
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.0 as usize]
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The one node equal to `node`.
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

    /// The node equal to `node`, if there is one.
    pub fn find(&self, node: &Node) -> Option<NodeId> {
        self.found(node.quick_hash(), node)
    }

    fn found(&self, hash: u64, node: &Node) -> Option<NodeId> {
        let is_it = |id: u32| self.nodes[id as usize] == *node;
        self.index.find(hash, is_it).map(NodeId)
    }

    /// The value of a constant expression.
    pub fn constant_of(&self, e: Signed) -> Option<Dd> {
        match self.node(e.node) {
            Node::Constant(c) => Some(if e.negative { -c.value() } else { c.value() }),
            _ => None,
        }
    }
}

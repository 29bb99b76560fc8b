//! The expression graph: each node once, with its name and its section for readers of the output.

use std::collections::BTreeMap;

use bgdyn_runtime::Dd;

use super::index::Index;
use super::node::{Expr, Node, NodeId};

/// A name for a value. The node may hold the value with the opposite sign.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    /// The name of the value.
    pub text: String,
    /// Whether the node is the value times −1.
    pub negative: bool,
}

impl Name {
    /// An identifier for the node: `neg_m_elbow_turn` for −m_elbow_turn.
    pub fn identifier(&self) -> String {
        let prefix = if self.negative { "neg_" } else { "" };
        format!("{prefix}{}", self.text)
    }
}

/// The nodes, operands before users.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    pub(super) nodes: Vec<Node>,
    /// The nodes by their hash.
    index: Index,
    names: BTreeMap<NodeId, Name>,
    /// Titles of the sections, and for each node the one in which it was made.
    titles: Vec<String>,
    sections: Vec<Section>,
    /// The section that is open.
    open: Section,
}

/// A stretch of the algorithm that readers of the output find under one title; 0 has none.
type Section = u32;

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

    /// The name that a formulation gave to a node, for readers of the output.
    pub fn name(&self, id: NodeId) -> Option<&Name> {
        self.names.get(&id)
    }

    /// Names an expression; the first name of its node stays.
    pub(crate) fn set_name(&mut self, e: Expr, text: impl FnOnce() -> String) {
        if !matches!(self.node(e.node), Node::Constant(_) | Node::Leaf(_)) {
            let named = || Name {
                text: text(),
                negative: e.negative,
            };
            self.names.entry(e.node).or_insert_with(named);
        }
    }

    /// Names `copy` as the node `id` of another graph, of which it is a copy.
    pub(crate) fn copy_name(&mut self, copy: Expr, from: &Graph, id: NodeId) {
        if let Some(name) = from.name(id) {
            self.set_name(copy.flipped(name.negative), || name.text.clone());
        }
    }

    /// The title of the section in which a node was made.
    pub fn section(&self, id: NodeId) -> Option<&str> {
        let section = self.sections[id.0 as usize] as usize;
        section.checked_sub(1).map(|i| self.titles[i].as_str())
    }

    /// What is made from now on belongs under this title.
    pub(crate) fn begin_section(&mut self, title: String) {
        self.titles.push(title);
        self.open = self.titles.len() as Section;
    }

    /// Takes over another graph's titles. What it gives opens the section of a node of that graph.
    pub(crate) fn adopt_sections(&mut self, from: &Graph) -> Section {
        let offset = self.titles.len() as Section;
        self.titles.extend(from.titles.iter().cloned());
        offset
    }

    /// Opens the section that `id` of `from` was made in; `offset` is where its titles went.
    pub(crate) fn reopen_section(&mut self, from: &Graph, id: NodeId, offset: Section) {
        let section = from.sections[id.0 as usize];
        self.open = if section == 0 { 0 } else { section + offset };
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
    pub fn constant_of(&self, e: Expr) -> Option<Dd> {
        match self.node(e.node) {
            Node::Constant(c) => Some(if e.negative { -c.value() } else { c.value() }),
            _ => None,
        }
    }
}

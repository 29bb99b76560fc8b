//! Converts the ports of a junction to a tree, by a walk through the bond graph of the effects.
//!
//! Parts of the links end the walk. A pressure that is visited again, where hoses close a circuit, is
//! named and not drawn again. Resistors that are joined by 0-junctions of two bonds, with no volume
//! between them, have a common 1-junction.

use bgdyn_codegen::bond_graph::{
    BondNetwork, Causality, GraphNode, GraphNodeId, NodeKind, NodePart,
};

use super::chart::Port;

/// The walk, and the nodes visited so far.
pub(super) struct Unfolding<'a> {
    network: &'a BondNetwork,
    causality: Causality,
    met: Vec<bool>,
    /// Returns the text beside the drive of a joint.
    drive: &'a dyn Fn(&NodePart) -> Option<String>,
}

impl<'a> Unfolding<'a> {
    /// Starts without visited nodes.
    pub fn new(network: &'a BondNetwork, drive: &'a dyn Fn(&NodePart) -> Option<String>) -> Self {
        Unfolding {
            network,
            causality: Causality::of(network),
            met: vec![false; network.nodes.len()],
            drive,
        }
    }

    /// Returns whether a node was visited.
    pub fn has_met(&self, node: GraphNodeId) -> bool {
        self.met[node.0]
    }

    /// Returns the ports of a junction of the links, a line or a site: drives first, hydraulics last.
    pub fn ports_of(&mut self, junction: GraphNodeId) -> Vec<Port> {
        let mut all = self.ports(junction, None);
        all.sort_by_key(|port| port.symbol == "TF" && port.ports.iter().any(Port::is_junction));
        all
    }

    /// Returns the same for a part of the mechanism.
    pub fn ports_at(&mut self, part: NodePart) -> Vec<Port> {
        match self.network.part(part) {
            Some(junction) => self.ports_of(junction),
            None => vec![],
        }
    }

    /// Returns a store or a source of a link, with its text.
    pub fn part(&self, part: NodePart, text: String, more: Option<String>) -> Option<Port> {
        let node = self.network.part(part)?;
        let (number, bond) = self.network.bonds_at(node).next()?;
        Some(self.bare_port(number, bond.other(node), text, more))
    }

    /// Returns the nodes joined to a junction, except by the bond of arrival.
    fn ports(&mut self, junction: GraphNodeId, came: Option<usize>) -> Vec<Port> {
        let network = self.network;
        let mut all = Vec::new();
        for (number, bond) in network.bonds_at(junction) {
            let node = bond.other(junction);
            if Some(number) == came || !self.is_drawn_at(node, junction) {
                continue;
            }
            if self.is_between(node, junction) {
                all.extend(self.beyond(node, number));
            } else {
                all.push(self.port(number, junction, node));
            }
        }
        all
    }

    fn node(&self, id: GraphNodeId) -> &'a GraphNode {
        &self.network.nodes[id.0]
    }

    /// Returns whether a node is drawn as a port of this junction: a node of an effect or a drive, not
    /// visited yet, and not a port of a junction of the links itself.
    fn is_drawn_at(&self, node: GraphNodeId, junction: GraphNodeId) -> bool {
        let is_added =
            |id: GraphNodeId| matches!(self.node(id).part, NodePart::Effect | NodePart::Drive(_));
        let others = self
            .network
            .bonds_at(node)
            .map(|(_, bond)| bond.other(node));
        let mut others = others.filter(|other| *other != junction);
        let again = self.met[node.0] && self.node(node).kind != NodeKind::Zero;
        is_added(node) && !again && (self.node(node).kind.is_junction() || others.all(is_added))
    }

    /// Returns whether it is a 0-junction of two bonds between two 1-junctions: their flows are equal.
    fn is_between(&self, node: GraphNodeId, junction: GraphNodeId) -> bool {
        let ends: Vec<NodeKind> = self
            .network
            .bonds_at(node)
            .map(|(_, bond)| self.node(bond.other(node)).kind)
            .collect();
        let kinds = [self.node(node).kind, self.node(junction).kind];
        kinds == [NodeKind::Zero, NodeKind::One] && ends == [NodeKind::One; 2]
    }

    /// Returns the ports of the 1-junction behind a 0-junction of two bonds.
    fn beyond(&mut self, zero: GraphNodeId, came: usize) -> Vec<Port> {
        self.met[zero.0] = true;
        let mut bonds = self.network.bonds_at(zero);
        let Some((number, bond)) = bonds.find(|(number, _)| *number != came) else {
            return vec![];
        };
        let one = bond.other(zero);
        self.met[one.0] = true;
        self.ports(one, Some(number))
    }

    /// Returns a node on a junction with all nodes behind it.
    fn port(&mut self, bond: usize, junction: GraphNodeId, id: GraphNodeId) -> Port {
        let node = self.node(id);
        let text = (self.drive)(&node.part).unwrap_or_else(|| node.text.clone());
        let again = std::mem::replace(&mut self.met[id.0], true);
        if again {
            let text = format!("{text}, see above");
            return self.bare_port(bond, junction, text, None);
        }
        Port {
            ports: self.ports(id, Some(bond)),
            ..self.bare_port(bond, junction, text, node.more.clone())
        }
    }

    /// Returns a node at the end of a bond from a junction.
    fn bare_port(
        &self,
        number: usize,
        junction: GraphNodeId,
        text: String,
        more: Option<String>,
    ) -> Port {
        let bond = self.network.bonds[number];
        let stroke = self.causality.strokes[number];
        Port {
            symbol: self.node(bond.other(junction)).kind.symbol(),
            text,
            more,
            feeds: bond.to == junction,
            on_junction: stroke.map(|node| node == junction),
            ports: Vec::new(),
        }
    }
}

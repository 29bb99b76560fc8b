//! The bond graph of a mechanism and of the effects on it, as nodes and bonds.
//!
//! A node is a junction, a store, a resistor, a transformer, a gyrator or a source. A bond joins two
//! nodes; its half arrow points in the direction of positive power. The junctions, stores, sources and
//! transformers of the links come from the [`BondGraph`]; each effect adds its own nodes by the functions
//! here. A bond of the links carries three components and is one bond.

use std::collections::{BTreeMap, BTreeSet};

use super::node::{
    Bond, GraphNode, GraphNodeId, NodeKind, NodePart, PlacePort, PortSite, PowerTerm,
};
use super::{BondGraph, Junction, JunctionId};
use crate::mechanism::closure::{Closure, LoopRow};
use crate::mechanism::{CoordinateId, LinkId};

/// A node of a hydraulic circuit.
#[derive(Clone, Debug, PartialEq)]
enum NodePressure {
    /// The 0-junction of a pressure.
    Junction(GraphNodeId),
    /// A pressure that a source imposes: the effect and its text. Each bond has a source of its own.
    Source(usize, String),
}

/// Nodes and bonds.
#[derive(Clone, Debug, PartialEq)]
pub struct BondNetwork {
    /// The nodes.
    pub nodes: Vec<GraphNode>,
    /// The bonds.
    pub bonds: Vec<Bond>,
    /// Lines and sites at which effects act.
    pub ports: Vec<PlacePort>,
    /// The 1-junctions of the coordinates by name, including coordinates that effects add.
    velocities: Vec<(String, GraphNodeId)>,
    /// Joints that follow others: name, and each leader with the text of the ratio.
    followers: Vec<(String, Vec<(String, String)>)>,
    /// The coordinates that move each site.
    movers: BTreeMap<String, BTreeSet<CoordinateId>>,
    /// The links of each contact, without the world.
    contacts: BTreeMap<String, Vec<String>>,
    pressures: BTreeMap<String, NodePressure>,
    /// Names of the coordinates with a drive.
    driven: BTreeSet<String>,
    /// The effect that is adding nodes.
    at: Option<usize>,
}

impl BondNetwork {
    /// Returns a network without nodes.
    pub fn empty() -> Self {
        BondNetwork {
            nodes: Vec::new(),
            bonds: Vec::new(),
            ports: Vec::new(),
            velocities: Vec::new(),
            followers: Vec::new(),
            movers: BTreeMap::new(),
            contacts: BTreeMap::new(),
            pressures: BTreeMap::new(),
            driven: BTreeSet::new(),
            at: None,
        }
    }

    /// Returns the nodes and bonds of a mechanism. `driven` names the coordinates that have a drive,
    /// including coordinates that effects add.
    pub fn of_mechanism(graph: &BondGraph, driven: BTreeSet<String>) -> Self {
        let mut network = BondNetwork::empty();
        (network.movers, network.driven) = (movers(graph), driven);
        for (j, coordinate) in graph.coordinates.iter().enumerate() {
            let one = network.add_part(NodeKind::One, NodePart::Velocity(CoordinateId(j)));
            network.velocities.push((coordinate.name.clone(), one));
            if network.is_driven(&coordinate.name) {
                network.drive(&coordinate.name);
            }
        }
        for (i, junction) in graph.junctions.iter().enumerate() {
            if !matches!(junction, Junction::Velocity(_)) {
                network.add_flow(graph, JunctionId(i));
            }
        }
        network
    }

    /// Names a joint that follows others, and those with the texts of the ratios; an effect on it adds its junction.
    pub fn follow(&mut self, joint: &str, leaders: Vec<(String, String)>) {
        self.followers.push((joint.to_owned(), leaders));
    }

    /// Names a contact and its links, without the world; an effect at it adds its junction.
    pub fn touch(&mut self, contact: &str, links: &[&str]) {
        let links = links.iter().map(|link| (*link).to_owned());
        self.contacts.insert(contact.to_owned(), links.collect());
    }

    /// Adds the flow source of a prescribed joint to the junction of its velocity.
    pub fn prescribe(&mut self, joint: &str) {
        let velocity = self.velocity(joint);
        let NodePart::Velocity(j) = self.nodes[velocity.0].part else {
            return;
        };
        let source = self.add_part(NodeKind::FlowSource, NodePart::Drive(Some(j)));
        self.nodes[source.0].text = format!("motion of {joint}");
        self.bond(source, velocity);
    }

    /// Adds the 1-junction of a link's flow with its store, its source and its transformers.
    fn add_flow(&mut self, graph: &BondGraph, junction: JunctionId) {
        let one = self.add_part(NodeKind::One, NodePart::Flow(junction));
        for (k, _) in matching(&graph.stores, |s| s.junction == junction) {
            let store = self.add_part(NodeKind::Inertia, NodePart::Store(k));
            self.bond(one, store);
        }
        let acts = |s: &super::EffortSource| s.junction == junction && !s.efforts.is_empty();
        for (k, _) in matching(&graph.sources, acts) {
            let source = self.add_part(NodeKind::EffortSource, NodePart::Source(k));
            self.bond(source, one);
        }
        let all: Vec<(usize, GraphNodeId)> = matching(&graph.transformers, |t| t.to == junction)
            .map(|(k, t)| (k, self.velocities[t.from.0].1))
            .collect();
        let feeds: Vec<(NodePart, GraphNodeId)> = all
            .into_iter()
            .map(|(k, velocity)| (NodePart::Transformer(k), velocity))
            .collect();
        self.feed(one, &feeds, NodePart::Sum(junction));
    }

    /// Adds transformers from velocities to a flow; several transformers are joined by a 0-junction.
    fn feed(&mut self, one: GraphNodeId, transformers: &[(NodePart, GraphNodeId)], sum: NodePart) {
        let mut target = one;
        if transformers.len() > 1 {
            target = self.add_part(NodeKind::Zero, sum);
            self.bond(target, one);
        }
        for &(part, velocity) in transformers {
            let transformer = self.add_part(NodeKind::Transformer, part);
            self.bond(velocity, transformer);
            self.bond(transformer, target);
        }
    }

    /// Sets the effect that the following nodes belong to, by its index among the scene's elements.
    pub fn begin(&mut self, element: usize) {
        self.at = Some(element);
    }

    /// Adds a node without bonds.
    pub fn add(&mut self, kind: NodeKind, text: impl Into<String>) -> GraphNodeId {
        let id = GraphNodeId(self.nodes.len());
        self.nodes.push(GraphNode {
            kind,
            part: NodePart::Effect,
            text: text.into(),
            more: None,
            element: self.at,
            powers: kind.usual_powers(),
        });
        id
    }

    fn add_part(&mut self, kind: NodeKind, part: NodePart) -> GraphNodeId {
        let id = self.add(kind, "");
        let node = &mut self.nodes[id.0];
        (node.part, node.element, node.powers) = (part, None, vec![]);
        id
    }

    /// Adds a bond with positive power from `from` to `to`.
    pub fn bond(&mut self, from: GraphNodeId, to: GraphNodeId) {
        self.bonds.push(Bond { from, to });
    }

    /// Adds a source, a store or a resistor to a junction: power flows from sources, and to stores and
    /// resistors.
    pub fn add_on(
        &mut self,
        junction: GraphNodeId,
        kind: NodeKind,
        text: impl Into<String>,
    ) -> GraphNodeId {
        let node = self.add(kind, text);
        match kind.is_source() {
            true => self.bond(node, junction),
            false => self.bond(junction, node),
        }
        node
    }

    /// Sets the terms of a node in its effect's entry of the balance of power.
    pub fn set_powers(&mut self, node: GraphNodeId, powers: &[PowerTerm]) {
        self.nodes[node.0].powers = powers.to_vec();
    }

    /// Sets an additional note on a node.
    pub fn set_more(&mut self, node: GraphNodeId, more: Option<String>) {
        self.nodes[node.0].more = more;
    }

    /// Returns the 1-junction of the coordinate with this name. The junction of a coordinate that an
    /// effect adds is created at the first call; that of a joint that follows others likewise, with the
    /// transformers from those, and a 0-junction that adds their flows if there are several.
    pub fn velocity(&mut self, name: &str) -> GraphNodeId {
        if let Some((_, found)) = self.velocities.iter().find(|(own, _)| own == name) {
            return *found;
        }
        let follower = self.followers.iter().find(|(own, _)| own == name).cloned();
        let text = match follower {
            Some(_) => format!("q̇ {name}"),
            None => format!("θ̇ {name}"),
        };
        let one = self.add(NodeKind::One, text);
        self.velocities.push((name.to_owned(), one));
        let leaders = follower.map_or(vec![], |(_, leaders)| leaders);
        let end = match leaders.len() {
            0 | 1 => one,
            _ => {
                let sum = self.add(NodeKind::Zero, "Σ");
                self.bond(sum, one);
                sum
            }
        };
        for (leader, ratio) in leaders {
            let leading = self.velocity(&leader);
            let transformer = self.add(NodeKind::Transformer, ratio);
            self.bond(leading, transformer);
            self.bond(transformer, end);
        }
        one
    }

    /// Returns whether the coordinate with this name has a drive.
    pub fn is_driven(&self, coordinate: &str) -> bool {
        self.driven.contains(coordinate)
    }

    /// Returns the drive of the coordinate with this name.
    pub fn drive(&mut self, name: &str) -> GraphNodeId {
        let velocity = self.velocity(name);
        let joint = match self.nodes[velocity.0].part {
            NodePart::Velocity(j) => Some(j),
            _ => None,
        };
        let part = NodePart::Drive(joint);
        let own = |b: &&Bond| b.to == velocity && self.nodes[b.from.0].part == part;
        if let Some(bond) = self.bonds.iter().find(own) {
            return bond.from;
        }
        let drive = self.add_part(NodeKind::EffortSource, part);
        self.nodes[drive.0].text = format!("P of {name}");
        self.bond(drive, velocity);
        drive
    }

    /// Adds a transformer, a gear, between the drive of a coordinate and its junction.
    pub fn add_to_drive(&mut self, coordinate: &str, text: String) -> GraphNodeId {
        let drive = self.drive(coordinate);
        let gear = self.add(NodeKind::Transformer, text);
        let bond = self.bonds.iter_mut().find(|b| b.from == drive);
        bond.expect("a drive has a bond").from = gear;
        self.bond(drive, gear);
        gear
    }

    /// Returns the 1-junction of the flow at a site, with the transformers from the velocities that move
    /// it.
    pub fn port(&mut self, site: PortSite) -> GraphNodeId {
        if let Some(port) = self.ports.iter().find(|port| port.site == site) {
            return port.junction;
        }
        let of = |name: &String| self.movers.get(name).cloned().unwrap_or_default();
        let coordinates: BTreeSet<CoordinateId> = match &site {
            PortSite::Line([a, b]) => of(a).symmetric_difference(&of(b)).copied().collect(),
            PortSite::Site(name) => of(name),
            PortSite::Loop(_) => BTreeSet::new(),
            PortSite::Contact(name) => {
                let links = self.contacts.get(name).into_iter().flatten();
                links.fold(BTreeSet::new(), |moved, link| {
                    moved.symmetric_difference(&of(link)).copied().collect()
                })
            }
        };
        self.add_port(site, coordinates)
    }

    /// Adds the flows of loops: the velocity of place b relative to place a, with a flow source 0.
    pub fn close(&mut self, closure: &Closure) {
        for (closes, one) in closure.loops.iter().enumerate() {
            let site = PortSite::Loop(one.name.clone());
            let junction = self.add_port(site, one.velocities().collect());
            let of_loop = |rows: &[LoopRow]| {
                let own = rows.iter().filter(|row| row.closes == closes);
                own.map(|row| row.name).collect::<Vec<_>>().join(", ")
            };
            let source = self.add_on(junction, NodeKind::FlowSource, "0, effort λ");
            let dropped = of_loop(&closure.dropped);
            let following: Vec<LoopRow> = closure.following.iter().map(|one| one.row).collect();
            let following = of_loop(&following);
            let mut more = of_loop(&closure.rows);
            for (what, rows) in [("always 0", dropped), ("following", following)] {
                if !rows.is_empty() {
                    more += &format!("; {what}: {rows}");
                }
            }
            self.set_more(source, Some(more));
        }
    }

    /// Adds the 1-junction of a flow, with a transformer from each of these velocities.
    fn add_port(&mut self, site: PortSite, coordinates: BTreeSet<CoordinateId>) -> GraphNodeId {
        let part = NodePart::Port(self.ports.len());
        let junction = self.add_part(NodeKind::One, part);
        let feeds: Vec<(NodePart, GraphNodeId)> = coordinates
            .iter()
            .map(|j| (part, self.velocities[j.0].1))
            .collect();
        self.feed(junction, &feeds, part);
        self.ports.push(PlacePort {
            site,
            coordinates,
            junction,
        });
        junction
    }

    /// Returns whether any velocity moves a site.
    pub fn moves(&self, site: &str) -> bool {
        self.movers
            .get(site)
            .is_some_and(|movers| !movers.is_empty())
    }

    /// Adds the 0-junction of the pressure of a hydraulic node of the effect.
    pub fn add_pressure(&mut self, node: &str) -> GraphNodeId {
        let zero = self.add(NodeKind::Zero, node);
        self.pressures
            .insert(node.to_owned(), NodePressure::Junction(zero));
        zero
    }

    /// Adds a hydraulic node whose pressure the effect imposes.
    pub fn hold_pressure(&mut self, node: &str, text: String) {
        let source = NodePressure::Source(self.at.unwrap_or_default(), text);
        self.pressures.insert(node.to_owned(), source);
    }

    /// Returns the pressure of a hydraulic node: its 0-junction, or a new source for each call.
    pub fn pressure(&mut self, node: &str) -> GraphNodeId {
        match self.pressures.get(node).cloned() {
            Some(NodePressure::Junction(zero)) => zero,
            Some(NodePressure::Source(element, text)) => {
                let source = self.add(NodeKind::EffortSource, text);
                self.nodes[source.0].element = Some(element);
                source
            }
            None => self.add_pressure(node),
        }
    }

    /// Assigns the weights of the links to the effect; their energy counts as stored.
    pub fn claim_weights(&mut self) {
        for node in &mut self.nodes {
            if let NodePart::Source(_) = node.part {
                (node.element, node.powers) = (self.at, vec![PowerTerm::Stored]);
            }
        }
    }

    /// Returns all nodes.
    pub fn ids(&self) -> impl Iterator<Item = GraphNodeId> + use<> {
        (0..self.nodes.len()).map(GraphNodeId)
    }

    /// Returns the bonds at a node with their indices, in the order in which they were added.
    pub fn bonds_at(&self, node: GraphNodeId) -> impl Iterator<Item = (usize, &Bond)> {
        matching(&self.bonds, move |bond| bond.joins(node))
    }

    /// Returns the node of this part of the mechanism.
    pub fn part(&self, part: NodePart) -> Option<GraphNodeId> {
        let found = self.nodes.iter().position(|node| node.part == part);
        found.map(GraphNodeId)
    }

    /// Returns the terms of an effect's nodes in its entry of the balance of power.
    pub fn powers_of(&self, element: usize) -> impl Iterator<Item = PowerTerm> {
        let own = self
            .nodes
            .iter()
            .filter(move |n| n.element == Some(element));
        own.flat_map(|node| node.powers.iter().copied())
    }
}

/// Returns the items that match, with their indices.
fn matching<'a, T>(
    all: &'a [T],
    fits: impl Fn(&T) -> bool + 'a,
) -> impl Iterator<Item = (usize, &'a T)> {
    all.iter().enumerate().filter(move |(_, x)| fits(x))
}

/// Returns the coordinates that move each site.
fn movers(graph: &BondGraph) -> BTreeMap<String, BTreeSet<CoordinateId>> {
    let of_link = |mut link: Option<LinkId>| {
        let mut found = BTreeSet::new();
        while let Some(LinkId(i)) = link {
            found.extend(&graph.frames[i].degrees.velocities);
            link = graph.frames[i].parent;
        }
        found
    };
    let of = |site: &super::Site| (site.name.clone(), of_link(site.link));
    graph.sites.iter().map(of).collect()
}

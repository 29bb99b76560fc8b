//! Nodes and bonds of a bond graph: junctions, stores, resistors, transformers, gyrators and sources.

use std::collections::BTreeSet;

use super::JunctionId;
use crate::mechanism::CoordinateId;

/// An index into [`BondNetwork::nodes`](super::BondNetwork::nodes).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct GraphNodeId(pub usize);

/// The kind of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeKind {
    /// 1-junction: one flow, the efforts sum to zero.
    One,
    /// 0-junction: one effort, the flows sum to zero.
    Zero,
    /// Inertial store: its state determines the flow.
    Inertia,
    /// Compliance: its state determines the effort.
    Compliance,
    /// Resistor: an algebraic law between effort and flow.
    Resistor,
    /// Transformer: effort to effort, flow to flow.
    Transformer,
    /// Gyrator: effort to flow, flow to effort.
    Gyrator,
    /// Source of effort.
    EffortSource,
    /// Source of flow.
    FlowSource,
}

impl NodeKind {
    /// Returns the symbol in a bond graph: `1`, `0`, `I`, `C`, `R`, `TF`, `GY`, `Se`, `Sf`.
    pub fn symbol(self) -> &'static str {
        match self {
            NodeKind::One => "1",
            NodeKind::Zero => "0",
            NodeKind::Inertia => "I",
            NodeKind::Compliance => "C",
            NodeKind::Resistor => "R",
            NodeKind::Transformer => "TF",
            NodeKind::Gyrator => "GY",
            NodeKind::EffortSource => "Se",
            NodeKind::FlowSource => "Sf",
        }
    }

    /// Returns whether it is a junction.
    pub fn is_junction(self) -> bool {
        matches!(self, NodeKind::One | NodeKind::Zero)
    }

    /// Returns whether it is a source, from which positive power flows.
    pub(super) fn is_source(self) -> bool {
        matches!(self, NodeKind::EffortSource | NodeKind::FlowSource)
    }

    /// Returns the default terms in the balance of power.
    pub(super) fn usual_powers(self) -> Vec<PowerTerm> {
        match self {
            NodeKind::Inertia | NodeKind::Compliance => vec![PowerTerm::Stored],
            NodeKind::Resistor => vec![PowerTerm::Dissipated],
            NodeKind::EffortSource | NodeKind::FlowSource => vec![PowerTerm::Supplied],
            NodeKind::One | NodeKind::Zero | NodeKind::Transformer | NodeKind::Gyrator => vec![],
        }
    }
}

/// A term of the balance of power.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PowerTerm {
    /// Power from outside.
    Supplied,
    /// Rate of a stored energy.
    Stored,
    /// Dissipated power.
    Dissipated,
}

/// The part of the mechanism or of a scene that a node represents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodePart {
    /// The 1-junction of q̇_j.
    Velocity(CoordinateId),
    /// The drive of a coordinate: its effort is an input or an unknown, or its flow is given; with the
    /// coordinate's index if it belongs to a joint.
    Drive(Option<CoordinateId>),
    /// The 1-junction of a link's flow, by its index in
    /// [`BondGraph::junctions`](super::BondGraph::junctions).
    Flow(JunctionId),
    /// The 0-junction before that flow, if several transformers feed it.
    Sum(JunctionId),
    /// A transformer, by its index in [`BondGraph::transformers`](super::BondGraph::transformers).
    Transformer(usize),
    /// A store of a link, by its index in [`BondGraph::stores`](super::BondGraph::stores).
    Store(usize),
    /// A source on a link, by its index in [`BondGraph::sources`](super::BondGraph::sources).
    Source(usize),
    /// What joins a velocity and the flow at one of [`BondNetwork::ports`](super::BondNetwork::ports), or sums these flows.
    Port(usize),
    /// An element of an effect.
    Effect,
}

/// A node.
#[derive(Clone, Debug, PartialEq)]
pub struct GraphNode {
    /// The kind.
    pub kind: NodeKind,
    /// The part of the mechanism or of a scene.
    pub part: NodePart,
    /// Its name and its number as in the file; empty for parts of links.
    pub text: String,
    /// An additional note for the reader.
    pub more: Option<String>,
    /// The effect that it belongs to, by its index among the scene's elements.
    pub element: Option<usize>,
    /// Its terms in the effect's entry of the balance of power.
    pub powers: Vec<PowerTerm>,
}

/// A bond: positive power flows from one node to the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bond {
    /// The node that power flows from.
    pub from: GraphNodeId,
    /// The node that power flows to, with the half arrow.
    pub to: GraphNodeId,
}

impl Bond {
    /// Returns the node at the other end.
    pub fn other(&self, node: GraphNodeId) -> GraphNodeId {
        if self.from == node {
            self.to
        } else {
            self.from
        }
    }

    /// Returns whether a node is at one of its ends.
    pub fn joins(&self, node: GraphNodeId) -> bool {
        self.from == node || self.to == node
    }
}

/// The site of an effect that acts on no coordinate directly.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PortSite {
    /// The line between two sites: its flow is the rate of the length, m/s.
    Line([String; 2]),
    /// The origin of a site on a link: its flow is [ω; v], rad/s and m/s.
    Site(String),
    /// A loop: its flow is the velocity of place b relative to place a, rad/s and m/s.
    Loop(String),
    /// A contact: its flow is the velocity of the sphere relative to its partner at the contact point, m/s.
    Contact(String),
}

/// The flow at a site, with the transformers from the velocities that move it.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacePort {
    /// The site.
    pub site: PortSite,
    /// The coordinates that move it.
    pub coordinates: BTreeSet<CoordinateId>,
    /// The 1-junction of its flow.
    pub junction: GraphNodeId,
}

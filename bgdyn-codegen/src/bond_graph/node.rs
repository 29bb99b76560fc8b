//! Nodes and bonds of a bond graph: junctions, stores, resistors, transformers, gyrators and sources.

use std::collections::BTreeSet;

use super::JunctionId;
use crate::mechanism::CoordinateId;

/// A node of [`BondNetwork::nodes`](super::BondNetwork::nodes).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct GraphNodeId(pub usize);

/// What a node is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeKind {
    /// 1-junction: one flow, the efforts sum to zero.
    One,
    /// 0-junction: one effort, the flows sum to zero.
    Zero,
    /// Inertial store: its state gives the flow.
    Inertia,
    /// Compliance: its state gives the effort.
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
    /// The sign of a bond graph: `1`, `0`, `I`, `C`, `R`, `TF`, `GY`, `Se`, `Sf`.
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

    /// Whether it is a junction.
    pub fn is_junction(self) -> bool {
        matches!(self, NodeKind::One | NodeKind::Zero)
    }

    /// Whether positive power flows from it by convention.
    pub(super) fn is_source(self) -> bool {
        matches!(self, NodeKind::EffortSource | NodeKind::FlowSource)
    }

    /// What it does in the balance of power if nothing else is said.
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
    /// PowerTerm that comes from outside.
    Supplied,
    /// Rate of a stored energy.
    Stored,
    /// PowerTerm that is lost.
    Dissipated,
}

/// What of the mechanism or of a scene a node is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodePart {
    /// The 1-junction of q̇_j.
    Velocity(CoordinateId),
    /// The effort of its own on a coordinate, an input or sought; with the joint's number, if it is one.
    Drive(Option<CoordinateId>),
    /// The 1-junction of a link's flow, by its number in [`BondGraph::junctions`](super::BondGraph::junctions).
    Flow(JunctionId),
    /// The 0-junction before it, where several transformers feed it.
    Sum(JunctionId),
    /// A transformer, by its place in [`BondGraph::transformers`](super::BondGraph::transformers).
    Transformer(usize),
    /// A store of a link, by its place in [`BondGraph::stores`](super::BondGraph::stores).
    Store(usize),
    /// A source on a link, by its place in [`BondGraph::sources`](super::BondGraph::sources).
    Source(usize),
    /// What joins a velocity and the flow at a place of [`BondNetwork::ports`](super::BondNetwork::ports), or sums these flows.
    Port(usize),
    /// An element of an effect.
    Effect,
}

/// A node.
#[derive(Clone, Debug, PartialEq)]
pub struct GraphNode {
    /// What it is.
    pub kind: NodeKind,
    /// What of the mechanism or of a scene it is.
    pub part: NodePart,
    /// Its name and its number as the file writes it; empty for the parts of links.
    pub text: String,
    /// What else a reader should know of it.
    pub more: Option<String>,
    /// The effect that it belongs to, by its place among the scene's elements.
    pub element: Option<usize>,
    /// Its terms in the effect's entry of the balance of power.
    pub powers: Vec<PowerTerm>,
}

/// A bond: positive power flows from the one to the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bond {
    /// Where the power comes from.
    pub from: GraphNodeId,
    /// Where the half arrow is.
    pub to: GraphNodeId,
}

impl Bond {
    /// The node at the other end.
    pub fn other(&self, node: GraphNodeId) -> GraphNodeId {
        if self.from == node {
            self.to
        } else {
            self.from
        }
    }

    /// Whether it ends at a node.
    pub fn joins(&self, node: GraphNodeId) -> bool {
        self.from == node || self.to == node
    }
}

/// Where an effect acts that acts on no coordinate of its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PortSite {
    /// Along the line between two places: its flow is the rate of the length, m/s.
    Line([String; 2]),
    /// On a link, at the origin of a place: its flow is [ω; v], rad/s and m/s.
    Site(String),
}

/// The flow at a place, with the transformers from the velocities that move it.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacePort {
    /// Where.
    pub place: PortSite,
    /// The coordinates that change it.
    pub coordinates: BTreeSet<CoordinateId>,
    /// The 1-junction of its flow.
    pub junction: GraphNodeId,
}

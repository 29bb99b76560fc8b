//! Assigns causal strokes to a bond graph by the sequential procedure of Karnopp, Margolis and Rosenberg.
//!
//! The stroke of a bond is at the end on which the effort acts. The procedure assigns sources first, then
//! stores with their state as the cause (integral causality), then resistors. It propagates each choice
//! through the junctions, transformers and gyrators before it makes the next one. A store whose state
//! follows from other states has derivative causality. If a resistor's causality had to be chosen, the
//! resistors that depend on this choice are an algebraic loop. A junction whose flow (1) or effort (0) no
//! bond determines is a conflict.
//!
//! The velocities q̇ of a mechanism are given: their store is the inertia of all links together, the mass
//! matrix. So the stores of links have derivative causality, and the drive of a joint has no stroke:
//! inverse dynamics computes the effort from q̇, forward dynamics has the effort as an argument. A
//! separate store on the junction of q̇, such as a rotor, determines the flow, and so does the flow source of a
//! prescribed joint.

use super::network::BondNetwork;
use super::node::{GraphNodeId, NodeKind, NodePart};

/// The causal strokes of a network, with its dependent stores, algebraic loops and conflicts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Causality {
    /// For each bond, the node at the end with the stroke; `None` for the bonds of drives.
    pub strokes: Vec<Option<GraphNodeId>>,
    /// Stores in derivative causality.
    pub dependent: Vec<GraphNodeId>,
    /// Algebraic loops: the resistors of each loop, and the junctions between them.
    pub loops: Vec<Vec<GraphNodeId>>,
    /// Junctions, transformers and gyrators whose bonds contradict each other.
    pub conflicts: Vec<GraphNodeId>,
}

impl Causality {
    /// Assigns the strokes of a network.
    pub fn of(network: &BondNetwork) -> Self {
        let mut pass = Pass::new(network);
        pass.sources();
        pass.stores();
        pass.resistors();
        pass.finish()
    }
}

struct Pass<'a> {
    network: &'a BondNetwork,
    /// The bonds of each node.
    bonds: Vec<Vec<usize>>,
    strokes: Vec<Option<GraphNodeId>>,
    /// 1-junctions whose flow is given, and not determined by a bond.
    given: Vec<bool>,
    /// Bonds of drives, which have no stroke.
    open: Vec<bool>,
    /// Nodes whose bonds changed and that are not processed yet.
    waiting: Vec<GraphNodeId>,
    loops: Vec<Vec<GraphNodeId>>,
    conflicts: Vec<GraphNodeId>,
}

impl<'a> Pass<'a> {
    fn new(network: &'a BondNetwork) -> Self {
        let mut bonds = vec![Vec::new(); network.nodes.len()];
        for (b, bond) in network.bonds.iter().enumerate() {
            bonds[bond.from.0].push(b);
            bonds[bond.to.0].push(b);
        }
        let mut pass = Pass {
            network,
            bonds,
            strokes: vec![None; network.bonds.len()],
            given: vec![false; network.nodes.len()],
            open: vec![false; network.bonds.len()],
            waiting: Vec::new(),
            loops: Vec::new(),
            conflicts: Vec::new(),
        };
        pass.velocities();
        pass
    }

    fn kind(&self, node: GraphNodeId) -> NodeKind {
        self.network.nodes[node.0].kind
    }

    fn other(&self, bond: usize, node: GraphNodeId) -> GraphNodeId {
        self.network.bonds[bond].other(node)
    }

    /// Marks the given flows: velocities without a store of their own, and flows of links at rest.
    fn velocities(&mut self) {
        for node in self.network.ids() {
            let at = |kind| {
                let mut all = self.bonds[node.0].iter();
                all.any(|&b| self.kind(self.other(b, node)) == kind)
            };
            self.given[node.0] = match self.network.nodes[node.0].part {
                NodePart::Velocity(_) => !at(NodeKind::Inertia) && !at(NodeKind::FlowSource),
                NodePart::Flow(_) | NodePart::Port(_) if self.kind(node) == NodeKind::One => {
                    !at(NodeKind::Transformer) && !at(NodeKind::Zero)
                }
                _ => false,
            };
        }
        for node in self.network.ids() {
            if let NodePart::Drive(_) = self.network.nodes[node.0].part {
                self.open_drive(node);
            }
        }
        self.waiting = self.network.ids().filter(|n| self.given[n.0]).collect();
        self.follow();
    }

    /// Leaves the bonds from a drive to a given velocity without strokes.
    fn open_drive(&mut self, drive: GraphNodeId) {
        let (mut node, mut way) = (drive, Vec::new());
        while let Some(&bond) = self.bonds[node.0].iter().find(|b| !way.contains(*b)) {
            way.push(bond);
            node = self.other(bond, node);
            if self.kind(node) != NodeKind::Transformer {
                break;
            }
        }
        if self.given[node.0] {
            way.into_iter().for_each(|bond| self.open[bond] = true);
        }
    }

    fn sources(&mut self) {
        for node in self.network.ids() {
            for bond in self.bonds[node.0].clone() {
                match self.kind(node) {
                    NodeKind::EffortSource => self.set(bond, self.other(bond, node)),
                    NodeKind::FlowSource => self.set(bond, node),
                    _ => {}
                }
            }
        }
        self.follow();
    }

    /// Assigns integral causality to the stores without causality: the effort acts on an inertia, and
    /// comes from a compliance. The stores of the links come last.
    fn stores(&mut self) {
        let is_link =
            |node: &GraphNodeId| matches!(self.network.nodes[node.0].part, NodePart::Store(_));
        let (links, others): (Vec<_>, Vec<_>) = self.network.ids().partition(is_link);
        for node in others.into_iter().chain(links) {
            for bond in self.bonds[node.0].clone() {
                if self.strokes[bond].is_none() {
                    match self.kind(node) {
                        NodeKind::Inertia => self.set(bond, node),
                        NodeKind::Compliance => self.set(bond, self.other(bond, node)),
                        _ => continue,
                    }
                    self.follow();
                }
            }
        }
    }

    /// Assigns causality to the remaining resistors: each determines the flow of a 1-junction, or the
    /// effort of a 0-junction.
    fn resistors(&mut self) {
        for node in self.network.ids() {
            let [bond] = self.bonds[node.0][..] else {
                continue;
            };
            if self.kind(node) == NodeKind::Resistor && self.strokes[bond].is_none() {
                let junction = self.other(bond, node);
                let before = self.strokes.clone();
                match self.kind(junction) {
                    NodeKind::Zero => self.set(bond, junction),
                    _ => self.set(bond, node),
                }
                self.follow();
                self.note_loop(&before);
            }
        }
        for bond in 0..self.strokes.len() {
            if self.strokes[bond].is_none() && !self.open[bond] {
                let before = self.strokes.clone();
                self.set(bond, self.network.bonds[bond].to);
                self.follow();
                self.note_loop(&before);
            }
        }
    }

    /// Records an algebraic loop if one choice determined more than one element.
    fn note_loop(&mut self, before: &[Option<GraphNodeId>]) {
        let changed = (0..before.len()).filter(|&b| before[b] != self.strokes[b]);
        let ends = changed.flat_map(|b| {
            let bond = self.network.bonds[b];
            [bond.from, bond.to]
        });
        let mut members: Vec<GraphNodeId> = ends.collect();
        members.sort();
        members.dedup();
        let resistors = members
            .iter()
            .filter(|n| self.kind(**n) == NodeKind::Resistor);
        if resistors.count() != 1 {
            self.loops.push(members);
        }
    }

    fn set(&mut self, bond: usize, stroke: GraphNodeId) {
        if self.open[bond] {
            return;
        }
        match self.strokes[bond] {
            None => {
                self.strokes[bond] = Some(stroke);
                let ends = self.network.bonds[bond];
                self.waiting.extend([ends.from, ends.to]);
            }
            Some(own) if own == stroke => {}
            Some(own) => {
                let at = [own, stroke].into_iter().find(|n| !self.is_one_port(*n));
                self.conflicts.extend(at);
            }
        }
    }

    fn is_one_port(&self, node: GraphNodeId) -> bool {
        !self.kind(node).is_junction()
            && !matches!(self.kind(node), NodeKind::Transformer | NodeKind::Gyrator)
    }

    /// Propagates assigned strokes through the nodes.
    fn follow(&mut self) {
        while let Some(node) = self.waiting.pop() {
            match self.kind(node) {
                NodeKind::One => self.junction(node, false),
                NodeKind::Zero => self.junction(node, true),
                NodeKind::Transformer => self.two_port(node, true),
                NodeKind::Gyrator => self.two_port(node, false),
                _ => {}
            }
        }
    }

    /// Assigns strokes at a junction, where one bond determines the common variable: the flow of a
    /// 1-junction, by a bond whose effort acts on the other end; the effort of a 0-junction.
    fn junction(&mut self, node: GraphNodeId, is_zero: bool) {
        let bonds = self.bonds[node.0].clone();
        let brings = |b: &usize| self.strokes[*b].map(|s| (s == node) == is_zero);
        let one = bonds.iter().copied().find(|b| brings(b) == Some(true));
        let undecided: Vec<usize> = bonds
            .iter()
            .copied()
            .filter(|b| self.strokes[*b].is_none())
            .collect();
        if one.is_some() || self.given[node.0] {
            for bond in bonds {
                if Some(bond) != one || self.given[node.0] {
                    self.set(bond, self.end(bond, node, !is_zero));
                }
            }
        } else if let [last] = undecided[..] {
            self.set(last, self.end(last, node, is_zero));
        } else if undecided.is_empty() && !bonds.is_empty() {
            self.conflicts.push(node);
        }
    }

    /// Returns the node itself, or the node at the other end of the bond.
    fn end(&self, bond: usize, node: GraphNodeId, own: bool) -> GraphNodeId {
        match own {
            true => node,
            false => self.other(bond, node),
        }
    }

    /// Assigns strokes at a two-port: at a transformer the effort acts on one end, at a gyrator on both or
    /// on none.
    fn two_port(&mut self, node: GraphNodeId, is_transformer: bool) {
        let [a, b] = self.bonds[node.0][..] else {
            return;
        };
        for (one, other) in [(a, b), (b, a)] {
            if let Some(stroke) = self.strokes[one] {
                let own = (stroke == node) != is_transformer;
                self.set(other, self.end(other, node, own));
            }
        }
    }

    fn finish(mut self) -> Causality {
        let derivative = |node: &GraphNodeId| {
            let mut strokes = self.bonds[node.0].iter().map(|b| self.strokes[*b]);
            match self.kind(*node) {
                NodeKind::Inertia => strokes.any(|s| s.is_some_and(|s| s != *node)),
                NodeKind::Compliance => strokes.any(|s| s == Some(*node)),
                _ => false,
            }
        };
        let dependent = self.network.ids().filter(derivative).collect();
        self.conflicts.sort();
        self.conflicts.dedup();
        Causality {
            strokes: self.strokes,
            dependent,
            loops: self.loops,
            conflicts: self.conflicts,
        }
    }
}

//! Pieces of code with their operator precedence, and the names of leaves.

use std::collections::BTreeSet;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::actuated::actuated_names;
use super::tokens::ident;
use crate::expr::{Graph, Leaf, Node, NodeId, Signed, reachable};
use crate::interface::SceneInterface;
use crate::method::Argument;
use crate::model::Model;
use crate::scene::{StateLayout, Variable};

/// Operator precedence of a piece of code.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    Sum,
    Product,
    Atom,
}

/// A piece of code for a node, without the sign that its user applies.
#[derive(Clone)]
pub(super) struct Code {
    pub(super) tokens: TokenStream,
    pub(super) binding: Binding,
    pub(super) operations: usize,
}

/// Code that never needs parentheses.
pub(super) fn atom(tokens: TokenStream) -> Code {
    Code {
        tokens,
        binding: Binding::Atom,
        operations: 0,
    }
}

/// The variables that hold the sine and cosine of an angle.
#[derive(Clone)]
pub(super) struct SinePair {
    pub(super) sine: Ident,
    pub(super) cosine: Ident,
}

/// Returns whether a leaf is part of an argument with named parts.
pub(super) fn is_part(argument: Argument, leaf: Leaf) -> bool {
    match argument {
        Argument::State => matches!(
            leaf,
            Leaf::Position(_) | Leaf::Velocity(_) | Leaf::State(_) | Leaf::Mode(_)
        ),
        Argument::Input => matches!(leaf, Leaf::Input(_)),
        Argument::Accelerations => matches!(leaf, Leaf::Acceleration(_)),
        Argument::Time => leaf == Leaf::Time,
        Argument::Q | Argument::V | Argument::A | Argument::Tau => false,
        Argument::TreeV | Argument::TreeTau | Argument::ActuatedTau => false,
        Argument::Canonical | Argument::Modes => false,
    }
}

/// The names of a function's leaves.
pub(super) struct Naming<'a> {
    /// Positions.
    pub(super) positions: Vec<&'a str>,
    /// Coordinates.
    pub(super) joints: Vec<&'a str>,
    /// Coordinates of the open tree of a mechanism with loops.
    pub(super) tree_joints: Vec<&'a str>,
    /// The actuated joints of a mechanism with loops, where they are not the independent ones.
    pub(super) actuated: Vec<&'a str>,
    /// Run-time parameters.
    pub(super) parameters: Vec<&'a str>,
    /// The parts of a scene's state and inputs; `None` for a mechanism.
    pub(super) layout: Option<&'a StateLayout>,
    /// Whether formulas use infix operators.
    pub(super) plain: bool,
}

impl<'a> Naming<'a> {
    /// Names for a mechanism's functions.
    pub(super) fn of_model(model: &'a Model, plain: bool) -> Self {
        let coordinates = model.bond_graph.coordinates.iter();
        let parameters = model.mechanism.parameters().iter();
        let positions = model.bond_graph.positions.iter();
        let closed = model.bond_graph.closed.iter();
        let of_tree = closed.flat_map(|closed| &closed.tree.coordinates);
        Naming {
            tree_joints: of_tree.map(|c| c.name.as_str()).collect(),
            actuated: (model.bond_graph.closed.as_deref()).map_or_else(Vec::new, actuated_names),
            positions: positions.map(|p| p.name.as_str()).collect(),
            joints: coordinates.map(|c| c.name.as_str()).collect(),
            parameters: parameters.map(|p| p.name.as_str()).collect(),
            layout: None,
            plain,
        }
    }

    /// Names for a scene's functions.
    pub(super) fn of_scene(scene: &'a SceneInterface, plain: bool) -> Self {
        let coordinates = scene.layout.coordinates.iter();
        let joints: Vec<&str> = coordinates.map(|c| c.name.as_str()).collect();
        Naming {
            positions: scene
                .layout
                .positions
                .iter()
                .map(|p| p.name.as_str())
                .collect(),
            joints,
            tree_joints: Vec::new(),
            actuated: Vec::new(),
            parameters: scene.parameters.iter().map(|p| p.name.as_str()).collect(),
            layout: Some(&scene.layout),
            plain,
        }
    }

    /// Returns the leaves of an argument's components with names of variables for them; empty for an
    /// argument with named parts.
    pub(super) fn components(&self, argument: Argument) -> Vec<(Leaf, String)> {
        let named = |all: &[&str], leaf: fn(usize) -> Leaf| {
            let names = all.iter().enumerate();
            let named =
                |(j, name): (usize, &&str)| (leaf(j), format!("{}_{name}", argument.name()));
            names.map(named).collect()
        };
        let of_joints = |leaf| named(&self.joints, leaf);
        match (argument, self.layout) {
            (Argument::Q, _) => named(&self.positions, Leaf::Position),
            (Argument::V, _) => of_joints(Leaf::Velocity),
            (Argument::A, _) => of_joints(Leaf::Acceleration),
            (Argument::Tau, _) => of_joints(Leaf::Input),
            (Argument::TreeV, _) => named(&self.tree_joints, Leaf::Velocity),
            (Argument::TreeTau, _) => named(&self.tree_joints, Leaf::Input),
            (Argument::ActuatedTau, _) => named(&self.actuated, Leaf::Input),
            (Argument::Canonical, Some(layout)) => {
                let names = layout.coordinates.iter().map(|c| &c.name).enumerate();
                let places = layout.positions.iter().map(|p| &p.name).enumerate();
                let places = places.map(|(j, name)| (Leaf::Position(j), format!("q_{name}")));
                let momenta = names.map(|(j, name)| (Leaf::Velocity(j), format!("p_{name}")));
                let states = layout.states.iter().enumerate();
                let states = states.map(|(i, s)| (Leaf::State(i), format!("x_{}", s.name)));
                places.chain(momenta).chain(states).collect()
            }
            (Argument::Modes, Some(layout)) => {
                let modes = layout.modes.iter().enumerate();
                let named =
                    |(i, m): (usize, &Variable)| (Leaf::Mode(i), format!("{}_mode", m.name));
                modes.map(named).collect()
            }
            _ => vec![],
        }
    }

    /// Returns the field of a leaf of a scene.
    pub(super) fn field(&self, leaf: Leaf) -> Option<TokenStream> {
        let layout = self.layout?;
        let of = |whole: &str, part: &str| {
            let (whole, part) = (ident(whole), ident(part));
            quote! { #whole.#part }
        };
        Some(match leaf {
            Leaf::Position(p) => of("state", &layout.positions[p].name),
            Leaf::Velocity(j) => of("state", &layout.coordinates[j].rate_name),
            Leaf::State(i) => of("state", &layout.states[i].name),
            Leaf::Mode(i) => of("state", &format!("{}_mode", layout.modes[i].name)),
            Leaf::Acceleration(j) => of("acceleration", &layout.coordinates[j].name),
            Leaf::Input(i) => of("input", &layout.inputs[i].name),
            Leaf::Time => quote! { t },
            Leaf::Parameter(_) | Leaf::BlockResult { .. } => return None,
        })
    }
}

/// Returns the leaves that the outputs read.
pub(super) fn leaves(graph: &Graph, outputs: &[Signed]) -> BTreeSet<Leaf> {
    let needed = reachable(graph, outputs);
    let nodes = (0..needed.len())
        .filter(|&i| needed[i])
        .map(|i| graph.node(NodeId(i as u32)));
    nodes
        .filter_map(|n| {
            if let Node::Leaf(leaf) = n {
                Some(*leaf)
            } else {
                None
            }
        })
        .collect()
}

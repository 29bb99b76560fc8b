//! Which arguments, parameters and results of earlier blocks a function reads, and which it does not.

use std::collections::BTreeSet;

use super::naming::Naming;
use crate::expr::{Graph, Leaf, Node, NodeId, Signed, reachable};
use crate::function::{Block, Function};
use crate::mechanism::closure::Closure;
use crate::method::Argument;
use crate::model::Model;

/// Returns the leaves that the outputs read.
pub fn leaves(graph: &Graph, outputs: &[Signed]) -> BTreeSet<Leaf> {
    let needed = reachable(graph, outputs);
    let needed = (0..needed.len()).filter(|&i| needed[i]);
    let leaf = |i| match graph.node(NodeId::at(i)) {
        Node::Leaf(leaf) => Some(*leaf),
        _ => None,
    };
    needed.filter_map(leaf).collect()
}

/// Returns the leaves that any block of a function reads.
pub fn leaves_of(function: &Function) -> BTreeSet<Leaf> {
    let of_block = |b: &Block| leaves(&function.graph, &b.outputs);
    function.blocks.iter().flat_map(of_block).collect()
}

/// Returns whether a function reads a position of a dependent joint; one in closed form does not.
pub fn reads_dependents(function: &Function, closure: &Closure) -> bool {
    let read = leaves_of(function);
    let own = closure.dependents().filter_map(|j| closure.positions[j.0]);
    let compounds = closure.compounds.iter();
    let mut positions =
        own.chain(compounds.flat_map(|joint| joint.degrees.positions.iter().copied()));
    positions.any(|p| read.contains(&Leaf::Position(p.0)))
}

/// Returns the names that a function does not read: arguments, as `q[joint]`, and run-time parameters.
pub fn unread(function: &Function, model: &Model) -> Vec<String> {
    let read = leaves_of(function);
    let mut unread = Vec::new();
    let naming = Naming::of_model(model);
    for argument in function.method.arguments() {
        let components = naming.components(*argument);
        let is_read = |j: usize| read.contains(&components[j].0);
        let joints = naming.component_names(*argument);
        let missing: Vec<_> = (0..joints.len()).filter(|&j| !is_read(j)).collect();
        if missing.len() == joints.len() {
            unread.push(format!("`{}`", argument.name()));
        } else {
            let name = |&j: &usize| format!("`{}[{j}]` ({})", argument.name(), joints[j]);
            unread.extend(missing.iter().map(name));
        }
    }
    let parameters = model.mechanism.parameters().iter().enumerate();
    let missing = parameters.filter(|(p, _)| !read.contains(&Leaf::Parameter(*p)));
    unread.extend(missing.map(|(_, parameter)| format!("the parameter `{}`", parameter.name)));
    unread
}

/// Returns whether a leaf is part of an argument with named parts.
pub fn is_part(argument: Argument, leaf: Leaf) -> bool {
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
        Argument::ReferenceV | Argument::ReferenceA => false,
        Argument::Direction | Argument::BodyParameters => false,
        Argument::AlongQ | Argument::AlongV | Argument::AlongA | Argument::AlongTau => false,
        Argument::Cotangent => false,
        Argument::Canonical | Argument::Modes => false,
    }
}

//! The names of a function's arguments, parameters and their components.

use crate::bond_graph::ClosedTree;
use crate::expr::Leaf;
use crate::interface::SceneInterface;
use crate::layout::{StateLayout, Variable};
use crate::method::{Argument, PARAMETER_NAMES};
use crate::model::Model;

/// An argument with named components: of each component its leaf, and the name of its variable if it is read.
#[derive(Clone, Debug)]
pub struct ArgumentNames {
    /// The argument.
    pub argument: Argument,
    /// Its components in order.
    pub components: Vec<(Leaf, Option<String>)>,
}

/// The names of a function's leaves.
pub struct Naming<'a> {
    /// Positions.
    pub positions: Vec<&'a str>,
    /// Coordinates.
    pub joints: Vec<&'a str>,
    /// Coordinates of the open tree of a mechanism with loops.
    pub tree_joints: Vec<&'a str>,
    /// The actuated joints of a mechanism with loops, where they are not the independent ones.
    pub actuated: Vec<&'a str>,
    /// The bodies of regressors.
    pub bodies: Vec<&'a str>,
    /// Run-time parameters.
    pub parameters: Vec<&'a str>,
    /// The parts of a scene's state and inputs; `None` for a mechanism.
    pub layout: Option<&'a StateLayout>,
    /// Whether a scene's state, inputs and accelerations are arrays, whose components have names like those of a
    /// mechanism's arguments.
    pub arrays: bool,
}

impl<'a> Naming<'a> {
    /// Returns the names for a mechanism's functions.
    pub fn of_model(model: &'a Model) -> Self {
        let coordinates = model.bond_graph.coordinates.iter();
        let parameters = model.mechanism.parameters().iter();
        let positions = model.bond_graph.positions.iter();
        let closed = model.bond_graph.closed.as_deref();
        let of_tree = closed.iter().flat_map(|closed| &closed.tree.coordinates);
        let drives = closed.map_or_else(Vec::new, ClosedTree::drive_names);
        let bodies = model.bond_graph.moving_links().into_iter();
        Naming {
            bodies: bodies
                .map(|link| model.bond_graph.frames[link.0].name.as_str())
                .collect(),
            tree_joints: of_tree.map(|c| c.name.as_str()).collect(),
            actuated: drives,
            positions: positions.map(|p| p.name.as_str()).collect(),
            joints: coordinates.map(|c| c.name.as_str()).collect(),
            parameters: parameters.map(|p| p.name.as_str()).collect(),
            layout: None,
            arrays: false,
        }
    }

    /// Returns the names for a scene's functions.
    pub fn of_scene(scene: &'a SceneInterface) -> Self {
        let layout = &scene.layout;
        let positions = layout.positions.iter().map(|p| p.name.as_str());
        let joints = layout.coordinates.iter().map(|c| c.name.as_str());
        Naming {
            positions: positions.collect(),
            joints: joints.collect(),
            tree_joints: Vec::new(),
            actuated: Vec::new(),
            bodies: Vec::new(),
            parameters: scene.parameters.iter().map(|p| p.name.as_str()).collect(),
            layout: Some(layout),
            arrays: false,
        }
    }

    /// Returns the names for a scene's functions whose arguments are arrays.
    pub fn of_arrays(scene: &'a SceneInterface) -> Self {
        Naming {
            arrays: true,
            ..Naming::of_scene(scene)
        }
    }

    /// Returns the names of the components of a mechanism's argument, in order.
    pub fn component_names(&self, argument: Argument) -> Vec<String> {
        let names = match argument {
            Argument::Q => &self.positions,
            Argument::TreeV | Argument::TreeTau => &self.tree_joints,
            Argument::ActuatedTau => &self.actuated,
            Argument::BodyParameters => return self.body_parameters(),
            _ => &self.joints,
        };
        names.iter().map(ToString::to_string).collect()
    }

    /// Returns the names of the parameters of the bodies in snake_case, in order.
    fn body_parameters(&self) -> Vec<String> {
        let name = |name: &str| name.to_ascii_lowercase();
        let of = |body: &&str| PARAMETER_NAMES.map(|of| format!("{body}_{}", name(of)));
        self.bodies.iter().flat_map(of).collect()
    }

    /// Returns the leaves of an argument's components with names of variables for them; empty for an
    /// argument with named parts.
    pub fn components(&self, argument: Argument) -> Vec<(Leaf, String)> {
        if argument.belongs_to_scene() {
            return self.scene_components(argument);
        }
        let leaf = |j: usize| match argument {
            Argument::Q => Leaf::Position(j),
            Argument::V | Argument::TreeV => Leaf::Velocity(j),
            Argument::A | Argument::ReferenceA => Leaf::Acceleration(j),
            Argument::Tau | Argument::TreeTau | Argument::ActuatedTau => Leaf::Input(j),
            Argument::Direction | Argument::BodyParameters => Leaf::Input(j),
            // Leaves that the other arguments of these methods leave free.
            Argument::AlongV => Leaf::Mode(j),
            Argument::AlongA => Leaf::Input(j),
            Argument::AlongTau => Leaf::Acceleration(j),
            Argument::ReferenceV | Argument::AlongQ | Argument::Cotangent => Leaf::State(j),
            Argument::State
            | Argument::Input
            | Argument::Accelerations
            | Argument::Canonical
            | Argument::Modes
            | Argument::Time => unreachable!("it belongs to a scene"),
        };
        let names = self.component_names(argument).into_iter().enumerate();
        let named = |(j, name): (usize, String)| (leaf(j), format!("{}_{name}", argument.name()));
        names.map(named).collect()
    }

    fn scene_components(&self, argument: Argument) -> Vec<(Leaf, String)> {
        match (argument, self.layout) {
            (Argument::Canonical, Some(layout)) => {
                let names = layout.coordinates.iter().map(|c| &c.name).enumerate();
                let positions = layout.positions.iter().map(|p| &p.name).enumerate();
                let positions = positions.map(|(j, name)| (Leaf::Position(j), format!("q_{name}")));
                let momenta = names.map(|(j, name)| (Leaf::Velocity(j), format!("p_{name}")));
                let states = layout.states.iter().enumerate();
                let states = states.map(|(i, s)| (Leaf::State(i), format!("x_{}", s.name)));
                positions.chain(momenta).chain(states).collect()
            }
            (Argument::Modes, Some(layout)) => {
                let modes = layout.modes.iter().enumerate();
                let named =
                    |(i, m): (usize, &Variable)| (Leaf::Mode(i), format!("{}_mode", m.name));
                modes.map(named).collect()
            }
            (argument, Some(layout)) if self.arrays => array_components(argument, layout),
            _ => vec![],
        }
    }

    /// Returns the argument of a scene that has this leaf, and the name of its part there; no part for the time.
    pub fn field(&self, leaf: Leaf) -> Option<(Argument, Option<String>)> {
        let layout = self.layout?;
        let of_state = |name: &str| (Argument::State, Some(name.to_string()));
        Some(match leaf {
            Leaf::Position(p) => of_state(&layout.positions[p].name),
            Leaf::Velocity(j) => of_state(&layout.coordinates[j].rate_name),
            Leaf::State(i) => of_state(&layout.states[i].name),
            Leaf::Mode(i) => of_state(&format!("{}_mode", layout.modes[i].name)),
            Leaf::Acceleration(j) => {
                let name = layout.coordinates[j].name.clone();
                (Argument::Accelerations, Some(name))
            }
            Leaf::Input(i) => (Argument::Input, Some(layout.inputs[i].name.clone())),
            Leaf::Time => (Argument::Time, None),
            Leaf::Parameter(_) | Leaf::BlockResult { .. } => return None,
        })
    }
}

/// Returns the components of an argument of a scene that is an array: of the state those that change in time, then its
/// modes.
fn array_components(argument: Argument, layout: &StateLayout) -> Vec<(Leaf, String)> {
    fn named<'a>(
        leaf: fn(usize) -> Leaf,
        prefix: &str,
        names: impl Iterator<Item = &'a str>,
    ) -> Vec<(Leaf, String)> {
        let one = |(i, name)| (leaf(i), format!("{prefix}_{name}"));
        names.enumerate().map(one).collect()
    }
    fn of(all: &[Variable]) -> impl Iterator<Item = &str> {
        all.iter().map(|variable| variable.name.as_str())
    }
    let coordinates = layout.coordinates.iter();
    match argument {
        Argument::State => {
            let positions = layout.positions.iter().map(|p| p.name.as_str());
            let rates = coordinates.map(|c| c.rate_name.as_str());
            [
                named(Leaf::Position, "q", positions),
                named(Leaf::Velocity, "v", rates),
                named(Leaf::State, "x", of(&layout.states)),
                named(Leaf::Mode, "mode", of(&layout.modes)),
            ]
            .concat()
        }
        Argument::Input => named(Leaf::Input, "u", of(&layout.inputs)),
        Argument::Accelerations => named(
            Leaf::Acceleration,
            "a",
            coordinates.map(|c| c.name.as_str()),
        ),
        Argument::Time => vec![(Leaf::Time, "time".into())],
        _ => vec![],
    }
}

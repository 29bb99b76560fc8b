//! The names in a scene's module, for valid scenes and for refused ones.

use std::collections::BTreeSet;

use bgdyn_runtime::ImpactLaw;

use crate::bond_graph;
use crate::effect;
use crate::format::{Dimension, Located, Raw, SceneSpec, parse_scene};
use crate::machine::Machine;
use crate::mechanism::{CoordinateId, Parameter};
use crate::name::is_identifier;
use crate::scene::{
    self, Control, Initial, MomentumStore, StateCoordinate, StateLayout, StatePosition, Variable,
};
use crate::system::{Named, SceneEquations};

/// The interface of a scene's module without its functions.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneInterface {
    /// The scene's name.
    pub name: String,
    /// The layout of the state and the inputs.
    pub layout: StateLayout,
    /// The initial state.
    pub initial: Initial,
    /// The parts of its outputs.
    pub outputs: Vec<Named>,
    /// The entries of its balance of power.
    pub entries: Vec<Named>,
    /// The coordinate that each mode can hold.
    pub mode_coordinates: Vec<usize>,
    /// The instants, s, at which an input bends, in increasing order.
    pub corners: Vec<f64>,
    /// The law of restitution at impacts.
    pub impacts: ImpactLaw,
    /// How controllers are sampled.
    pub control: Option<Control>,
    /// Run-time parameters.
    pub parameters: Vec<Parameter>,
}

impl SceneInterface {
    /// Returns the interface of a valid scene.
    pub fn of(system: &SceneEquations) -> Self {
        SceneInterface {
            name: system.scene.name.clone(),
            layout: system.scene.layout.clone(),
            initial: system.initial.clone(),
            outputs: system.outputs.clone(),
            entries: system.entries.clone(),
            mode_coordinates: system.mode_coordinates(),
            corners: system.scene.corners(),
            impacts: system.scene.integration.impacts,
            control: system.scene.control.clone(),
            parameters: system.scene.parameters.clone(),
        }
    }

    /// Returns the interface that the author of a refused scene most likely means. `mechanism` is the text
    /// and the stem of the mechanism's file. `None` if the scene's stem cannot name a module.
    pub fn guess(text: &str, stem: &str, mechanism: Option<(&str, &str)>) -> Option<Self> {
        if !is_identifier(stem) {
            return None;
        }
        let (spec, _) = parse_scene(text);
        let (written, of) = mechanism.unwrap_or_default();
        let machine = crate::read::read_machine(written, Some(of)).0;
        let mut guess = match (&spec, &machine) {
            (Some(spec), Some(machine)) => sketched(spec, machine),
            _ => joints(written),
        };
        guess.name = stem.to_owned();
        guess.parameters = super::parameter_words(text)
            .into_iter()
            .chain(super::parameter_words(written))
            .map(parameter)
            .collect();
        if let Some(spec) = &spec {
            guess.add_words(spec);
        }
        guess.each_name_once();
        Some(guess)
    }

    /// Adds names that the file uses and nothing declares: parts that the corrected scene will have.
    fn add_words(&mut self, spec: &SceneSpec) {
        fn words(field: Option<&Vec<Raw>>) -> impl Iterator<Item = String> {
            let names = field
                .into_iter()
                .flatten()
                .map(|raw| raw.name.value.clone());
            names.filter(|name| is_identifier(name))
        }
        let layout = &mut self.layout;
        for word in words(spec.initial.value()) {
            let known = layout.state_names().any(|name| name == word)
                || layout.quasi_joints.iter().any(|joint| joint.name == word);
            match word.strip_suffix("_mode") {
                Some(mode) if layout.modes.iter().all(|m| m.name != mode) => {
                    layout.modes.push(part(mode));
                }
                None if !known => layout.states.push(part(&word)),
                _ => {}
            }
        }
        for word in words(spec.inputs.value()) {
            if layout.inputs.iter().all(|i| i.name != word) {
                layout.inputs.push(part(&word));
            }
        }
        for word in words(spec.outputs.value()) {
            let axis = |axis: &str| {
                self.outputs
                    .iter()
                    .any(|o| o.name == format!("{word}_{axis}"))
            };
            if !axis("x") && self.outputs.iter().all(|o| o.name != word) {
                self.outputs.push(named(&word));
            }
        }
        for word in words(spec.effects.value()) {
            if self.entries.iter().all(|e| e.name != word) {
                self.entries.push(named(&word));
            }
        }
    }

    /// Removes repeated names, which would be errors in the module as well.
    fn each_name_once(&mut self) {
        let new = |seen: &mut BTreeSet<String>, name: &str| seen.insert(name.to_owned());
        let layout = &mut self.layout;
        let mut seen = BTreeSet::new();
        layout.positions.retain(|p| new(&mut seen, &p.name));
        layout.coordinates.retain(|c| new(&mut seen, &c.rate_name));
        layout.states.retain(|s| new(&mut seen, &s.name));
        layout
            .modes
            .retain(|m| new(&mut seen, &format!("{}_mode", m.name)));
        let mut seen = BTreeSet::new();
        layout.inputs.retain(|i| new(&mut seen, &i.name));
        let mut seen = BTreeSet::new();
        self.outputs.retain(|o| new(&mut seen, &o.name));
        let mut seen = BTreeSet::new();
        self.entries.retain(|e| new(&mut seen, &e.name));
        let mut seen = BTreeSet::new();
        self.parameters.retain(|p| new(&mut seen, &p.name));
        self.mode_coordinates = vec![0; layout.modes.len()];
        let zeros = |n: usize| vec![bgdyn_runtime::Dd::ZERO; n];
        self.initial = Initial {
            q: zeros(layout.nq()),
            v: zeros(layout.nv()),
            x: zeros(layout.nx()),
            modes: zeros(layout.modes.len()),
        };
    }
}

/// Returns the known parts of an invalid scene.
fn sketched(spec: &SceneSpec, machine: &Machine) -> SceneInterface {
    let (layout, asked) = scene::sketch(spec, machine, &effect::kinds());
    let sites = bond_graph::build(&machine.mechanism).multibody.sites;
    let outputs = asked.iter().flat_map(|Located { value, .. }| {
        let place = sites.iter().any(|s| s.name == *value);
        let axes: &[&str] = if place { &["_x", "_y", "_z"] } else { &[""] };
        axes.iter()
            .map(move |axis| named(&format!("{value}{axis}")))
    });
    SceneInterface {
        outputs: outputs.filter(|o| is_identifier(&o.name)).collect(),
        layout,
        ..nothing()
    }
}

/// Returns the joints that a mechanism's text seems to have.
fn joints(mechanism: &str) -> SceneInterface {
    let known = super::Interface::guess(mechanism, "mechanism");
    let names = known.into_iter().flat_map(|known| known.joints);
    let names = names.filter(|name| is_identifier(name));
    let coordinate = |(j, name): (usize, &String)| StateCoordinate {
        rate_name: format!("{name}_rate"),
        name: name.clone(),
        store: MomentumStore::Links(CoordinateId(j)),
        position: Some(j),
        dimensions: [Dimension::Angle, Dimension::AngularSpeed, Dimension::Torque],
        starts_with: None,
    };
    let position = |(j, name): (usize, &String)| StatePosition {
        name: name.clone(),
        dimension: Dimension::Angle,
        coordinate: Some(j),
        neutral: bgdyn_runtime::Dd::ZERO,
    };
    let names: Vec<String> = names.collect();
    SceneInterface {
        layout: StateLayout {
            positions: names.iter().enumerate().map(position).collect(),
            coordinates: names.iter().enumerate().map(coordinate).collect(),
            ..StateLayout::default()
        },
        ..nothing()
    }
}

fn nothing() -> SceneInterface {
    let own = ["links", "drives", "dropped_velocity_products"];
    SceneInterface {
        name: String::new(),
        layout: StateLayout::default(),
        initial: Initial::default(),
        outputs: Vec::new(),
        entries: own.map(named).to_vec(),
        mode_coordinates: Vec::new(),
        corners: Vec::new(),
        impacts: ImpactLaw::Newton,
        control: None,
        parameters: Vec::new(),
    }
}

fn named(name: &str) -> Named {
    Named {
        name: name.to_owned(),
        unit: "",
        about: String::new(),
    }
}

fn part(name: &str) -> Variable {
    Variable {
        name: name.to_owned(),
        dimension: Dimension::One,
        about: String::new(),
        drives: None,
        drives_dependent: None,
        follows: None,
        entered: None,
    }
}

fn parameter(name: String) -> Parameter {
    Parameter {
        name,
        meaning: String::new(),
        default: bgdyn_runtime::Dd::ZERO,
        unit: "",
    }
}

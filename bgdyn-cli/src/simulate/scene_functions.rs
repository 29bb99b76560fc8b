//! The functions of a scene that a run calls, prepared by the engine.

use bgdyn_codegen::engine::{Callable, Engine};
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::QuasiJoint;
use bgdyn_runtime::closure::Dependent;

use crate::engine::engines_of;

/// The variables in which a scene is integrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// y: positions, velocities, first-order states.
    Natural,
    /// z: momenta in place of velocities, for which Gauss–Legendre integrators are symplectic.
    Canonical,
}

/// The functions of a scene, the same for every start.
#[derive(Debug)]
pub(super) struct SceneFunctions {
    pub(super) derivative: Box<dyn Callable>,
    pub(super) inputs: Option<Box<dyn Callable>>,
    pub(super) events: Option<Box<dyn Callable>>,
    pub(super) contacts: Option<Box<dyn Callable>>,
    pub(super) rigid: Option<RigidContacts>,
    pub(super) outputs: Option<Box<dyn Callable>>,
    pub(super) power: Box<dyn Callable>,
    pub(super) energy: Box<dyn Callable>,
    pub(super) jacobian: Option<Box<dyn Callable>>,
    pub(super) canonical: Option<Canonical>,
    /// Rates of all positions, in scenes with constraints.
    pub(super) position_rates: Option<Box<dyn Callable>>,
    pub(super) closing: Option<ClosedLoops>,
    pub(super) event_modes: Vec<Option<usize>>,
    /// The component of the state that is the velocity of each mode's coordinate.
    pub(super) mode_velocities: Vec<usize>,
    /// Instants at which an input bends, s.
    pub(super) corners: Vec<f64>,
    /// The joints with quasi-velocities, by their components in the state.
    pub(super) quasi_joints: Vec<QuasiJoint>,
}

/// The closing of loops.
#[derive(Debug)]
pub(super) struct ClosedLoops {
    pub(super) step: Box<dyn Callable>,
    pub(super) dependents: Vec<Dependent>,
}

/// The functions of rigid contacts.
#[derive(Debug)]
pub(super) struct RigidContacts {
    pub(super) states: Box<dyn Callable>,
    pub(super) maps: Box<dyn Callable>,
    pub(super) biases: Box<dyn Callable>,
    /// The entry of each in the balance of power.
    pub(super) entries: Vec<usize>,
}

/// The functions of the canonical form.
#[derive(Debug)]
pub(super) struct Canonical {
    pub(super) to: Box<dyn Callable>,
    pub(super) from: Box<dyn Callable>,
    pub(super) rates: Box<dyn Callable>,
}

impl SceneFunctions {
    /// Returns those of a scene in these variables, prepared by this engine; `slopes` for integrators that need the
    /// slopes of the rates.
    pub(super) fn new(
        engine: &dyn Engine,
        system: &SceneEquations,
        form: Form,
        slopes: bool,
    ) -> Self {
        let roles = system.roles();
        let prepare = |role| engine.prepare(&system.function(role));
        let if_there = |role| roles.contains(&role).then(|| prepare(role));
        let canonical = || Canonical {
            to: prepare(SceneFunction::ToCanonical),
            from: prepare(SceneFunction::FromCanonical),
            rates: prepare(SceneFunction::CanonicalRates),
        };
        let layout = &system.scene.layout;
        let coordinates = system.mode_coordinates().into_iter();
        let mode_velocities = coordinates.map(|j| layout.nq() + j);
        SceneFunctions {
            derivative: prepare(SceneFunction::Derivative),
            inputs: if_there(SceneFunction::Inputs),
            events: if_there(SceneFunction::Events),
            contacts: if_there(SceneFunction::Contacts),
            rigid: if_there(SceneFunction::RigidContactStates).map(|states| RigidContacts {
                states,
                maps: prepare(SceneFunction::RigidContactMaps),
                biases: prepare(SceneFunction::RigidContactBiases),
                entries: rigid_entries(system),
            }),
            outputs: if_there(SceneFunction::Outputs),
            power: prepare(SceneFunction::Power),
            energy: prepare(SceneFunction::Energy),
            // In canonical form the slopes are not available: stages are then solved without them.
            jacobian: (slopes && form == Form::Natural).then(|| prepare(SceneFunction::Jacobian)),
            canonical: (form == Form::Canonical).then(canonical),
            position_rates: if_there(SceneFunction::PositionRates),
            closing: if_there(SceneFunction::ClosingStep).map(|step| ClosedLoops {
                step,
                dependents: layout.closing.iter().map(in_state).collect(),
            }),
            event_modes: layout.events.iter().map(|e| layout.mode_of(e)).collect(),
            mode_velocities: mode_velocities.collect(),
            corners: system.scene.corners(),
            quasi_joints: layout
                .quasi_joints
                .iter()
                .map(|joint| joint.in_state(layout))
                .collect(),
        }
    }

    /// Returns what computed the functions until now, in words.
    pub(super) fn engines(&self) -> String {
        let canonical = self.canonical.iter();
        let canonical = canonical.flat_map(|form| [&form.to, &form.from, &form.rates]);
        let optional = [
            &self.inputs,
            &self.events,
            &self.contacts,
            &self.outputs,
            &self.jacobian,
            &self.position_rates,
        ];
        let always = [&self.derivative, &self.power, &self.energy];
        let closing = self.closing.iter().map(|closing| &closing.step);
        let rigid = self
            .rigid
            .iter()
            .flat_map(|rigid| [&rigid.states, &rigid.maps, &rigid.biases]);
        let all = always.into_iter().chain(optional.into_iter().flatten());
        engines_of(
            all.chain(canonical)
                .chain(closing)
                .chain(rigid)
                .map(|function| &**function),
        )
    }
}

/// Returns the entry of each rigid contact in the balance of power.
fn rigid_entries(system: &SceneEquations) -> Vec<usize> {
    let names = system.scene.layout.rigid_contacts.iter();
    let entry = |name: &String| system.entries.iter().position(|entry| entry.name == *name);
    names.map(|name| entry(name).unwrap_or_default()).collect()
}

/// Returns a position that changes where loops close, by its component in the state.
fn in_state(&(position, closes): &(usize, usize)) -> Dependent {
    Dependent {
        velocity: position,
        position,
        closes,
    }
}

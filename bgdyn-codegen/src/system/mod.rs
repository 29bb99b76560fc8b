//! Builds the equations of a scene: the effects' laws together with the mechanism's equations.
//!
//! With P of equation (6) for the links and E for the sum of the laws on a coordinate's junction, P(q, q̇,
//! q̈) = E(q, q̇, x, modes, u, t) gives the accelerations, I q̈ = E those of coordinates with a store of
//! their own, and the laws give ẋ.

mod balance;
mod canonical;
mod contact_forces;
mod contact_times;
mod controller_model;
mod coordinate_rows;
mod dynamics;
mod equations;
mod events;
mod followed;
mod holds;
mod idle;
mod jacobian;
mod outputs;
mod pose_hold;
mod range;
mod reference;
mod rigid_contacts;
mod signals;
mod slope;
mod start;
mod summed;
mod waveform;

use bgdyn_runtime::Dd;
use outputs::outputs;
use summed::summed;

use crate::bond_graph::{self, BondGraph, BondNetwork};
use crate::choice::GraphMethods;
use crate::effect;
pub use crate::effort_sums::{
    ActuatorEfforts, Balance, Contact, EffortSums, Hold, LossyGear, Port, Reading, RigidLaw,
};
use crate::expr::Builder;
use crate::fault::Faults;
use crate::formulation::{Formulation, RowChoice};
use crate::function::Function;
use crate::mechanism::Mechanism;
use crate::method::{Method, SceneFunction};
use crate::passes::{cheapest, factor, finish};
use crate::scene::{Override, Scene};
pub use contact_times::ContactTime;
pub use equations::{Named, SceneEquations};

impl SceneEquations {
    /// Builds the equations of a scene.
    ///
    /// # Errors
    /// Outputs that the scene does not have; values that do not stay positive over the limits of the
    /// joints; given modes that contradict the state.
    pub fn new(scene: Scene) -> Result<Self, Faults> {
        let mut faults = Faults::default();
        let model = scene.controller_model.as_deref();
        let model = model.map(|model| SceneEquations::of_controllers(model, &mut faults));
        let mut system = SceneEquations {
            controller_model: model.map(Box::new),
            ..SceneEquations::unstarted(scene)
        };
        let b = Builder::silent();
        let sums = system.effort_sums(&b);
        let entries = balance::entries(&system, &sums);
        let outputs = outputs(&system, &sums, &mut faults);
        let outputs = outputs.into_iter().map(|(named, _)| named).collect();
        range::check(&system.scene, &sums, &mut faults);
        drop(sums);
        (system.entries, system.outputs) = (entries, outputs);
        system.choose_rows();
        system.started(faults)
    }

    /// Builds the graphs of a scene.
    fn unstarted(scene: Scene) -> Self {
        let mut graph = loaded(
            bond_graph::build(&scene.mechanism),
            &scene,
            &scene.mechanism,
        );
        if let Some(closed) = &mut graph.closed {
            let open = scene.mechanism.open();
            closed.tree = loaded(closed.tree.clone(), &scene, &open);
        }
        SceneEquations {
            initial: scene.initial.clone(),
            outputs: Vec::new(),
            entries: Vec::new(),
            network: network(&scene, &graph),
            controller_model: None,
            scene,
            graph: GraphMethods::new(graph),
        }
    }

    /// Chooses the rows of loops and contacts: those with the fewest pivots that may vanish at regular positions, and
    /// then those for which the derivative takes fewer operations.
    fn choose_rows(&mut self) {
        let Some(closed) = self.graph.closed.as_deref() else {
            return;
        };
        let all: Vec<(usize, RowChoice)> = RowChoice::all(&closed.closure)
            .into_iter()
            .map(|choice| (choice.early_pivots(&closed.closure), choice))
            .collect();
        let fewest = all.iter().map(|(early, _)| *early).min();
        let left = all.into_iter().filter(|(early, _)| Some(*early) == fewest);
        let left: Vec<RowChoice> = left.map(|(_, choice)| choice).collect();
        if let [only] = left[..] {
            self.graph.rows = only;
            return;
        }
        let mut operations = |choice: &RowChoice| {
            self.graph.rows = *choice;
            let derivative = self.cheapest(SceneFunction::Derivative);
            derivative.operations().total()
        };
        let best = left.into_iter().min_by_key(|choice| operations(choice));
        self.graph.rows = best.unwrap_or_default();
    }

    /// Returns the equations with these values, SI units, at the start and for run-time parameters. The
    /// functions do not change, only their arguments.
    ///
    /// # Errors
    /// Invalid values of a state, or values for which a quantity that must be positive is not; modes that
    /// contradict the state.
    pub fn with_overrides(&self, values: &[(Override, Dd)]) -> Result<Self, Faults> {
        let scene = self.scene.with_overrides(values)?;
        let mut system = SceneEquations {
            scene,
            ..self.clone()
        };
        let mut faults = Faults::default();
        let b = Builder::silent();
        let sums = system.effort_sums(&b);
        range::check(&system.scene, &sums, &mut faults);
        drop(sums);
        system.initial = system.scene.initial.clone();
        system.started(faults)
    }

    /// Returns the joints to which nothing in the scene gives inertia, in any position.
    pub fn without_inertia(&self) -> Vec<&str> {
        let b = Builder::silent();
        let sums = self.effort_sums(&b);
        let mass = sums.method(Method::MassMatrix);
        let coordinates = self.graph.coordinates.iter().enumerate();
        let diagonal = |j: usize| mass[j * (j + 1) / 2 + j];
        // Positions without symmetry; a diagonal entry of M is a sum of squares.
        let mut positions: Vec<Dd> = (0..self.scene.layout.nq())
            .map(|j| Dd::from_f64(0.37 + 0.71 * j as f64))
            .collect();
        if let Some(closed) = self
            .scene
            .mechanism
            .closure()
            .and_then(|c| c.samples.first())
        {
            positions[..closed.len()].copy_from_slice(closed);
        }
        self.scene.layout.normalize(&mut positions);
        let at = crate::scene::Initial {
            q: positions,
            ..self.scene.initial.clone()
        };
        coordinates
            .filter(|(j, _)| sums.at_start(diagonal(*j), &at).to_f64() <= 1e-24)
            .map(|(_, c)| c.name.as_str())
            .collect()
    }

    /// Returns the functions of this scene, including those that its integrator needs.
    pub fn roles(&self) -> Vec<SceneFunction> {
        self.roles_with(false, false)
    }

    /// Returns the same, with the Jacobian and the canonical form if selected. Scenes with quasi-velocities, loops or rigid
    /// contacts have no canonical form.
    pub fn roles_with(&self, jacobian: bool, canonical: bool) -> Vec<SceneFunction> {
        let layout = &self.scene.layout;
        let method = self.scene.integration.method;
        let has = |role: &SceneFunction| match role {
            SceneFunction::Inputs => !layout.inputs.is_empty(),
            SceneFunction::Events => !layout.events.is_empty(),
            SceneFunction::Contacts => !layout.modes.is_empty(),
            SceneFunction::RigidContactStates
            | SceneFunction::RigidContactMaps
            | SceneFunction::RigidContactBiases => !layout.rigid_contacts.is_empty(),
            SceneFunction::Outputs => !self.outputs.is_empty(),
            SceneFunction::Derivative
            | SceneFunction::Inverse
            | SceneFunction::Power
            | SceneFunction::Energy => true,
            SceneFunction::Jacobian => jacobian || method.needs_jacobian(),
            // On request only: `has_input_jacobian`.
            SceneFunction::InputJacobian => false,
            SceneFunction::ToCanonical
            | SceneFunction::FromCanonical
            | SceneFunction::CanonicalRates => {
                let natural = layout.coupled().is_empty()
                    && self.graph.released.is_none()
                    && layout.rigid_contacts.is_empty();
                natural && (canonical || method.needs_canonical())
            }
            SceneFunction::PositionRates => layout.needs_position_rates(),
            SceneFunction::ClosingStep => !layout.closing.is_empty(),
        };
        SceneFunction::ALL.into_iter().filter(has).collect()
    }

    /// Returns whether there is a ∂ẏ/∂u: whether the scene has inputs.
    pub fn has_input_jacobian(&self) -> bool {
        !self.scene.layout.inputs.is_empty()
    }

    /// Returns a scene function.
    pub fn function(&self, role: SceneFunction) -> Function {
        finish(self.cheapest(role))
    }

    /// Returns the same in one block.
    fn cheapest(&self, role: SceneFunction) -> Function {
        let factored = self.ways(role).into_iter().map(factor);
        let best = match role {
            SceneFunction::Jacobian
            | SceneFunction::InputJacobian
            | SceneFunction::ToCanonical
            | SceneFunction::FromCanonical
            | SceneFunction::CanonicalRates => cheapest(factored),
            _ => factored.min_by_key(|f| f.operations().total()),
        };
        best.expect("every role has a function")
    }

    /// Returns the alternatives for a scene function, before factoring. All have the same results.
    pub fn ways(&self, role: SceneFunction) -> Vec<Function> {
        match role {
            SceneFunction::Derivative => dynamics::derivatives(self),
            SceneFunction::Inverse => vec![self.one(role, dynamics::inverse)],
            SceneFunction::Inputs => vec![self.one(role, signals::inputs)],
            SceneFunction::Events => vec![self.one(role, events::events)],
            SceneFunction::Contacts => vec![self.one(role, holds::contacts)],
            SceneFunction::RigidContactStates => vec![self.one(role, rigid_contacts::states)],
            SceneFunction::RigidContactMaps => vec![self.one(role, rigid_contacts::maps)],
            SceneFunction::RigidContactBiases => vec![self.one(role, rigid_contacts::biases)],
            SceneFunction::Power => vec![self.one(role, balance::power)],
            SceneFunction::Energy => vec![self.one(role, balance::energy)],
            SceneFunction::Outputs => vec![self.one(role, |system, b| {
                let sums = system.effort_sums(b);
                let found = outputs(system, &sums, &mut Faults::default());
                found.into_iter().map(|(_, e)| e).collect()
            })],
            SceneFunction::Jacobian => jacobian::ways(self),
            SceneFunction::InputJacobian => jacobian::along_inputs(self),
            SceneFunction::ToCanonical => canonical::momenta(self),
            SceneFunction::FromCanonical => canonical::velocities(self),
            SceneFunction::CanonicalRates => canonical::rates(self),
            SceneFunction::PositionRates => {
                vec![self.one(role, |system, b| system.effort_sums(b).position_rates())]
            }
            SceneFunction::ClosingStep => {
                vec![self.one(role, |system, b| system.effort_sums(b).closing_steps())]
            }
        }
    }

    /// Returns the derivative with this formulation instead of the cheapest, for comparison. `None` if the
    /// formulation does not support a required method.
    pub fn derivative_by(&self, formulation: &'static dyn Formulation) -> Option<Function> {
        let way = dynamics::derivative_by(self, formulation)?;
        Some(finish(factor(way)))
    }

    /// Returns the derivative with one drive at every coordinate, in place of the accelerations among the
    /// leaves: the inverse of [`SceneFunction::Inverse`].
    pub fn driven(&self) -> Function {
        self.one(SceneFunction::Derivative, |system, b| {
            let sums = summed(b, &system.scene, &system.graph, ActuatorEfforts::Each);
            dynamics::rates(system, &sums, b)
        })
    }
}

/// Returns the bond graph of a mechanism with the loads of the scene's effects.
fn loaded(graph: BondGraph, scene: &Scene, mechanism: &Mechanism) -> BondGraph {
    let mut graph = graph.without_loads();
    for element in &scene.elements {
        effect::of(element).modify_graph(element, mechanism, &mut graph);
    }
    graph.update_released();
    graph
}

/// Returns the bond graph of the mechanism and of the scene's effects.
fn network(scene: &Scene, graph: &BondGraph) -> BondNetwork {
    let layout = &scene.layout;
    let driven = layout.inputs.iter().filter_map(|input| input.drives);
    let driven = driven.map(|j| layout.coordinates[j].name.clone());
    let dependents = layout
        .inputs
        .iter()
        .filter_map(|input| input.drives_dependent);
    let dependents = dependents.map(|d| layout.dependents[d].name.clone());
    let driven = driven.chain(dependents).collect();
    let mut network = BondNetwork::of_mechanism(graph.of_all_joints(), driven);
    for prescribed in graph.released.iter().flat_map(|r| &r.prescribed) {
        network.prescribe(&prescribed.name);
    }
    for follower in &layout.followers {
        let leader = |&(j, ratio): &(usize, Dd)| {
            let name = layout.coordinates[j].name.clone();
            (name, format!("{} of coupling", ratio.to_f64()))
        };
        network.follow(
            &follower.name,
            follower.leaders.iter().map(leader).collect(),
        );
    }
    if let Some(closed) = &graph.closed {
        network.close(&closed.closure);
    }
    for pair in scene.mechanism.contact_pairs() {
        network.touch(&pair.name, &scene.mechanism.contact_links(&pair.name));
    }
    for (at, element) in scene.elements.iter().enumerate() {
        network.begin(at);
        effect::of(element).elements(element, &scene.elements, &mut network);
    }
    network
}

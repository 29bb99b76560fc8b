//! The start of a scene.
//!
//! It has first-order states in the quantities of their effects, and modes that are consistent with the rest of
//! the state.

use bgdyn_runtime::{Contact, Dd, Scalar, mode_by_slip, resolve_stiction_by};
use nalgebra::DVector;

use super::holds::contacts_under;
use super::rigid_contacts::check_start;
use super::{EffortSums, SceneEquations};
use crate::declaration::Element;
use crate::effect;
use crate::expr::{Builder, Expr, Inputs, Leaf, Node, NodeId, Signed, evaluate, reachable};
use crate::fault::wording::{self, WhyWrong, WrongMode};
use crate::fault::{Fault, Faults, Location};
use crate::scene::{Scene, mode_name};

/// Largest slip that counts as zero, the rounding error of two rates: rad/s, m/s or A.
const NO_SLIP: f64 = 64.0 * f64::EPSILON;

impl SceneEquations {
    /// Returns the equations with first-order states and modes at the start.
    ///
    /// # Errors
    /// The `faults` so far, and given modes that contradict the rest of the state.
    pub(super) fn started(mut self, mut faults: Faults) -> Result<SceneEquations, Faults> {
        let b = Builder::silent();
        let sums = self.effort_sums(&b);
        let states = states(&self.scene, &sums);
        check_start(&self, &sums, &mut faults);
        drop(sums);
        self.initial.x = states;
        if !faults.any_fault() && !self.scene.layout.modes.is_empty() {
            self.initial.modes = modes(&self, &mut faults);
        }
        match faults.any_fault() {
            true => Err(faults),
            false => Ok(self),
        }
    }
}

/// Returns the first-order states at the start, converted by their effects from the values in the scene.
fn states(scene: &Scene, sums: &EffortSums<'_, '_>) -> Vec<Dd> {
    let given = &scene.initial;
    let parts = scene.layout.states.iter().zip(&given.x);
    let value = |(part, &x): (&crate::scene::Variable, &Dd)| {
        let stored = stored(scene, sums, &part.name, x);
        sums.at_start(stored, given)
    };
    parts.map(value).collect()
}

/// Returns the value of a first-order state for which the scene gives `x`.
fn stored<'g>(scene: &Scene, sums: &EffortSums<'g, '_>, state: &str, x: Dd) -> Expr<'g> {
    let given = sums.b.constant(x);
    let owner = |e: &&Element| e.effect.owns_state(e, state);
    match scene.elements.iter().find(owner) {
        Some(element) => effect::of(element).initial_state(element, sums, state, given),
        None => given,
    }
}

/// Returns the modes at the start: moving contacts slip in their direction of motion, contacts at rest
/// hold if they can. A given mode with another value is a fault, unless it depends on inputs that only the
/// caller knows; these are 0 here.
fn modes(system: &SceneEquations, faults: &mut Faults) -> Vec<Dd> {
    let start = Start::of(system);
    let stated = DVector::from_vec(system.initial.modes.clone());
    let moving = start
        .contacts(&stated)
        .into_iter()
        .zip(&system.initial.modes);
    let by_slip = moving.map(|(contact, &mode)| {
        let none = Dd::from_f64(NO_SLIP);
        mode_by_slip(mode, contact.slip, none)
    });
    let by_slip = DVector::from_iterator(stated.len(), by_slip);
    let contacts = |modes: &DVector<Dd>| Ok::<_, ()>(start.contacts(modes));
    let Ok(resolved) = resolve_stiction_by(&by_slip, Dd::ZERO, contacts) else {
        return system.initial.modes.clone();
    };
    for k in 0..stated.len() {
        let location = system.scene.stated_mode(k).filter(|_| !start.by_caller[k]);
        if let Some(location) = location.filter(|_| stated[k] != resolved[k]) {
            faults.push(start.contradiction(&location, k, &stated, resolved[k]));
        }
    }
    resolved.as_slice().to_vec()
}

/// The contacts of a scene at its start, at any modes.
struct Start<'a> {
    system: &'a SceneEquations,
    graph: crate::expr::Graph,
    /// Four numbers for each mode.
    rows: Vec<Signed>,
    /// For each mode, whether it depends on an input from the caller.
    by_caller: Vec<bool>,
    /// For each mode, whether it belongs to the limit of a rate, not to friction.
    of_limit: Vec<bool>,
}

impl<'a> Start<'a> {
    fn of(system: &'a SceneEquations) -> Self {
        let b = Builder::silent();
        let (rows, of_limit): (Vec<Signed>, _) = {
            let sums = system.laws_under_driven_inputs(&b);
            let mut of_limit = vec![false; system.scene.layout.modes.len()];
            for contact in sums.contacts() {
                of_limit[contact.mode] = contact.hold.range().is_none();
            }
            let all = contacts_under(system, &sums).into_iter().flatten();
            (all.map(|x| x.signed()).collect(), of_limit)
        };
        let graph = b.into_graph();
        let given = |row: &[Signed]| {
            let needed = reachable(&graph, row);
            let input =
                |i: &usize| matches!(graph.node(NodeId(*i as u32)), Node::Leaf(Leaf::Input(_)));
            (0..graph.len()).filter(|i| needed[*i]).any(|i| input(&i))
        };
        let by_caller = rows.chunks_exact(4).map(given).collect();
        Start {
            system,
            graph,
            rows,
            by_caller,
            of_limit,
        }
    }

    fn contacts(&self, modes: &DVector<Dd>) -> Vec<Contact<Dd>> {
        let (scene, initial) = (&self.system.scene, &self.system.initial);
        let inputs = Inputs {
            q: initial.q.clone(),
            v: initial.v.clone(),
            a: vec![],
            x: initial.x.clone(),
            u: vec![Dd::ZERO; scene.layout.inputs.len()],
            modes: modes.as_slice().to_vec(),
            parameters: scene.parameters.iter().map(|p| p.default).collect(),
            t: Some(Dd::ZERO),
            passed: vec![],
        };
        let values = evaluate(&self.graph, &self.rows, &inputs, &mut Dd::none_refused());
        let one = |row: &[Dd]| Contact {
            slip: row[0],
            slip_rate: row[1],
            holding: row[2],
            margin: row[3],
        };
        values.chunks_exact(4).map(one).collect()
    }

    /// Returns the fault of the given mode `k` among `modes`; `right` is the consistent one.
    fn contradiction(
        &self,
        location: &Location,
        k: usize,
        modes: &DVector<Dd>,
        right: Dd,
    ) -> Fault {
        let layout = &self.system.scene.layout;
        let coordinate = &layout.coordinates[self.system.mode_coordinates()[k]];
        let [_, rate, effort] = coordinate.dimensions.map(|d| d.si());
        let (stated, right) = (modes[k].to_f64(), right.to_f64());
        let mut held = modes.clone();
        held[k] = Dd::ZERO;
        let contact = &self.contacts(&held)[k];
        let (slip, holding) = (contact.slip.to_f64(), contact.holding.to_f64());
        let begins_with = self.system.initial.v[self.system.mode_coordinates()[k]].to_f64();
        let why = match (self.of_limit[k], slip.abs() > NO_SLIP, right == 0.0) {
            (false, true, _) => WhyWrong::Slips(slip),
            (false, false, true) => WhyWrong::IsHeld(holding),
            (false, false, false) => WhyWrong::CannotHold(holding, -contact.margin.to_f64()),
            (true, true, _) => WhyWrong::OffLimit(begins_with, begins_with - slip),
            (true, false, true) => WhyWrong::StaysAtLimit,
            (true, false, false) => WhyWrong::LeavesLimit,
        };
        let mode = WrongMode {
            name: &mode_name(&layout.modes[k]),
            modes: [stated, right],
            rate: &coordinate.rate_name,
            units: [rate, effort],
            why,
        };
        wording::wrong_mode(location, &mode)
    }
}

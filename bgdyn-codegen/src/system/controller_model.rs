//! Computed torques by a model of the controllers that is not the plant.
//!
//! The controllers measure the state of the plant, and compute the efforts with which the model would move as it should.

use super::followed::computed_torques;
use super::summed::summed;
use super::{ActuatorEfforts, EffortSums, SceneEquations, range};
use crate::expr::{Builder, Expr, Graph, Leaf, Signed, copy_with_pivots};
use crate::fault::{Faults, wording};
use crate::layout::StateLayout;
use crate::scene::Scene;

impl SceneEquations {
    /// Builds the equations by which controllers compute torques. A controller has no start, no outputs and no balance.
    pub(super) fn of_controllers(model: &Scene, faults: &mut Faults) -> Self {
        let mut system = SceneEquations::unstarted(model.clone());
        let mut found = Faults::default();
        let b = Builder::silent();
        range::check(&system.scene, &system.effort_sums(&b), &mut found);
        system.choose_rows();
        let found = found.0.into_iter().map(wording::of_controller_model);
        faults.0.extend(found);
        system
    }
}

/// Returns the effort of each input of the plant that is a computed torque, by the expressions of the model with the
/// arguments and signals of the plant. Run-time parameters of the model are numbers.
pub(super) fn torques_of_model<'g>(
    plant: &EffortSums<'g, '_>,
    model: &SceneEquations,
) -> Vec<Option<Expr<'g>>> {
    let own = Builder::silent();
    let torques: Vec<Option<Signed>> = {
        let sums = summed(&own, &model.scene, &model.graph, ActuatorEfforts::Unknown);
        let torques = computed_torques(model, &own, &sums).into_iter();
        torques.map(|torque| torque.map(Expr::signed)).collect()
    };
    let from = own.into_graph();
    let outputs: Vec<Signed> = torques.iter().flatten().copied().collect();
    let (layout, measured) = (&model.scene.layout, &plant.scene().layout);
    let place = |to: &mut Graph, leaf: Leaf| match leaf {
        Leaf::Parameter(p) => Some(to.constant(model.scene.parameters[p].default)),
        Leaf::Input(i) => Some(plant.input(&layout.inputs[i].name).signed()),
        leaf => Some(to.leaf(same(leaf, layout, measured))),
    };
    let copies = plant
        .b
        .with_graph(|to| copy_with_pivots(to, &from, &outputs, place, |_| None));
    let mut copies = copies.into_iter();
    let mut found = vec![None; measured.inputs.len()];
    for (part, torque) in layout.inputs.iter().zip(torques) {
        let copy = torque.and_then(|_| copies.next());
        if let (Some(copy), Some(i)) = (copy, index(&measured.inputs, |p| p.name == part.name)) {
            found[i] = Some(plant.b.expr(copy));
        }
    }
    found
}

/// Returns the plant's argument with the name of a model's argument. The check of the scene has found all of them.
fn same(leaf: Leaf, model: &StateLayout, plant: &StateLayout) -> Leaf {
    let found = match leaf {
        Leaf::Position(i) => {
            index(&plant.positions, |p| p.name == model.positions[i].name).map(Leaf::Position)
        }
        Leaf::Velocity(j) => {
            let name = &model.coordinates[j].rate_name;
            index(&plant.coordinates, |c| c.rate_name == *name).map(Leaf::Velocity)
        }
        Leaf::State(i) => index(&plant.states, |p| p.name == model.states[i].name).map(Leaf::State),
        Leaf::Mode(i) => index(&plant.modes, |p| p.name == model.modes[i].name).map(Leaf::Mode),
        leaf => Some(leaf),
    };
    found.expect("the plant has every argument of the controllers' model")
}

/// Returns the index of the part for which `is` is true.
fn index<T>(parts: &[T], is: impl Fn(&T) -> bool) -> Option<usize> {
    parts.iter().position(is)
}

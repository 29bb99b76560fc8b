//! Accelerations and rates of a scene, and the drives and efforts for given accelerations.

use super::coordinate_rows::{link_accelerations, own_inertia};
use super::holds::{Holding, held, own_accelerations};
use super::summed::summed;
use super::{ActuatorEfforts, EffortSums, SceneEquations};
use crate::choice::Choice;
use crate::expr::{Builder, Expr, Leaf, Signed};
use crate::formulation::Formulation;
use crate::function::Function;
use crate::method::{Method, SceneFunction};

/// Returns the alternatives for v̇, ẋ, and the rates of coupled positions.
pub(super) fn derivatives(system: &SceneEquations) -> Vec<Function> {
    if system.may_hold_joints() {
        return vec![with_modes(system, None)];
    }
    let ways = system.graph.forward_dynamics();
    let ways = ways.iter();
    ways.map(|forward| without_modes(system, forward)).collect()
}

/// Returns them with this formulation; `None` if it does not support a required method.
pub(super) fn derivative_by(
    system: &SceneEquations,
    formulation: &'static dyn Formulation,
) -> Option<Function> {
    if !system.may_hold_joints() {
        let choice = Choice::by_elimination(&system.graph, Some(formulation));
        let forward = choice.asked_plain(Method::ForwardDynamics)?;
        return Some(without_modes(system, &forward));
    }
    let known = [Method::MassMatrix, Method::Bias].map(|m| formulation.knows(m));
    (known == [true, true]).then(|| with_modes(system, Some(formulation)))
}

/// Returns them if joints may be held.
fn with_modes(system: &SceneEquations, asked: Option<&'static dyn Formulation>) -> Function {
    system.one(SceneFunction::Derivative, |system, b| {
        let mut sums = system.effort_sums(b);
        sums.asked = asked;
        let mut all = rates(system, &sums, b);
        all.extend(sums.coupled_rates());
        all
    })
}

/// Returns them with a function for forward dynamics.
fn without_modes(system: &SceneEquations, forward: &Function) -> Function {
    let b = Builder::new();
    let outputs: Vec<Signed> = {
        let sums = system.effort_sums(&b);
        let joints = link_accelerations(forward, &sums, system);
        let all = joined(system, &sums, joints).into_iter();
        let all = all.chain(sums.coupled_rates());
        all.map(Expr::signed).collect()
    };
    let name = format!("{}; under the scene's efforts", forward.formulation);
    Function {
        ordered: forward.ordered,
        ..system.flat(SceneFunction::Derivative, name, b, outputs)
    }
}

/// Returns the joints' accelerations with those of the other coordinates, and ẋ.
pub(super) fn joined<'g>(
    system: &SceneEquations,
    sums: &EffortSums<'g, '_>,
    joints: Vec<Expr<'g>>,
) -> Vec<Expr<'g>> {
    let mut all = joints;
    all.extend(own_accelerations(system, sums, &Holding::new(sums)));
    all.extend(sums.rates());
    all
}

/// Returns v̇ and ẋ, for any modes.
pub(super) fn rates<'g>(
    system: &SceneEquations,
    sums: &EffortSums<'g, '_>,
    b: &'g Builder,
) -> Vec<Expr<'g>> {
    let mut all = held(system, sums, b).accelerations;
    all.extend(sums.rates());
    all
}

/// Returns the drive of each coordinate for given accelerations.
pub(super) fn inverse<'g>(system: &SceneEquations, b: &'g Builder) -> Vec<Expr<'g>> {
    let sums = summed(b, &system.scene, &system.graph, ActuatorEfforts::Unknown);
    let nv = system.scene.layout.nv();
    let given: Vec<Expr<'g>> = (0..nv).map(|j| b.leaf(Leaf::Acceleration(j))).collect();
    efforts(system, &sums, &given)
}

/// Returns the drive of each coordinate at these accelerations: all other efforts of the laws are
/// subtracted.
pub(super) fn efforts<'g>(
    system: &SceneEquations,
    sums: &EffortSums<'g, '_>,
    at: &[Expr<'g>],
) -> Vec<Expr<'g>> {
    let all = needed(system, sums, at).into_iter().enumerate();
    all.map(|(j, effort)| sums.before_gear(j, effort)).collect()
}

/// Returns the effort that each coordinate needs behind its gear at these accelerations: all other efforts of the laws
/// are subtracted.
pub(super) fn needed<'g>(
    system: &SceneEquations,
    sums: &EffortSums<'g, '_>,
    at: &[Expr<'g>],
) -> Vec<Expr<'g>> {
    let placed: Vec<Signed> = at.iter().map(|a| a.signed()).collect();
    let links = sums.copied(
        (&system.graph, sums.asked),
        Method::InverseDynamics,
        |_, leaf| match leaf {
            Leaf::Acceleration(j) => Some(placed[j]),
            _ => None,
        },
    );
    let all = (0..at.len()).map(|j| {
        let inertial = match links.get(j) {
            Some(&effort) => effort,
            None => own_inertia(sums, j) * at[j],
        };
        inertial - sums.effort(j)
    });
    all.collect()
}

//! Accelerations and rates, and the efforts behind given accelerations.

use super::coordinate_rows::{link_accelerations, own_inertia};
use super::holds::{Holding, held, own_accelerations};
use super::summed::summed;
use super::{Laws, Own, System};
use crate::choice::Choice;
use crate::expr::{Builder, Ex, Expr, Leaf};
use crate::formulation::Formulation;
use crate::function::Function;
use crate::laws::copied;
use crate::method::{Method, Role};

/// The ways to v̇ and ẋ.
pub(super) fn derivatives(system: &System) -> Vec<Function> {
    if system.may_hold_joints() {
        return vec![with_modes(system, None)];
    }
    let choice = Choice::new(&system.graph, None);
    let ways = choice.forward_dynamics();
    ways.map(|forward| without_modes(system, forward)).collect()
}

/// The way to v̇ and ẋ on this formulation; `None` where it does not know what that takes.
pub(super) fn derivative_by(
    system: &System,
    formulation: &'static dyn Formulation,
) -> Option<Function> {
    if !system.may_hold_joints() {
        let choice = Choice::new(&system.graph, Some(formulation));
        let forward = choice.asked_plain(Method::ForwardDynamics)?;
        return Some(without_modes(system, &forward));
    }
    let known = [Method::MassMatrix, Method::Bias].map(|m| formulation.knows(m));
    (known == [true, true]).then(|| with_modes(system, Some(formulation)))
}

/// v̇ and ẋ where joints may be held.
fn with_modes(system: &System, asked: Option<&'static dyn Formulation>) -> Function {
    system.one(Role::Derivative, |system, b| {
        let mut laws = summed(b, &system.scene, &system.graph, Own::Inputs);
        laws.asked = asked;
        rates(system, &laws, b)
    })
}

/// v̇ and ẋ on a way to forward dynamics.
fn without_modes(system: &System, forward: &Function) -> Function {
    let b = Builder::new();
    let outputs: Vec<Expr> = {
        let laws = summed(&b, &system.scene, &system.graph, Own::Inputs);
        let joints = link_accelerations(&b, forward, &laws, system);
        let all = joined(system, &laws, joints).into_iter();
        all.map(Ex::expr).collect()
    };
    let name = format!("{}; under the scene's efforts", forward.formulation);
    Function {
        ordered: forward.ordered,
        ..system.flat(Role::Derivative, name, b, outputs)
    }
}

/// The joints' accelerations with those of the other coordinates, and ẋ.
pub(super) fn joined<'g>(system: &System, laws: &Laws<'g, '_>, joints: Vec<Ex<'g>>) -> Vec<Ex<'g>> {
    let mut all = joints;
    all.extend(own_accelerations(system, laws, &Holding::new(laws)));
    all.extend(laws.rates());
    all
}

/// v̇ and ẋ, whatever the modes are.
pub(super) fn rates<'g>(system: &System, laws: &Laws<'g, '_>, b: &'g Builder) -> Vec<Ex<'g>> {
    let mut all = held(system, laws, b).accelerations;
    all.extend(laws.rates());
    all
}

/// The own effort of each coordinate behind given accelerations.
pub(super) fn inverse<'g>(system: &System, b: &'g Builder) -> Vec<Ex<'g>> {
    let laws = summed(b, &system.scene, &system.graph, Own::Sought);
    let nv = system.scene.layout.nv();
    let given: Vec<Ex<'g>> = (0..nv).map(|j| b.leaf(Leaf::Acceleration(j))).collect();
    efforts(system, &laws, &given)
}

/// The own effort of each coordinate at these accelerations: everything the laws do but the
/// coordinates' own efforts is taken off.
pub(super) fn efforts<'g>(system: &System, laws: &Laws<'g, '_>, at: &[Ex<'g>]) -> Vec<Ex<'g>> {
    let placed: Vec<Expr> = at.iter().map(|a| a.expr()).collect();
    let links = copied(
        laws.b,
        (&system.graph, laws.asked),
        Method::InverseDynamics,
        |_, leaf| match leaf {
            Leaf::Acceleration(j) => Some(placed[j]),
            _ => None,
        },
    );
    let all = (0..at.len()).map(|j| {
        let inertial = match links.get(j) {
            Some(&effort) => effort,
            None => own_inertia(laws, j) * at[j],
        };
        laws.before_gear(j, inertial - laws.effort(j))
    });
    all.collect()
}

//! The motion of the open tree of a mechanism with loops or contacts, and their loads.

use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

use super::robot::{Robot, State, Way, close, largest};

/// Returns velocities and accelerations of the open tree of a mechanism with loops or contacts, and the loads on
/// places b and at contacts, for the accelerations of a state and the efforts that these need.
pub fn motion_of_tree(robot: &Robot, way: Way, state: &State<Dd>) -> (State<Dd>, Vec<Dd>) {
    let value =
        |state: &State<Dd>, method| -> Vec<Dd> { state.value(&robot.function(way, method)) };
    let motion = State {
        q: state.q.clone(),
        v: value(state, Method::TreeVelocity),
        a: value(state, Method::TreeAcceleration),
        u: value(state, Method::InverseDynamics),
    };
    let driven = State {
        u: motion.u.clone(),
        ..state.clone()
    };
    let found = value(&driven, Method::Reactions);
    let (accelerations, reactions) = found.split_at(robot.nv());
    close(
        accelerations,
        &state.a,
        1e-20,
        // At rest the accelerations are what is left of efforts.
        largest(&motion.a).max(largest(&motion.u)),
        "accelerations",
    );
    (motion, reactions.to_vec())
}

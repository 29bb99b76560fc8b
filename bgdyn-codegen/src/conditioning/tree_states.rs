//! The arguments of methods that take others than most: velocities of the open tree of a mechanism with loops, directions,
//! parameters of bodies.

use bgdyn_runtime::Dd;

use crate::bond_graph::BondGraph;
use crate::expr::Inputs;
use crate::method::{Argument, Method, PARAMETERS_PER_BODY};
use crate::random::Random;

/// Returns whether a method takes velocities of the open tree, or efforts of actuated joints.
pub(crate) fn takes_others(method: Method) -> bool {
    method.of_tree() || method.of_actuated_joints()
}

/// Adds what some methods read beside positions, velocities, accelerations and efforts: other velocities, directions,
/// parameters of bodies.
pub(crate) fn add_further_arguments(
    graph: &BondGraph,
    method: Method,
    state: &mut Inputs<f64>,
    seed: u64,
) {
    if !method.is_derived() && !matches!(method, Method::Bundle { .. }) {
        return;
    }
    let mut random = Random(seed);
    let mut some = |n: usize| -> Vec<f64> { (0..n).map(|_| 2.0 * random.signed()).collect() };
    let n = state.v.len();
    (state.x, state.modes) = (some(n), some(n));
    if method.arguments().contains(&Argument::BodyParameters) {
        state.u = some(PARAMETERS_PER_BODY * graph.moving_links().len());
    }
}

/// Returns the state with the velocities and efforts of all joints of the open tree, if the method takes these: the
/// velocities S v, and for [`Method::ProjectVelocity`] others, at which the rows do not hold; with
/// efforts of the actuated joints, if the method takes these.
pub(crate) fn of_method(graph: &BondGraph, method: Method, state: &Inputs<Dd>) -> Inputs<Dd> {
    let mut state = state.clone();
    let Some(closed) = graph.closed.as_deref().filter(|_| takes_others(method)) else {
        return state;
    };
    // Numbers of both signs, different from joint to joint.
    let others = |of: &[Dd], j: usize| match of {
        [] => Dd::ZERO,
        _ => of[j % of.len()] * Dd::from_f64(0.7 - 0.3 * j as f64),
    };
    if !method.of_tree() {
        let drives = closed.closure.drives().map_or(0, |own| own.joints.len());
        state.u = (0..drives).map(|j| others(&state.u, j)).collect();
        return state;
    }
    let nt = closed.tree.coordinates.len();
    let row = |row: &Vec<Dd>| {
        let terms = row.iter().zip(&state.v);
        terms.fold(Dd::ZERO, |sum, (s, v)| sum + *s * *v)
    };
    let map = closed.closure.velocity_map(&state.q);
    let moved = map.map_or_else(|| vec![Dd::ZERO; nt], |map| map.iter().map(row).collect());
    let all = 0..nt;
    state.v = match method {
        Method::ProjectVelocity => all
            .clone()
            .map(|j| moved[j] + others(&state.a, j))
            .collect(),
        _ => moved,
    };
    state.u = all.map(|j| others(&state.u, j)).collect();
    state
}

/// Rounds the numbers to `f64`.
pub(crate) fn rounded(state: &Inputs<Dd>) -> Inputs<f64> {
    let all = |x: &[Dd]| x.iter().map(|x| x.to_f64()).collect();
    Inputs {
        q: all(&state.q),
        v: all(&state.v),
        a: all(&state.a),
        u: all(&state.u),
        x: all(&state.x),
        modes: all(&state.modes),
        parameters: all(&state.parameters),
        ..Inputs::default()
    }
}

//! Samples the states in which functions are measured; for one mechanism they are the same in every run.
//!
//! Random states, and states near which mass matrices are closest to losing rank: common normals of
//! neighbouring axes in line or perpendicular, where axes become parallel and where an arm is stretched or
//! folded, exactly and almost. Positions, velocities and efforts are `f64` numbers. Of the seven functions
//! that [`crate::choice`] does not factor, six lose their digits near aligned axes only, and one (`crane`)
//! where a joint moves the least inertia.

use std::f64::consts::{FRAC_PI_2, PI};

use bgdyn_runtime::Dd;

use crate::bond_graph::BondGraph;
use crate::expr::Inputs;
use crate::formulation::geometry::{Body, geometry};
use crate::math::{Vec3, angle_of};
use crate::mechanism::closure::Closure;
use crate::mechanism::{BaseMotion, Motion, Value};
use crate::random::Random;

/// Number of random states.
const RANDOM: u64 = 24;

/// Largest number of states near aligned axes.
const NEAR_SINGULAR: usize = 36;

/// States in which all joints are aligned.
const TOGETHER: u64 = 6;

/// For a single joint: quarter turns from the position with normals in line, and the deviation, rad.
const ONE_BY_ONE: [(f64, f64); 4] = [(0.0, 1e-8), (2.0, 1e-4), (1.0, 1e-8), (3.0, 0.0)];

/// Deviations for all joints together.
const OFF: [f64; 3] = [0.0, 1e-8, 1e-4];

/// Returns random states: positions within a turn, or a metre; velocities, accelerations and efforts of a
/// few units; every fourth state with a thousand times the velocities, every other fourth with a thousand
/// times the efforts. Run-time parameters have the values of the spec.
pub(crate) fn random(graph: &BondGraph) -> Vec<Inputs<f64>> {
    (0..RANDOM).map(|seed| random_state(graph, seed)).collect()
}

/// Returns states near aligned axes: one joint aligned and the others anywhere, and all joints aligned.
pub(crate) fn near_singular(graph: &BondGraph) -> Vec<Inputs<f64>> {
    // Loops do not close there.
    if graph.closed.is_some() {
        return Vec::new();
    }
    let joints = aligned_joints(graph);
    let at = |joint: &AlignedJoint, turns: f64, off: f64| joint.start + (turns * FRAC_PI_2 + off);
    let mut states = Vec::new();
    for seed in 0..TOGETHER {
        let mut state = random_state(graph, RANDOM + seed);
        let mut random = Random(!seed);
        for joint in &joints {
            // The first state has all normals in line, the next ones in line or folded, then any quarter
            // turn.
            let turns = match seed {
                0 | 1 => 0.0,
                2 | 3 => 2.0 * random.below(2) as f64,
                _ => random.below(4) as f64,
            };
            state.q[joint.position] = at(joint, turns, OFF[seed as usize % OFF.len()]);
        }
        states.push(state);
    }
    let each: Vec<(f64, f64, AlignedJoint)> = ONE_BY_ONE
        .iter()
        .flat_map(|&(turns, off)| joints.iter().map(move |&j| (turns, off, j)))
        .collect();
    for (turns, off, joint) in subsample(&each, NEAR_SINGULAR - states.len()) {
        let mut state = random_state(graph, 1000 + states.len() as u64);
        state.q[joint.position] = at(&joint, turns, off);
        states.push(state);
    }
    states
}

/// Returns, for each joint, the aligned states in which it moves the least inertia, exactly and almost: in
/// them its row of M is the remainder of terms that cancel. At most this number of them, spread over the
/// joints. `moved` returns the inertia that a joint moves, as a function of the state.
pub(crate) fn least_inertia<F: Fn(&Inputs<f64>) -> f64>(
    graph: &BondGraph,
    most: usize,
    moved: impl Fn(usize) -> F,
) -> Vec<Inputs<f64>> {
    let aligned = aligned_joints(graph);
    let n = graph.coordinates.len();
    let every = (0..n).flat_map(|i| OFF.map(|off| (i, off)));
    let kept = subsample(&every.collect::<Vec<_>>(), most);
    let mut states = Vec::new();
    for of_joint in kept.chunk_by(|(i, _), (k, _)| i == k) {
        let i = of_joint[0].0;
        let least = least_inertia_pose(graph, &aligned, i, moved(i));
        for (_, off) in of_joint {
            let mut state = least.clone();
            for joint in &aligned {
                state.q[joint.position] += off;
            }
            states.push(state);
        }
    }
    states
}

/// Returns the state in which joint i moves the least inertia, found joint by joint from the tips inboard.
fn least_inertia_pose(
    graph: &BondGraph,
    aligned: &[AlignedJoint],
    i: usize,
    moved: impl Fn(&Inputs<f64>) -> f64,
) -> Inputs<f64> {
    let mut state = random_state(graph, 2000 + 4 * i as u64);
    for &AlignedJoint { position, start } in aligned.iter().rev() {
        let mut least = (f64::INFINITY, state.q[position]);
        for turns in 0..4 {
            let q = start + f64::from(turns) * FRAC_PI_2;
            state.q[position] = q;
            let moved = moved(&state);
            if moved < least.0 {
                least = (moved, q);
            }
        }
        state.q[position] = least.1;
    }
    state
}

/// Returns at most this number of items, spread over the list.
pub(crate) fn subsample<T: Clone>(all: &[T], most: usize) -> Vec<T> {
    let kept = all.len().min(most);
    (0..kept)
        .map(|i| all[i * all.len() / kept].clone())
        .collect()
}

fn random_state(graph: &BondGraph, seed: u64) -> Inputs<f64> {
    let mut random = Random(seed);
    let (nq, nv) = (graph.positions.len(), graph.coordinates.len());
    let mut all = |n: usize, size: &dyn Fn(usize) -> f64| -> Vec<f64> {
        (0..n).map(|j| random.signed() * size(j)).collect()
    };
    let (fast, forced) = match seed % 4 {
        2 => (1e3, 1.0),
        3 => (1.0, 1e3),
        _ => (1.0, 1.0),
    };
    let turn = |p: usize| match graph.positions[p].unit {
        "rad" => PI,
        _ => 1.0,
    };
    let mut q = all(nq, &turn);
    graph.normalize(&mut q);
    if let Some(closed) = &graph.closed {
        let closed_position = closed_position(&closed.closure, seed);
        for p in closed.closure.moved_positions() {
            q[p.0] = closed_position[p.0].to_f64();
        }
    }
    let (v, a, u) = (
        all(nv, &|_| 2.0 * fast),
        all(nv, &|_| 5.0),
        all(nv, &|_| 10.0 * forced),
    );
    let parameters = graph.parameters.iter();
    let mut parameters: Vec<f64> = parameters.map(|p| p.default.to_f64()).collect();
    let base = graph.base.iter().flat_map(BaseMotion::parameters);
    for (p, size) in base.zip([2.0 * fast; 3].into_iter().chain([10.0; 6])) {
        parameters[p.0] = random.signed() * size;
    }
    for prescribed in graph.released.iter().flat_map(|r| &r.prescribed) {
        let range = if prescribed.linear { 1.0 } else { PI };
        for (p, size) in prescribed.motion.iter().zip([range, 2.0 * fast, 5.0]) {
            parameters[p.0] = random.signed() * size;
        }
    }
    Inputs {
        q,
        v,
        a,
        u,
        parameters,
        ..Inputs::default()
    }
}

/// Returns a closed position at random.
fn closed_position(closure: &Closure, seed: u64) -> Vec<Dd> {
    let near = &closure.samples[seed as usize % closure.samples.len()];
    let mut q = near.clone();
    closure.walk(&closure.position_rows(), &mut q, &mut Random(seed));
    q
}

/// A joint with the position, rad, at which its axes are aligned.
#[derive(Clone, Copy)]
struct AlignedJoint {
    /// The index of its position in q.
    position: usize,
    start: f64,
}

/// Returns, for each rotation with an inboard joint, the position at which the common normals with the
/// axes before and after it have the same direction (θ = 0 of Denavit and Hartenberg). At this position,
/// and at every quarter turn from it, the neighbouring axes are as close to parallel as possible, and the
/// arm is stretched or folded. At a tip the centre of mass replaces the next axis. Not for joints on
/// the base: M does not depend on their positions. Joints that follow others have no position of their own.
fn aligned_joints(graph: &BondGraph) -> Vec<AlignedJoint> {
    let geometry = geometry(graph);
    let bodies = geometry.bodies.iter();
    bodies
        .filter_map(|body| {
            if body.motion != Motion::Rotation || body.parent.is_none() {
                return None;
            }
            let degrees = &graph.frames[body.link().0].degrees;
            let position = degrees.positions.first()?.0;
            if degrees.coupling.is_some() {
                return None;
            }
            let mut start = angle_of(body.phase);
            if body.free_x {
                let [x, y, _] = first_moment(graph, body).0;
                start += Dd::from_f64(f64::atan2(y.to_f64(), x.to_f64()));
            }
            let start = if body.opposite { start } else { -start };
            let start = start.to_f64();
            Some(AlignedJoint { position, start })
        })
        .collect()
}

/// Returns m r of a body in its axes; run-time parameters have the values of the spec.
fn first_moment(graph: &BondGraph, body: &Body) -> Vec3<Dd> {
    let number = |x: Value| match x {
        Value::Fixed(x) => x,
        Value::Parameter(p) => graph.parameters[p.0].default,
    };
    let mut sum = Vec3([Dd::ZERO; 3]);
    for (link, place) in &body.links {
        let inertial = graph.inertial(*link);
        let r = place.translation + place.rotation * inertial.com.map(number);
        sum = sum + r.scale(number(inertial.mass));
    }
    body.axes.transpose() * sum
}

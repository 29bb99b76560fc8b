//! Loads through joints with drives at dependent joints: each link is a free body, whose motion follows from poses
//! alone, under the loads of its joints and loops; forces and motions of references with multipliers.

use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

use super::actuated::{counted, parallel_robots};
use super::free_bodies::{Load, Placed, assert_free_bodies, plus, three};
use super::free_body_cases::{FreeBodyCase, of_other_types, spatial, with_rows_left_out};
use super::references::{joints, numbers, reference, spec};
use super::robot::{Robot, State, Way, close, largest};

const WAYS: [Way; 3] = [None, Some("subspaces"), Some("literal")];

/// Returns joints to drive, by velocity of the tree: some dependent ones, fewer than velocities; a dependent and an
/// independent one; the latter and all dependent ones.
fn drives(robot: &Robot) -> Vec<Vec<usize>> {
    let closure = robot.mechanism.closure().expect("loops");
    let (own, dependents) = (&closure.independents, closure.dependents());
    let dependents: Vec<usize> = dependents.map(|j| j.0).collect();
    let few = dependents.len().min(own.len() - 1).max(1);
    let mixed = vec![dependents[dependents.len() / 2], own[0].0];
    let all = [own[0].0].into_iter().chain(dependents.iter().copied());
    let mut sets = vec![dependents[..few].to_vec(), mixed, all.collect()];
    sets.iter_mut().for_each(|set| set.sort_unstable());
    sets.dedup();
    sets
}

/// Returns the motion of the open tree and the loads on places b under these efforts of the drives, and the loads
/// through the joints.
fn loads(robot: &Robot, way: Way, state: &State<Dd>) -> (State<Dd>, Vec<Dd>, Vec<Dd>) {
    let number = counted(robot);
    let value =
        |state: &State<Dd>, method| -> Vec<Dd> { state.value(&robot.function(way, method)) };
    let found = value(state, Method::ActuatedReactions(number));
    let (accelerations, reactions) = found.split_at(robot.nv());
    let moving = State {
        a: accelerations.to_vec(),
        ..state.clone()
    };
    let motion = State {
        q: state.q.clone(),
        v: value(&moving, Method::TreeVelocity),
        a: value(&moving, Method::TreeAcceleration),
        u: state.u.clone(),
    };
    let joints = value(&moving, Method::ActuatedJointReactions(number));
    (motion, reactions.to_vec(), joints)
}

/// Asserts that each link of a mechanism is a free body, with drives at several sets of joints.
fn compare(case: &FreeBodyCase) {
    let text = &case.text;
    let (tree, free) = (Robot::read(&text.open()), Robot::read(&text.closed()));
    let names = tree.mechanism.joint_names();
    let own = free.mechanism.closure().expect("loops");
    let own: Vec<&str> = own
        .independents
        .iter()
        .map(|j| names[j.0].as_str())
        .collect();
    for set in drives(&free) {
        let driven: Vec<&str> = set.iter().map(|&j| names[j].as_str()).collect();
        let robot = Robot::read(&format!(
            "{}independent: [{}]\nactuated: [{}]\n",
            text.closed(),
            own.join(", "),
            driven.join(", ")
        ));
        let closure = robot.mechanism.closure().expect("loops");
        for seed in 0..2 {
            let mut state = robot.state(seed);
            for p in closure.positions.iter().flatten() {
                state.q[p.0] = closure.samples[5 * seed as usize + 1][p.0];
            }
            let number = |k: usize| Dd::from_f64(7.0 - 4.5 * k as f64 + seed as f64);
            state.u = (0..set.len()).map(number).collect();
            let mut efforts = vec![Dd::ZERO; names.len()];
            for (&j, &effort) in set.iter().zip(&state.u) {
                efforts[j] = effort;
            }
            for way in WAYS {
                let (motion, reactions, through_joints) = loads(&robot, way, &state);
                let given = case.loads(&tree, &motion, &reactions);
                let what = format!("{}, drives {driven:?}, state {seed}, {way:?}", case.what);
                let all = (&through_joints[..], &given[..], &efforts[..]);
                assert_free_bodies(&tree, &motion, all, 1e-17, &what);
            }
        }
    }
}

#[test]
fn links_of_spatial_loops_are_free_bodies() {
    spatial().iter().for_each(compare);
}

#[test]
fn links_of_loops_of_other_types_are_free_bodies() {
    of_other_types().iter().for_each(compare);
}

#[test]
fn links_of_loops_with_rows_left_out_are_free_bodies() {
    with_rows_left_out().iter().for_each(compare);
}

/// The Delta robot driven at its arms with the platform's velocities as v, the Stewart platform driven at its legs:
/// links move as in the references under their forces on the balls, and the loads through the joints.
#[test]
fn links_of_parallel_robots_are_free_bodies_under_the_forces_of_the_references() {
    for (name, text, tolerance) in parallel_robots() {
        let open = spec(name);
        let open = open.split("\nloops:").next().expect("links");
        let (tree, robot) = (Robot::read(&format!("{open}\n")), Robot::read(&text));
        let file = reference(&format!("{name}_static"));
        let (_, independent) = joints(&robot, &file);
        let closure = robot.mechanism.closure().expect("loops");
        let drives = &closure.drives().expect("drives").joints;
        let dd = |x: &serde_json::Value| -> Vec<Dd> {
            numbers(x).into_iter().map(Dd::from_f64).collect()
        };
        for (k, sample) in file["states"].as_array().unwrap().iter().enumerate() {
            let forward = &sample["forward"];
            let (qd, qdd) = (dd(&sample["qd"]), dd(&forward["qdd"]));
            let state = State {
                q: dd(&sample["q"]),
                v: independent.iter().map(|&i| qd[i]).collect(),
                a: independent.iter().map(|&i| qdd[i]).collect(),
                u: dd(&forward["actuator_efforts"]),
            };
            let mut efforts = vec![Dd::ZERO; qd.len()];
            for (j, &effort) in drives.iter().zip(&state.u) {
                efforts[j.0] = effort;
            }
            let motion = State {
                q: state.q.clone(),
                v: qd,
                a: qdd,
                u: efforts.clone(),
            };
            // The file has the forces on the links of places a in fixed axes.
            let lambda = dd(&forward["lambda"]);
            let mut given = Vec::new();
            for (one, force) in closure.loops.iter().zip(lambda.chunks(3)) {
                let [a, b] = one.links.map(|link| link.expect("a link").0);
                let link = &tree.mechanism.links()[a].name;
                let placed = Placed::frame(&tree, link, &motion);
                let at = plus(placed.origin, placed.turned(one.chain.start.translation.0));
                let load = Load::at(at, three(|i| force[i]), [Dd::ZERO; 3]);
                given.push((a, load));
                given.push((b, load.opposite()));
            }
            for way in WAYS {
                let function = robot.function(way, Method::ActuatedJointReactions(drives.len()));
                let found: Vec<Dd> = state.value(&function);
                let what = format!("{name}, state {k}, {way:?}");
                let all = (&found[..], &given[..], &efforts[..]);
                assert_free_bodies(&tree, &motion, all, 10.0 * tolerance, &what);
            }
        }
    }
}

/// With drives at the independent joints alone the loads are those of the mechanism without the key: here one dependent
/// drive without effort is added.
#[test]
fn drives_without_effort_add_no_loads() {
    let plain = Robot::read(&spec("five_bar"));
    let drives = ["proximal1_angle", "distal1_angle", "proximal2_angle"];
    let own = ["proximal1_angle", "proximal2_angle"];
    let robot = Robot::read(&super::actuated::actuated("five_bar", &own, &drives));
    let closure = plain.mechanism.closure().expect("loops");
    for k in 0..3 {
        let mut state = plain.state(k);
        state.q.clone_from(&closure.samples[k as usize]);
        let tau: Vec<Dd> = state.value(&plain.function(None, Method::InverseDynamics));
        let wanted: Vec<Dd> = state.value(&plain.function(None, Method::JointReactions));
        state.u = vec![tau[0], Dd::ZERO, tau[1]];
        let found: Vec<Dd> = state.value(&robot.function(None, Method::ActuatedJointReactions(3)));
        close(&found, &wanted, 1e-24, largest(&wanted), "five-bar");
    }
}

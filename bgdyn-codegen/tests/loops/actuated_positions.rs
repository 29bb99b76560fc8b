//! Actuated joints of random loops against the open tree with multipliers, singular positions of their matrix, and what
//! scenes make of them.

use bgdyn_codegen::method::{Method, SceneFunction};
use bgdyn_codegen::random::Random;
use bgdyn_runtime::{ACTUATORS, Dd};

use super::actuated::{actuated, actuator_matrix, counted, parallel_robots};
use super::findings::found;
use super::frame_rows::minus;
use super::open_tree::TreeEquations;
use super::random_loops::Text;
use super::references::spec;
use super::robot::{Robot, State, Way, close, dot, largest};

const WAYS: [Way; 3] = [None, Some("subspaces"), Some("literal")];

/// Returns the file with random actuated joints that determine the rest: the independent ones, some of them replaced
/// by dependent ones.
fn driven(text: &Text, random: &mut Random) -> Option<Robot> {
    let plain = Robot::read(&text.closed());
    let closure = plain.mechanism.closure().expect("loops");
    let names = Robot::read(&text.open()).mechanism.joint_names();
    let in_loops = closure.moving();
    let dependents: Vec<usize> = closure.dependents().map(|j| j.0).collect();
    for _ in 0..40 {
        let mut chosen: Vec<usize> = closure.independents.iter().map(|j| j.0).collect();
        for j in &mut chosen {
            if in_loops.contains(j) && random.below(2) == 0 {
                *j = dependents[random.below(dependents.len() as u64) as usize];
            }
        }
        let own = closure.independents.iter();
        if own.clone().all(|j| chosen.contains(&j.0)) {
            continue;
        }
        let listed: Vec<&str> = chosen.iter().map(|&j| names[j].as_str()).collect();
        let whole = format!("{}actuated: [{}]\n", text.closed(), listed.join(", "));
        if !found(&whole).any_fault() {
            return Some(Robot::read(&whole));
        }
    }
    None
}

/// Compares with the open tree with multipliers under efforts on the actuated joints.
fn compare_with_tree(text: &Text, seed: u64, what: &str) {
    let mut random = Random(900 + seed);
    let robot = driven(text, &mut random).expect("joints that determine the rest");
    let number = counted(&robot);
    let closure = robot.mechanism.closure().expect("loops");
    let drives = closure.drives().expect("other joints");
    for k in 0..2 {
        let tree = TreeEquations::new(text, &robot, k);
        let efforts: Vec<Dd> = (0..number)
            .map(|_| Dd::from_f64(20.0 * random.signed()))
            .collect();
        let mut all = vec![Dd::ZERO; tree.bias.len()];
        for (j, &effort) in drives.joints.iter().zip(&efforts) {
            all[j.0] = effort;
        }
        let gamma: Vec<Dd> = tree.rows.iter().map(|row| row.1).collect();
        let (accelerations, _) = tree.solved(&minus(&all, &tree.bias), &gamma);
        let own = |of: &[Dd]| -> Vec<Dd> {
            let independents = closure.independents.iter();
            independents.map(|j| of[j.0]).collect()
        };
        let state = State {
            q: tree.state.q.clone(),
            v: own(&tree.state.v),
            a: own(&accelerations),
            u: efforts.clone(),
        };
        let size = largest(&accelerations).max(largest(&tree.bias));
        for way in WAYS {
            let what = format!("{what}, {k}, {way:?}");
            let found = state.value(&robot.function(way, Method::ActuatedForward(number)));
            close(&found, &state.a, 1e-21, size, &what);
            let found = state.value(&robot.function(way, Method::ActuatedInverse(number)));
            close(&found, &efforts, 1e-20, size, &format!("{what}: efforts"));
        }
    }
}

#[test]
fn random_loops_are_driven_as_with_multipliers() {
    for (seed, root) in ["fixed", "floating", "spherical"].into_iter().enumerate() {
        let mut random = Random(500 + seed as u64);
        let text = Text::point_and_rod(&mut random, root);
        compare_with_tree(&text, seed as u64, &format!("point and rod, {root}"));
    }
    let kinds = ["hinge", "slider", "weld", "universal"];
    for (seed, kind) in kinds.into_iter().enumerate() {
        let mut random = Random(600 + seed as u64);
        let text = Text::of_type(&mut random, "fixed", kind);
        compare_with_tree(&text, 10 + seed as u64, kind);
    }
}

/// Distal links on one line, the first on the side where the second crank has its pivot.
fn aligned(robot: &Robot, off: f64) -> State<Dd> {
    // The ends of the cranks are 0.7 m apart, both 0.15 m above the line of the pivots.
    let [crank, pi] = [arc_sine("0.6"), Dd::PI];
    let first = pi - crank;
    let closure = robot.mechanism.closure().expect("loops");
    let mut q = vec![first, Dd::from_f64(off) - first, crank, pi - crank];
    assert!(closure.close(&mut q), "off by {off}");
    State {
        q,
        v: [0.7, -1.2].map(Dd::from_f64).to_vec(),
        a: [3.0, 2.0].map(Dd::from_f64).to_vec(),
        u: [1.5, -2.5].map(Dd::from_f64).to_vec(),
    }
}

/// Returns the angle below a quarter turn with this sine, by Newton's method.
fn arc_sine(sine: &str) -> Dd {
    let sine: Dd = sine.parse().expect("a number");
    let mut angle = Dd::from_f64(sine.to_f64().asin());
    for _ in 0..3 {
        let (sin, cos) = angle.sin_cos();
        angle += (sine - sin) / cos;
    }
    angle
}

#[test]
fn where_distal_links_are_aligned_efforts_do_not_exist_and_accelerations_do() {
    let (own, drives) = (
        ["proximal1_angle", "distal1_angle"],
        ["proximal1_angle", "proximal2_angle"],
    );
    let robot = Robot::read(&actuated("five_bar", &own, &drives));
    let (inverse, forward) = (Method::ActuatedInverse(2), Method::ActuatedForward(2));
    let state = aligned(&robot, 0.0);
    for way in WAYS {
        // Drives, the loop, and then the second of the independent joints.
        let place = ACTUATORS + 2 + 1 + 1;
        let (_, refused) = state.checked(&robot.function(way, inverse));
        assert_eq!(refused, Some(place), "{way:?}");
        let (_, refused) = state.rounded().checked(&robot.function(way, inverse));
        assert_eq!(refused, Some(place), "{way:?} in f64");
        // The literal sum has A τ.
        let moved: Vec<Dd> = state.value(&robot.function(way, forward));
        let moving = State {
            a: moved,
            ..state.clone()
        };
        let needed: Vec<Dd> =
            moving.value(&robot.function(Some("literal"), Method::InverseDynamics));
        let a = actuator_matrix(&robot, &state);
        let along: Vec<Dd> = a.iter().map(|row| dot(row, &state.u)).collect();
        close(&needed, &along, 1e-24, largest(&needed), "A τ");
        let reduced: Vec<Dd> = state.value(&robot.function(way, Method::InverseDynamics));
        assert!(largest(&reduced) < 1e3, "regular");
    }
    // On both sides of the singular position efforts exist, and grow towards it.
    for side in [1.0, -1.0] {
        let mut before = 0.0;
        for off in [0.1, 1e-3, 1e-6, 1e-9] {
            let state = aligned(&robot, side * off);
            let found: Vec<Dd> = state.value(&robot.function(None, inverse));
            let f: Vec<Dd> = state.value(&robot.function(Some("literal"), Method::InverseDynamics));
            let a = actuator_matrix(&robot, &state);
            let along: Vec<Dd> = a.iter().map(|row| dot(row, &found)).collect();
            close(&along, &f, 1e-26, largest(&found), "A P");
            assert!(largest(&found) > before, "{side} {off}");
            before = largest(&found);
        }
        assert!(before > 1e6);
    }
}

/// A pivot of the matrix is not refused where the matrix is regular, in whatever order the rows are taken.
#[test]
fn regular_positions_of_the_stewart_platform_are_never_refused() {
    let [_, (name, text, _)] = parallel_robots();
    let robot = Robot::read(&text);
    let closure = robot.mechanism.closure().expect("loops");
    let inverse = robot.function(None, Method::ActuatedInverse(6));
    let mut random = Random(3);
    let mut reached = 0;
    for _ in 0..300 {
        let mut q = closure.start.clone();
        for (k, p) in q.iter_mut().take(6).enumerate() {
            let size = if k < 3 { 0.15 } else { 0.6 };
            *p += Dd::from_f64(size * random.signed());
        }
        if !closure.close(&mut q) {
            continue;
        }
        let state = State {
            q,
            v: vec![Dd::ZERO; 6],
            a: vec![Dd::ONE; 6],
            u: vec![],
        };
        reached += 1;
        let (_, refused) = state.rounded().checked(&inverse);
        assert_eq!(refused, None, "{name} at {:?}", state.rounded().q);
    }
    assert!(reached > 200, "{reached}");
}

#[test]
fn listing_the_independent_joints_changes_no_function() {
    let with = Robot::read(&actuated(
        "five_bar",
        &["proximal1_angle", "proximal2_angle"],
        &["proximal2_angle", "proximal1_angle"],
    ));
    let closure = with.mechanism.closure().expect("loops");
    assert!(closure.actuated.is_some() && closure.drives().is_none());
    let without = Robot::read(&spec("five_bar"));
    for method in Method::OF_TRAIT {
        let [a, b] = [&with, &without].map(|robot| robot.function(None, method));
        assert_eq!(a.operations(), b.operations(), "{method:?}");
    }
    assert_eq!(
        Method::possible_of(&with.graph),
        Method::possible_of(&without.graph)
    );
}

#[test]
fn scenes_of_such_mechanisms_are_those_without_the_key() {
    let text =
        "scene: 1\nmechanism: five_bar.yaml\neffects: [gravity, inertia, velocity_products]\n";
    let counts = |mechanism: String| {
        let read = bgdyn_codegen::read_scene(text, "scene", |_| Ok(mechanism.clone()));
        let (system, _) = read.unwrap_or_else(|refusal| panic!("{refusal:?}"));
        system.function(SceneFunction::Derivative).operations()
    };
    let own = ["proximal1_angle", "proximal2_angle"];
    let driven = actuated("five_bar", &own, &["distal1_angle", "distal2_angle"]);
    assert_eq!(counts(driven), counts(spec("five_bar")));
}

/// Drives of scenes are where the scene names them; a computed torque of one dependent joint alone leaves the other of
/// two velocities open.
#[test]
fn a_computed_torque_of_one_dependent_joint_is_refused_by_name() {
    let own = ["proximal1_angle", "proximal2_angle"];
    let driven = actuated("five_bar", &own, &["distal1_angle", "distal2_angle"]);
    let scene = |joint: &str| {
        let law = "{ target: 0.5, stiffness: 100, damping: 20 }";
        let text = format!(
            "scene: 1\nmechanism: five_bar.yaml\neffects: [gravity, inertia, velocity_products]\ninputs: {{ {joint}: {{ computed_torque: {law} }} }}\n"
        );
        let read = bgdyn_codegen::read_scene(&text, "scene", |_| Ok(driven.clone()));
        read.err().map(|refusal| format!("{refusal:?}"))
    };
    assert_eq!(scene("proximal1_angle"), None);
    let refused = scene("distal1_angle").expect("a dependent joint");
    assert!(refused.contains("undetermined: follow 1 more"), "{refused}");
}

/// A scene locks an actuated joint, or another one; the machine without drives at it is what moves.
#[test]
fn scenes_lock_actuated_joints() {
    let own = ["proximal1_angle", "proximal2_angle"];
    let driven = actuated("five_bar", &own, &["proximal1_angle", "distal2_angle"]);
    for (joint, at) in [
        ("proximal1_angle", 2.0),
        ("distal2_angle", 1.29),
        ("proximal2_angle", 1.1),
    ] {
        let text = format!(
            "scene: 1\nmechanism: five_bar.yaml\neffects: [gravity, inertia, velocity_products]\nlock: {{ {joint}: {at} }}\n"
        );
        let system = |mechanism: String| {
            let read = bgdyn_codegen::read_scene(&text, "scene", |_| Ok(mechanism.clone()));
            read.unwrap_or_else(|refusal| panic!("{joint}: {refusal:?}"))
                .0
        };
        let counts = |mechanism| {
            let system = system(mechanism);
            assert_eq!(system.scene.layout.nv(), 1, "{joint}");
            system.function(SceneFunction::Derivative).operations()
        };
        assert_eq!(counts(driven.clone()), counts(spec("five_bar")), "{joint}");
    }
}

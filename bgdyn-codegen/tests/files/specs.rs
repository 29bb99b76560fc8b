//! Checks the example mechanisms in `specs/`: all are read without a finding, and each has the properties
//! in its comments.

use std::fs;
use std::path::{Path, PathBuf};

use crate::common::rng::Rng;
use crate::common::{FORMULATIONS, Robot, State, assert_close, full, golden, largest};
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::selection;
use bgdyn_runtime::Dd;
use nalgebra::DMatrix;

/// Examples that are golden robots under other names: the example, the golden robot.
const SAME: [(&str, &str); 3] = [
    ("panda", "panda7"),
    ("puma560", "puma560"),
    ("scara", "scara4"),
];
const STATES: u64 = 50;
/// Relative to the largest entry.
const TOLERANCE: f64 = 1e-12;

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../specs/{name}.yaml"))
}

fn robot(name: &str) -> Robot {
    let text = fs::read_to_string(file(name)).expect("an example");
    Robot::read(&text, Some(name))
}

/// M(q) by rows.
fn mass_matrix(robot: &Robot, formulation: &str, s: &State) -> Vec<Vec<f64>> {
    let function = robot.function(formulation, Method::MassMatrix);
    full(&s.value::<f64>(&function), robot.nv())
}

#[test]
fn every_example_is_read_without_a_finding() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs");
    let entries = fs::read_dir(folder).expect("the folder specs");
    let mut examples = 0;
    for path in entries.map(|entry| entry.expect("an entry").path()) {
        if path.extension().is_none_or(|ending| ending != "yaml") {
            continue;
        }
        let text = fs::read_to_string(&path).expect("a readable example");
        let stem = path.file_stem().and_then(|stem| stem.to_str());
        let (mechanism, faults) = bgdyn_codegen::read(&text, stem);
        let name = stem.expect("a stem");
        let shown = faults.render(&format!("specs/{name}.yaml"), &text);
        assert!(faults.0.is_empty(), "{shown}");
        let mechanism = mechanism.expect("nothing refuses it");
        assert!(mechanism.description().is_some(), "{name} says nothing");
        examples += 1;
    }
    assert!(examples >= 7);
}

/// Both in the same random states, method by method; joints correspond by their order.
#[test]
fn examples_equal_their_golden_robots() {
    let mut compared = 0;
    for (example, golden) in SAME {
        if file(example).exists() {
            equal(&robot(example), &golden::robot(golden), example);
            compared += 1;
        }
    }
    assert!(compared > 0);
}

fn equal(x: &Robot, y: &Robot, name: &str) {
    assert_eq!(x.motions(), y.motions(), "{name}");
    let mut rng = Rng::new(7);
    let states: Vec<State> = (0..STATES)
        .map(|_| State::random(&mut rng, &x.motions()))
        .collect();
    for method in Method::OF_TRAIT {
        let function = |robot: &Robot| robot.function("recursion", method);
        let (f, g) = (function(x), function(y));
        let mut first: Option<(f64, f64)> = None;
        for (k, s) in states.iter().enumerate() {
            let (mut f, mut g) = (s.value::<f64>(&f), s.value::<f64>(&g));
            let mut allowed = TOLERANCE * largest(&g);
            if method == Method::PotentialEnergy {
                // Up to a constant: the world's origin may differ.
                let (f0, g0) = *first.get_or_insert((f[0], g[0]));
                (f[0], g[0]) = (f[0] - f0, g[0] - g0);
                allowed = allowed.max(TOLERANCE * g0.abs());
            }
            if method == Method::ForwardDynamics {
                let rows = mass_matrix(y, "recursion", s);
                let m = DMatrix::from_fn(y.nv(), y.nv(), |i, j| rows[i][j]);
                let singular = m.singular_values();
                allowed = allowed.max(1e-15 * singular.max() / singular.min() * largest(&g));
            }
            let what = || format!("{name}, {}, state {k}", method.name(&x.graph.sites));
            assert_close(&f, &g, allowed, what);
        }
    }
}

/// The closed form in the file's comment.
#[test]
fn the_double_pendulum_is_the_textbooks() {
    let robot = robot("double_pendulum");
    let g = 9.81;
    let mut rng = Rng::new(1);
    for k in 0..STATES {
        let s = State::random(&mut rng, &robot.motions());
        let ([q1, q2], [v1, v2]) = ([s.q[0], s.q[1]], [s.v[0], s.v[1]]);
        let (sin1, sin12) = (q1.sin(), (q1 + q2).sin());
        let (sin2, cos2) = q2.sin_cos();
        let m = [3.0 + 2.0 * cos2, 1.0 + cos2, 1.0];
        let bias = [
            -sin2 * (2.0 * v1 + v2) * v2 + g * (2.0 * sin1 + sin12),
            sin2 * v1 * v1 + g * sin12,
        ];
        for formulation in FORMULATIONS {
            let what = || format!("{formulation}, state {k}");
            let value = |method| s.value::<f64>(&robot.function(formulation, method));
            assert_close(&value(Method::MassMatrix), &m, 1e-13, what);
            assert_close(&value(Method::Bias), &bias, 1e-12, what);
        }
    }
}

#[test]
fn the_gantrys_mass_matrix_is_diagonal_and_constant() {
    let robot = robot("gantry");
    let masses = [[325.0, 0.0, 0.0], [0.0, 85.0, 0.0], [0.0, 0.0, 25.0]];
    for formulation in FORMULATIONS {
        let function = robot.whole(formulation, Method::MassMatrix);
        for (k, &entry) in function.blocks[0].outputs.iter().enumerate() {
            let constant = function.graph.constant_of(entry);
            assert!(constant.is_some(), "{formulation}: entry {k} varies");
        }
        let mut rng = Rng::new(2);
        let s = State::random(&mut rng, &robot.motions());
        assert_eq!(mass_matrix(&robot, formulation, &s), masses);
    }
}

/// The joints of one arm of the torso.
fn arm(robot: &Robot, side: &str) -> Vec<usize> {
    let joints = robot.joints();
    let arm: Vec<usize> = (0..joints.len())
        .filter(|&j| joints[j].starts_with(side))
        .collect();
    assert_eq!(arm.len(), 5, "{joints:?}");
    arm
}

#[test]
fn the_torsos_arms_meet_nowhere_in_the_mass_matrix() {
    let robot = robot("torso");
    let (left, right) = (arm(&robot, "left_"), arm(&robot, "right_"));
    for formulation in FORMULATIONS {
        let function = robot.whole(formulation, Method::MassMatrix);
        let rows = full(&function.blocks[0].outputs, robot.nv());
        for &i in &left {
            for &j in &right {
                let entry = function.graph.constant_of(rows[i][j]);
                assert_eq!(entry, Some(Dd::ZERO), "{formulation}: [{i}, {j}]");
            }
        }
    }
}

#[test]
fn the_torsos_right_arm_mirrors_the_left() {
    let robot = robot("torso");
    let (left, right) = (arm(&robot, "left_"), arm(&robot, "right_"));
    let function = robot.function("recursion", Method::InverseDynamics);
    let mut rng = Rng::new(3);
    for k in 0..STATES {
        let s = State::random(&mut rng, &robot.motions());
        // Its mirror image: arms exchanged, the waist rotated the other way.
        let mirrored = |x: &[f64]| {
            let mut y: Vec<f64> = x.iter().map(|x| -x).collect();
            for (&l, &r) in left.iter().zip(&right) {
                (y[l], y[r]) = (x[r], x[l]);
            }
            y
        };
        let image = State {
            q: mirrored(&s.q),
            v: mirrored(&s.v),
            a: mirrored(&s.a),
            tau: mirrored(&s.tau),
            parameters: vec![],
        };
        let efforts = s.value::<f64>(&function);
        let allowed = TOLERANCE * largest(&efforts);
        let image = image.value::<f64>(&function);
        assert_close(&image, &mirrored(&efforts), allowed, || {
            format!("state {k}")
        });
    }
}

/// Angles about parallel axes add up before their sine is taken.
#[test]
fn the_palletiser_takes_no_sine_twice() {
    let robot = robot("palletiser");
    for method in Method::OF_TRAIT {
        let function = selection::function(&robot.mechanism, method, &Options::default());
        let pairs = function.expect("every method").operations().sincos;
        let (name, joints) = (method.name(&robot.graph.sites), robot.nv());
        assert!(pairs <= joints, "{name}: {pairs} pairs for {joints} joints");
    }
}

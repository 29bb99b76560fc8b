//! Random loops of every type against the open tree with multipliers: M q̈ + h = P + Bᵀ λ, B q̈ = γ, solved here in
//! double-double. B and γ come from the Jacobians and accelerations of frames of the open tree.

use bgdyn_codegen::method::Method;
use bgdyn_codegen::random::Random;
use bgdyn_runtime::Dd;

use super::frame_rows::{FrameMotion, minus, rows};
use super::multiplier_system::with_rows;
use super::random_loops::{Text, noisy};
use super::robot::{Robot, State, Way, close, dot, full, largest, times};

const WAYS: [Way; 2] = [None, Some("subspaces")];

/// Compares at closed positions with random velocities and efforts.
pub fn compare(text: &Text, what: &str) {
    let (tree, robot) = (Robot::read(&text.open()), Robot::read(&text.closed()));
    let closure = robot.mechanism.closure().expect("loops").clone();
    assert_eq!(robot.nv() + closure.rows.len(), tree.nv(), "{what}");
    for k in 0..3 {
        let mut random = Random(40 + k as u64);
        let mut state = robot.state(k as u64);
        for p in closure.moved_positions() {
            state.q[p.0] = closure.samples[5 * k + 1][p.0];
        }
        let value = |method| -> Vec<Dd> { state.value(&robot.function(None, method)) };
        let rates = value(Method::TreeVelocity);
        let efforts: Vec<Dd> = closure
            .independents
            .iter()
            .map(|_| Dd::from_f64(20.0 * random.signed()))
            .collect();
        let mut all = vec![Dd::ZERO; tree.nv()];
        closure
            .independents
            .iter()
            .zip(&efforts)
            .for_each(|(j, &p)| all[j.0] = p);
        let of_tree = State {
            q: state.q.clone(),
            v: rates.clone(),
            a: vec![Dd::ZERO; tree.nv()],
            u: all.clone(),
        };
        // The rows, with B q̇ = 0.
        let mut b: Vec<(Vec<Dd>, Dd)> = Vec::new();
        for (l, one) in text.all.iter().enumerate() {
            let [a, other] =
                ["a", "b"].map(|end| FrameMotion::new(&tree, &format!("{end}{l}"), &of_tree));
            b.extend(rows(one, &a, &other));
        }
        for (row, _) in &b {
            let off = dot(row, &rates).to_f64().abs();
            assert!(off < 1e-24 * largest(&rates), "{what}: a rate of {off:e}");
        }
        let n = tree.nv();
        let mass = full(&of_tree.value(&tree.function(None, Method::MassMatrix)), n);
        let bias: Vec<Dd> = of_tree.value(&tree.function(None, Method::Bias));
        let gamma: Vec<Dd> = b.iter().map(|(_, gamma)| *gamma).collect();
        let solution = with_rows(&mass, &b, [&minus(&all, &bias), &gamma]);
        let (accelerations, lambda) = solution.split_at(n);
        let expected: Vec<Dd> = closure
            .independents
            .iter()
            .map(|j| accelerations[j.0])
            .collect();
        let size = largest(accelerations);
        state.u = efforts.clone();
        for way in WAYS {
            let found: Vec<Dd> = state.value(&robot.function(way, Method::ForwardDynamics));
            close(
                &found,
                &expected,
                1e-22,
                size,
                &format!("{what}, {way:?}: accelerations"),
            );
            let moving = State {
                a: expected.clone(),
                ..state.clone()
            };
            let found: Vec<Dd> = moving.value(&robot.function(way, Method::InverseDynamics));
            close(
                &found,
                &efforts,
                1e-22,
                largest(&bias).max(size),
                &format!("{what}, {way:?}: efforts"),
            );
            let found: Vec<Dd> = moving.value(&robot.function(way, Method::TreeAcceleration));
            close(
                &found,
                accelerations,
                1e-22,
                size,
                &format!("{what}, {way:?}: the tree's accelerations"),
            );
            // Bᵀ λ, whatever the axes of the rows.
            let own: Vec<Dd> = moving.value(&robot.function(way, Method::Multipliers));
            let jacobian: Vec<Dd> = moving.value(&robot.function(way, Method::ConstraintJacobian));
            let own_rows: Vec<&[Dd]> = jacobian.chunks(n).collect();
            let sum = |rows: &[&[Dd]], of: &[Dd], j: usize| {
                rows.iter()
                    .zip(of)
                    .fold(Dd::ZERO, |sum, (row, &x)| sum + row[j] * x)
            };
            let other_rows: Vec<&[Dd]> = b.iter().map(|(row, _)| row.as_slice()).collect();
            let found: Vec<Dd> = (0..n).map(|j| sum(&own_rows, &own, j)).collect();
            let wanted: Vec<Dd> = (0..n).map(|j| sum(&other_rows, lambda, j)).collect();
            close(
                &found,
                &wanted,
                1e-21,
                largest(&bias).max(largest(&all)),
                &format!("{what}, {way:?}: efforts of the loops"),
            );
        }
        // M_u = Sᵀ M S
        let map: Vec<Dd> = state.value(&robot.function(None, Method::VelocityMap));
        let columns: Vec<Vec<Dd>> = (0..robot.nv())
            .map(|k| map.iter().skip(k).step_by(robot.nv()).copied().collect())
            .collect();
        let found = full(
            &state.value(&robot.function(None, Method::MassMatrix)),
            robot.nv(),
        );
        for (k, column) in columns.iter().enumerate() {
            let moved = times(&mass, column);
            let wanted: Vec<Dd> = columns.iter().map(|other| dot(other, &moved)).collect();
            close(
                &found[k],
                &wanted,
                1e-23,
                1.0,
                &format!("{what}: mass matrix"),
            );
        }
    }
}

#[test]
fn points_and_rods_move_as_with_multipliers() {
    for (seed, root) in ["fixed", "floating", "spherical"].into_iter().enumerate() {
        let mut random = Random(100 + seed as u64);
        let mut text = Text::new(&mut random, root, 4, noisy);
        text.connect(&mut random, "point", [4, 8], ([0, 0, 1000], [0; 3]));
        text.connect(
            &mut random,
            "distance",
            [3, 6],
            ([0, 0, 1000], [30, 40, 120]),
        );
        compare(&text, &format!("point and rod, {root}"));
    }
}

#[test]
fn hinges_sliders_welds_and_universal_joints_move_as_with_multipliers() {
    for (seed, kind) in ["hinge", "slider", "weld", "universal"]
        .into_iter()
        .enumerate()
    {
        let mut random = Random(200 + seed as u64);
        let text = Text::of_type(&mut random, "spherical", kind);
        compare(&text, kind);
    }
}

/// All axes parallel to one direction that is no axis of any frame: three rows of a hinge hold everywhere.
#[test]
fn planar_loops_in_any_direction_move_as_with_multipliers() {
    for (seed, root) in ["fixed", "floating"].into_iter().enumerate() {
        let mut random = Random(300 + seed as u64);
        let mut text = Text::planar(&mut random, root, 3);
        text.connect(&mut random, "hinge", [3, 6], ([0, 0, 1000], [0; 3]));
        let robot = Robot::read(&text.closed());
        let closure = robot.mechanism.closure().expect("loops");
        assert_eq!((closure.rows.len(), closure.dropped.len()), (2, 3));
        compare(&text, &format!("planar, {root}"));
    }
}

/// Two loops in series: the second one needs the first one's joints, and is solved after it.
#[test]
fn loops_in_series_are_solved_one_after_the_other() {
    let mut random = Random(400);
    let mut text = Text::planar(&mut random, "fixed", 4);
    text.connect(&mut random, "hinge", [2, 5], ([0, 0, 1000], [0; 3]));
    text.connect(&mut random, "hinge", [4, 8], ([0, 0, 1000], [0; 3]));
    let robot = Robot::read(&text.closed());
    let closure = robot.mechanism.closure().expect("loops");
    assert!(closure.blocks.len() >= 2, "{:?}", closure.blocks);
    compare(&text, "in series");
}

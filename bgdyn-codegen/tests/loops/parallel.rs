//! Parallelograms on their parallel branch: their loops are closed at every position, flat ones too, and they move as
//! the open tree with multipliers, and as joints that follow by hand.

use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::selection::model;
use bgdyn_codegen::verify::check_model;
use bgdyn_runtime::Dd;

use super::drawn::{NORMAL, at, connect, four_bar, link, on, turning, xyz};
use super::frame_rows::{FrameMotion, minus, rows};
use super::multiplier_system::with_rows;
use super::random_loops::Text;
use super::references::spec;
use super::robot::{Robot, State, Way, close, dot, full, largest};
use super::turned_signs::assert_turned_signs_are_refused;

const WAYS: [Way; 3] = [None, Some("subspaces"), Some("literal")];

const PARALLEL: &str = "    branch: parallel\n";

/// Positions of the joints that others follow: at random, then some at which parallelograms lie flat.
fn states(robot: &Robot) -> Vec<State<Dd>> {
    let flat = [Dd::ZERO, Dd::PI, -Dd::FRAC_PI_2];
    let random = (0..3).map(|seed| robot.state(seed));
    let at = |(k, angle): (usize, &Dd)| {
        let mut state = robot.state(10 + k as u64);
        for link in robot.mechanism.links() {
            let joint = &link.joint;
            if joint.kind.keyword == "continuous" && joint.degrees.own_positions() {
                state.q[joint.degrees.positions[0].0] = *angle;
            }
        }
        state
    };
    random.chain(flat.iter().enumerate().map(at)).collect()
}

/// Returns positions, velocities and accelerations of all joints of the tree.
fn motion(robot: &Robot, state: &State<Dd>) -> State<Dd> {
    let joints = || {
        robot
            .mechanism
            .links()
            .iter()
            .map(|link| &link.joint.degrees)
    };
    let rates = |of: &[Dd]| {
        joints()
            .flat_map(|d| d.velocities_of(|j| of[j.0]))
            .collect()
    };
    State {
        q: joints()
            .flat_map(|d| d.positions_of(|p| state.q[p.0]))
            .collect(),
        v: rates(&state.v),
        a: rates(&state.a),
        u: vec![],
    }
}

/// Returns Sᵀ P: the efforts of all joints of the tree at the joints that others follow.
fn reduced(robot: &Robot, efforts: &[Dd]) -> Vec<Dd> {
    let mut sums = vec![Dd::ZERO; robot.nv()];
    let mut efforts = efforts.iter();
    for link in robot.mechanism.links() {
        let degrees = &link.joint.degrees;
        match degrees.coupling.is_some() {
            true => {
                let effort = *efforts.next().expect("an effort");
                for (j, ratio) in degrees.velocities.iter().zip(degrees.velocity_ratios()) {
                    sums[j.0] += ratio * effort;
                }
            }
            false => {
                for j in &degrees.velocities {
                    sums[j.0] += *efforts.next().expect("an effort");
                }
            }
        }
    }
    sums
}

/// Asserts that all loops are closed, with velocities and accelerations, to 1e-28 of the size; returns the rows of the
/// loops, with their right sides γ.
fn assert_closed(text: &Text, tree: &Robot, state: &State<Dd>, what: &str) -> Vec<(Vec<Dd>, Dd)> {
    let mut all = Vec::new();
    for (k, one) in text.all.iter().enumerate() {
        let [a, b] = ["a", "b"].map(|end| FrameMotion::new(tree, &format!("{end}{k}"), state));
        close(&b.origin, &a.origin, 1e-28, 1.0, &format!("{what}: places"));
        if one.kind == "hinge" {
            let [a, b] = [&a, &b].map(|place| place.turned(one.axis));
            close(&b, &a, 1e-28, 1.0, &format!("{what}: axes"));
        }
        all.extend(rows(one, &a, &b));
    }
    for (row, gamma) in &all {
        let rate = dot(row, &state.v).to_f64().abs();
        assert!(
            rate < 1e-28 * largest(&state.v),
            "{what}: a rate of {rate:e}"
        );
        let off = (dot(row, &state.a) - *gamma).to_f64().abs();
        let size = largest(&state.a) + largest(&state.v).powi(2);
        assert!(off < 1e-27 * size, "{what}: an acceleration of {off:e}");
    }
    all
}

/// Compares with the tree: closed loops, efforts Sᵀ (M q̈ + h); away from flat positions, at which rows depend on each
/// other, with accelerations of the tree with multipliers.
fn compare(text: &Text, [nv, rows]: [usize; 2], what: &str) {
    let (tree, robot) = (Robot::read(&text.open()), Robot::read(&text.closed()));
    assert!(robot.mechanism.closure().is_none(), "{what}");
    let parallel = robot.mechanism.parallel_loops();
    assert_eq!(parallel.len(), text.all.len(), "{what}");
    let found: usize = parallel.iter().map(|one| one.rows).sum();
    assert_eq!([robot.nv(), found], [nv, rows], "{what}");
    assert_eq!(tree.nv(), nv + rows, "{what}");
    for (k, state) in states(&robot).into_iter().enumerate() {
        let what = format!("{what}, state {k}");
        let of_tree = motion(&robot, &state);
        let b = assert_closed(text, &tree, &of_tree, &what);
        let needed: Vec<Dd> = of_tree.value(&tree.function(None, Method::InverseDynamics));
        let expected = reduced(&robot, &needed);
        let size = largest(&needed);
        for way in WAYS {
            let efforts: Vec<Dd> = state.value(&robot.function(way, Method::InverseDynamics));
            close(
                &efforts,
                &expected,
                1e-27,
                size,
                &format!("{what}, {way:?}: efforts"),
            );
        }
        if k < 3 {
            let mass = full(
                &of_tree.value(&tree.function(None, Method::MassMatrix)),
                tree.nv(),
            );
            let bias: Vec<Dd> = of_tree.value(&tree.function(None, Method::Bias));
            let drive = minus(&drives(&robot, &state.u), &bias);
            let gamma: Vec<Dd> = b.iter().map(|(_, gamma)| *gamma).collect();
            let mut accelerations = with_rows(&mass, &b, [&drive, &gamma]);
            accelerations.truncate(tree.nv());
            for way in WAYS {
                let found: Vec<Dd> = state.value(&robot.function(way, Method::ForwardDynamics));
                let moved = State {
                    a: found,
                    ..state.clone()
                };
                let all = motion(&robot, &moved).a;
                let what = format!("{what}, {way:?}: accelerations");
                close(&all, &accelerations, 1e-22, 1.0, &what);
            }
        }
    }
}

/// Returns the efforts of all joints of the tree where only those that others follow are driven.
fn drives(robot: &Robot, efforts: &[Dd]) -> Vec<Dd> {
    let own = robot
        .mechanism
        .links()
        .iter()
        .map(|link| &link.joint.degrees);
    own.flat_map(|degrees| match degrees.coupling.is_some() {
        true => vec![Dd::ZERO],
        false => degrees.velocities.iter().map(|j| efforts[j.0]).collect(),
    })
    .collect()
}

/// A point of the plane, lifted along its normal.
fn lifted(x: f64, y: f64, z: f64) -> [f64; 3] {
    let flat = at(x, y);
    std::array::from_fn(|k| flat[k] + z * NORMAL[k])
}

/// A crank of 0.12 m and a ground of 0.35 m; coupler and rocker are as long.
#[test]
fn a_parallelogram_in_any_plane_is_closed_everywhere() {
    for (root, kind, nv) in [
        ("fixed", "hinge", 1),
        ("floating", "point", 7),
        ("spherical", "hinge", 4),
    ] {
        let mut text = four_bar(root, [0.12, 0.35]);
        let ends = [at(0.35, 0.0), at(0.12, 0.0)].map(xyz);
        let ends = [("coupler", ends[0].as_str()), ("rocker", &ends[1])];
        connect(&mut text, kind, ends, (NORMAL, PARALLEL));
        compare(&text, [nv, 2], &format!("{kind}, {root}"));
    }
}

/// Links whose axes are turned and lifted: the joints follow with offsets, one about the opposite axis; written from
/// both ends.
#[test]
fn offsets_of_turned_links_are_exact() {
    let opposite = NORMAL.map(|x: f64| -x);
    for (swapped, axis) in [(false, NORMAL), (true, opposite)] {
        let mut text = on("fixed");
        // Sides: crank 0.5, coupler and ground √0.05.
        link(
            &mut text,
            ("crank", "body_0"),
            &turning(NORMAL, lifted(0.01, 0.02, 0.03)),
        );
        link(
            &mut text,
            ("coupler", "crank"),
            &turning(NORMAL, lifted(0.3, 0.4, 0.05)),
        );
        link(
            &mut text,
            ("rocker", "body_0"),
            &turning(axis, lifted(0.21, 0.12, -0.01)),
        );
        let ends = [lifted(0.1, -0.2, 0.01), lifted(0.5, 0.0, 0.1)].map(xyz);
        let mut ends = [("coupler", ends[0].as_str()), ("rocker", &ends[1])];
        if swapped {
            ends.reverse();
        }
        connect(&mut text, "hinge", ends, (NORMAL, PARALLEL));
        compare(&text, [1, 2], &format!("turned links, {swapped}"));
    }
}

/// Links are turned about noisy axes; only the plane is that of the world.
#[test]
fn places_in_turned_axes_are_exact() {
    let mut random = Random(5);
    for k in 0..3 {
        let mut angle = || format!("{:.3}", 3.0 * random.signed());
        let mut text = on("fixed");
        let mut turned = |name: &str, parent: &str, origin: [f64; 3]| {
            let origin = super::drawn::vector(origin);
            let turn = angle();
            let joint = format!(
                "type: continuous, axis: z, origin: {{ xyz: {origin}, rpy: [0, 0, {turn}] }}"
            );
            link(&mut text, (name, parent), &joint);
        };
        turned("crank", "body_0", [0.0, 0.1, 0.2]);
        turned("coupler", "crank", [0.48, -0.14, 0.1]);
        turned("rocker", "body_0", [0.36, 0.58, 0.4]);
        let ends = [xyz([0.0, -0.6, -0.3]), xyz([0.3, 0.4, -0.4])];
        let ends = [("coupler", ends[0].as_str()), ("rocker", &ends[1])];
        let z = [0.0, 0.0, 1.0];
        connect(&mut text, "hinge", ends, (z, PARALLEL));
        compare(&text, [1, 2], &format!("turned axes {k}"));
    }
}

/// Windows in a row. The first loop goes through joints that follow by the second one only.
#[test]
fn windows_in_a_row_follow_one_crank() {
    let mut text = on("fixed");
    link(&mut text, ("rod0", "body_0"), &turning(NORMAL, [0.0; 3]));
    link(
        &mut text,
        ("coupler1", "rod0"),
        &turning(NORMAL, at(0.4, 0.3)),
    );
    // Rods come down from couplers to their pins on the ground.
    link(
        &mut text,
        ("rod1", "coupler1"),
        &turning(NORMAL, at(0.7, 0.0)),
    );
    link(&mut text, ("coupler2", "rod1"), &turning(NORMAL, [0.0; 3]));
    link(
        &mut text,
        ("rod2", "coupler2"),
        &turning(NORMAL, at(0.2, 0.1)),
    );
    for (rod, pin, ground) in [
        ("rod2", at(0.3, -0.4), at(0.6, 0.2)),
        ("rod1", at(-0.5, 0.0), at(0.7, 0.0)),
    ] {
        let ends = [pin, ground].map(xyz);
        let ends = [(rod, ends[0].as_str()), ("body_0", &ends[1])];
        connect(&mut text, "hinge", ends, (NORMAL, PARALLEL));
    }
    compare(&text, [1, 4], "windows");
}

/// An arm that keeps its hand level: a triangle at the elbow follows by a rod beside the arm, the hand by a rod beside
/// the forearm. The second loop has four joints, with the arm's own turn in none of its sides.
#[test]
fn two_parallelograms_keep_the_hand_of_an_arm_level() {
    let mut text = on("fixed");
    let elbow = at(0.6, 0.0);
    for (name, parent, origin) in [
        ("arm", "body_0", [0.0; 3]),
        ("triangle", "arm", elbow),
        ("forearm", "arm", elbow),
        ("hand", "forearm", at(0.5, 0.0)),
        ("rod", "body_0", at(-0.1, 0.2)),
        ("upper_rod", "triangle", at(0.05, 0.1)),
    ] {
        link(&mut text, (name, parent), &turning(NORMAL, origin));
    }
    let ends = [lifted(-0.1, 0.2, 0.0), lifted(0.6, 0.0, 0.0)].map(xyz);
    let first = [("triangle", ends[0].as_str()), ("rod", &ends[1])];
    connect(&mut text, "point", first, (NORMAL, PARALLEL));
    let ends = [at(0.1, -0.05), at(0.3, 0.4)].map(xyz);
    let second = [("hand", ends[0].as_str()), ("upper_rod", &ends[1])];
    connect(&mut text, "hinge", second, (NORMAL, PARALLEL));
    compare(&text, [2, 4], "arm");
}

/// A third rod adds a joint and a row; its other row follows by the first loop.
#[test]
fn a_third_rod_follows_with_one_row() {
    let mut text = four_bar("fixed", [0.12, 0.35]);
    link(
        &mut text,
        ("middle", "body_0"),
        &turning(NORMAL, at(0.2, 0.1)),
    );
    for (place, rod) in [(at(0.35, 0.0), "rocker"), (at(0.2, 0.1), "middle")] {
        let ends = [place, at(0.12, 0.0)].map(xyz);
        let ends = [("coupler", ends[0].as_str()), (rod, &ends[1])];
        connect(&mut text, "hinge", ends, (NORMAL, PARALLEL));
    }
    compare(&text, [1, 3], "third rod");
}

/// The same machine with pins, and with joints that follow by hand: as many operations, and the same values.
#[test]
fn rods_cost_what_followers_by_hand_cost() {
    let rods = spec("parallel_rods");
    let head = rods.split("\nloops:\n").next().expect("loops");
    let mut by_hand = head.to_owned();
    for (joint, ratio) in [
        ("coupler1_angle", -1),
        ("rod1_angle", 1),
        ("coupler2_angle", -1),
        ("rod2_angle", 1),
    ] {
        let own = format!("name: {joint}, type: continuous, axis: z");
        assert!(by_hand.contains(&own), "{joint}");
        let follows = format!("{own}, mimic: {{ joint: rod0_angle, ratio: {ratio} }}");
        by_hand = by_hand.replace(&own, &follows);
    }
    let [rods, by_hand] = [rods, by_hand].map(|text| Robot::read(&text));
    for method in Method::OF_TRAIT {
        let functions = [&rods, &by_hand].map(|robot| robot.function(None, method));
        let [found, expected] = functions.each_ref().map(|f| f.operations());
        assert_eq!(found, expected, "{method:?}");
        let state = rods.state(3);
        let [found, expected] = functions.map(|f| -> Vec<Dd> { state.value(&f) });
        assert_eq!(found, expected, "{method:?}");
    }
    let forward = rods.function(None, Method::ForwardDynamics).operations();
    assert_eq!([forward.mul, forward.add, forward.div], [2, 1, 0]);
}

/// On its parallel branch the machine is one pendulum: 3 α̈ = 3.5 g sin α, α from upright, at every angle.
#[test]
fn rods_accelerate_as_a_pendulum() {
    let function = Robot::read(&spec("parallel_rods")).function(None, Method::ForwardDynamics);
    for k in 0..360 {
        let alpha = f64::from(k).to_radians();
        let state = State {
            q: vec![std::f64::consts::FRAC_PI_2 - alpha],
            v: vec![1.0],
            a: vec![0.0],
            u: vec![0.0],
        };
        let found: f64 = state.value(&function)[0];
        let expected = -3.5 * 9.81 / 3.0 * alpha.sin();
        assert!(
            (found - expected).abs() < 1e-14,
            "{alpha}: {found} {expected}"
        );
    }
}

/// A loop of dependent joints beside a parallelogram, which goes through its followers.
#[test]
fn other_loops_go_through_joints_that_follow() {
    let mut text = four_bar("fixed", [0.12, 0.35]);
    let ends = [at(0.35, 0.0), at(0.12, 0.0)].map(xyz);
    let ends = [("coupler", ends[0].as_str()), ("rocker", &ends[1])];
    connect(&mut text, "hinge", ends, (NORMAL, PARALLEL));
    link(&mut text, ("rod", "rocker"), &turning(NORMAL, at(0.3, 0.1)));
    link(
        &mut text,
        ("lever", "body_0"),
        &turning(NORMAL, at(0.6, 0.1)),
    );
    let ends = [at(0.4, 0.0), at(0.3, 0.0)].map(xyz);
    let ends = [("rod", ends[0].as_str()), ("lever", &ends[1])];
    connect(&mut text, "hinge", ends, (NORMAL, "    branch: left\n"));
    let robot = Robot::read(&text.closed());
    let closure = robot.mechanism.closure().expect("loops");
    assert_eq!(
        [closure.loops.len(), closure.rows.len(), robot.nv()],
        [1, 2, 1]
    );
    let options = Options::default();
    let model = model(robot.mechanism, &options).expect("a model");
    assert_eq!(check_model(&model), []);
}

/// The generator compares every function with the literal sum, and refuses each one with a changed sign.
#[test]
fn functions_of_parallel_rods_are_verified() {
    let options = Options {
        derivatives: true,
        ..Options::default()
    };
    let model = model(Robot::read(&spec("parallel_rods")).mechanism, &options).expect("a model");
    assert_eq!(check_model(&model), []);
    assert_turned_signs_are_refused("parallel_rods", &model);
}

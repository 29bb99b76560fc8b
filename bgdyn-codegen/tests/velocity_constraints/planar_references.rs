//! Mechanisms on a plane against reference solutions (`tests/golden/velocity_constraints`) at every sample.

use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

use super::files::{Samples, spec};
use super::robot::{Robot, State, Way};

/// The formulations of the open tree.
pub const WAYS: [Way; 3] = [None, Some("subspaces"), Some("literal")];

pub fn assert_near(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let size = expected.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
    for (x, y) in found.iter().zip(expected) {
        let off = (x - y).abs();
        assert!(off <= tolerance * size, "{what}: {found:?}, {expected:?}");
    }
}

/// The reference's board is on two slides; here velocities are along the axes of the board.
#[test]
fn the_snakeboard_moves_as_with_multipliers() {
    let robot = Robot::read(&spec("snakeboard"));
    let names = robot.mechanism.joint_names();
    assert_eq!(names, ["base_x", "rotor_angle", "front_angle"]);
    let samples = Samples::read("snakeboard");
    for sample in samples.iter() {
        let at = |column: &str| sample.at(column);
        let (sin, cos) = at("board").sin_cos();
        let turned = |x: f64, y: f64| [cos * x + sin * y, cos * y - sin * x];
        let [x_rate, y_rate] = turned(at("x_rate"), at("y_rate"));
        let [x, y] = turned(at("x_acceleration"), at("y_acceleration"));
        let turning = at("board_rate");
        let in_board = [x + turning * y_rate, y - turning * x_rate];
        let state = State {
            q: ["x", "y", "board", "rotor", "front_axle"].map(at).to_vec(),
            v: vec![x_rate, at("rotor_rate"), at("front_axle_rate")],
            a: vec![
                in_board[0],
                at("rotor_acceleration"),
                at("front_axle_acceleration"),
            ],
            u: vec![
                0.0,
                0.4 * (2.0 * at("t")).sin(),
                0.05 * (2.0 * at("t") + 1.0).sin() - 0.3 * (at("front_axle") - 0.2),
            ],
        };
        let what = format!("at {} s", at("t"));
        let value = |way, method| -> Vec<f64> { state.value(&robot.function(way, method)) };
        for way in WAYS {
            let tree = [x_rate, y_rate, turning, state.v[1], state.v[2]];
            assert_near(&value(way, Method::TreeVelocity), &tree, 1e-13, &what);
            let tree = [
                in_board[0],
                in_board[1],
                at("board_acceleration"),
                state.a[1],
                state.a[2],
            ];
            assert_near(&value(way, Method::TreeAcceleration), &tree, 1e-12, &what);
            let found = value(way, Method::ForwardDynamics);
            assert_near(&found, &state.a, 1e-12, &what);
            let found = value(way, Method::InverseDynamics);
            assert_near(&found, &state.u, 1e-12, &what);
            let found = value(way, Method::Multipliers);
            let expected = [at("lambda_front"), at("lambda_rear")];
            assert_near(&found, &expected, 1e-12, &what);
            let energy = value(way, Method::KineticEnergy);
            assert_near(&energy, &[at("energy")], 1e-12, &what);
        }
    }
}

/// v̇ = a ω², ω̇ = −m a v ω / (I + m a²), with the force of the blade m (v ω + a ω̇).
#[test]
fn the_sleigh_accelerates_as_in_closed_form() {
    let robot = Robot::read(&spec("chaplygin_sleigh"));
    let (m, inertia, a) = (1.0, 0.5, 0.3);
    for sample in Samples::read("chaplygin_sleigh").iter() {
        let (v, w) = (sample.at("v"), sample.at("omega"));
        let state = State {
            q: ["x", "y", "theta"].map(|c| sample.at(c)).to_vec(),
            v: vec![v, w],
            a: vec![a * w * w, -m * a * v * w / (inertia + m * a * a)],
            u: vec![0.0; 2],
        };
        for way in WAYS {
            let value = |method| -> Vec<f64> { state.value(&robot.function(way, method)) };
            let what = format!("{way:?} at {} s", sample.at("t"));
            assert_near(&value(Method::ForwardDynamics), &state.a, 1e-15, &what);
            assert_near(&value(Method::InverseDynamics), &state.u, 1e-15, &what);
            let force = m * (v * w + a * state.a[1]);
            assert_near(&value(Method::Multipliers), &[force], 1e-15, &what);
        }
    }
}

/// The robot of the reference, with massless wheels: their inertia about the vertical is in that of the cart.
pub const ROBOT: &str = "format: 1
name: robot
links:
  - name: cart
    joint: { name: base, type: planar, origin: { xyz: [0, 0, 0.1] } }
    mass: 10
    inertia: { xx: 0.3, yy: 0.3, zz: 0.395 }
  - name: right_wheel
    parent: cart
    joint: { name: right, type: continuous, axis: y, origin: { xyz: [0, -0.25, 0] } }
    inertia: { xx: 0.0025, yy: 0.005, zz: 0.0025 }
    nonphysical: allow
  - name: left_wheel
    parent: cart
    joint: { name: left, type: continuous, axis: y, origin: { xyz: [0, 0.25, 0] } }
    inertia: { xx: 0.0025, yy: 0.005, zz: 0.0025 }
    nonphysical: allow
constraints:
  right_contact: { type: rolling, link: right_wheel, axis: y, radius: 0.1 }
  left_contact: { type: rolling, link: left_wheel, axis: y, radius: 0.1, rows: [longitudinal] }
independent: [right, left]
";

/// v̇ = (P_r + P_l) / (r (m + 2 J / r²)), ω̇ = b (P_r − P_l) / (r (I + 2 J b² / r²)), with P = τ − d · wheel speed.
#[test]
fn the_robot_accelerates_as_in_closed_form() {
    let robot = Robot::read(ROBOT);
    let (m, inertia, b, r, j, d) = (10.0, 0.4, 0.25, 0.1, 0.005, 0.02);
    for sample in Samples::read("differential_drive").iter() {
        let wheels = ["wR", "wL"].map(|c| sample.at(c));
        let efforts = [0.3 - d * wheels[0], 0.2 - d * wheels[1]];
        let ahead = (efforts[0] + efforts[1]) / (r * (m + 2.0 * j / (r * r)));
        let turning = b * (efforts[0] - efforts[1]) / (r * (inertia + 2.0 * j * b * b / (r * r)));
        let state = State {
            q: ["x", "y", "theta"]
                .map(|c| sample.at(c))
                .into_iter()
                .chain([0.3, 2.0])
                .collect(),
            v: wheels.to_vec(),
            a: [1.0, -1.0]
                .map(|side| (ahead + side * b * turning) / r)
                .to_vec(),
            u: efforts.to_vec(),
        };
        for way in WAYS {
            let value = |method| -> Vec<f64> { state.value(&robot.function(way, method)) };
            let what = format!("{way:?} at {} s", sample.at("t"));
            let tree = [
                sample.at("v"),
                0.0,
                sample.at("omega"),
                wheels[0],
                wheels[1],
            ];
            assert_near(&value(Method::TreeVelocity), &tree, 1e-14, &what);
            assert_near(&value(Method::ForwardDynamics), &state.a, 1e-14, &what);
            assert_near(&value(Method::InverseDynamics), &state.u, 1e-14, &what);
        }
    }
}

/// Whatever velocities are independent, the motion is the same.
#[test]
fn other_independent_velocities_give_the_same_motion() {
    let wheels = Robot::read(ROBOT);
    let cart = Robot::read(&ROBOT.replace("[right, left]", "[base_x, base_turn]"));
    assert_eq!(cart.mechanism.joint_names(), ["base_x", "base_turn"]);
    let of = |x: &[f64]| x.iter().map(|&x| Dd::from_f64(x)).collect::<Vec<Dd>>();
    let state = |v: &[Dd], a: &[Dd]| State {
        q: of(&[0.1, -0.4, 0.7, 2.0, -1.0]),
        v: v.to_vec(),
        a: a.to_vec(),
        u: vec![],
    };
    let by_wheels = state(&of(&[3.0, -1.5]), &of(&[0.5, 2.0]));
    let value = |state: &State<Dd>, robot: &Robot, method| -> Vec<Dd> {
        state.value(&robot.function(None, method))
    };
    let tree = |method| value(&by_wheels, &wheels, method);
    let (v, a) = (tree(Method::TreeVelocity), tree(Method::TreeAcceleration));
    let by_cart = state(&[v[0], v[2]], &[a[0], a[2]]);
    let near = |x: &[Dd], y: &[Dd]| {
        let off = x.iter().zip(y).map(|(&x, &y)| (x - y).to_f64().abs());
        assert!(off.fold(0.0, f64::max) < 1e-28, "{x:?} {y:?}");
    };
    near(&value(&by_cart, &cart, Method::TreeVelocity), &v);
    near(&value(&by_cart, &cart, Method::TreeAcceleration), &a);
    let energy = value(&by_cart, &cart, Method::KineticEnergy);
    near(&energy, &tree(Method::KineticEnergy));
}

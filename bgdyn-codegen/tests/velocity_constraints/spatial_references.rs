//! A rolling disc and a bicycle against reference solutions (`tests/golden/velocity_constraints`).

use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;
use serde_json::Value;

use super::files::{Sample, Samples, file, spec};
use super::planar_references::assert_near;
use super::robot::{Robot, State, Way};

const WAYS: [Way; 3] = [None, Some("recursion"), Some("subspaces")];

type Vector = [f64; 3];

fn cross(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn unit(a: Vector) -> Vector {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}

/// Directions of the rows of a wheel with this axle: longitudinal, lateral, height.
fn directions(axle: Vector) -> [Vector; 3] {
    let up = [0.0, 0.0, 1.0];
    let ahead = unit(cross(axle, up));
    [ahead, cross(up, ahead), up]
}

/// Returns the quaternion x, y, z, w of the smallest rotation that turns y to this direction.
fn from_y(axle: Vector) -> [f64; 4] {
    let [x, y, z] = cross([0.0, 1.0, 0.0], axle);
    let w = 1.0 + axle[1];
    let length = (x * x + y * y + z * z + w * w).sqrt();
    [x, y, z, w].map(|part| part / length)
}

/// Returns a vector turned by a quaternion.
fn turned([x, y, z, w]: [f64; 4], v: Vector) -> Vector {
    let u = [x, y, z];
    let (once, twice) = (cross(u, v), cross(u, cross(u, v)));
    std::array::from_fn(|i| v[i] + 2.0 * (w * once[i] + twice[i]))
}

/// The steady circle: everything turns about the vertical at 2 rad/s.
#[test]
fn the_disc_rolls_on_its_circle() {
    let robot = Robot::read(&spec("rolling_disc"));
    let turning = [0.0, 0.0, 2.0];
    for sample in Samples::read("rolling_disk_steady").iter() {
        let read = |columns: [&str; 3]| columns.map(|c| sample.at(c));
        let (centre, omega) = (read(["cx", "cy", "cz"]), read(["wx", "wy", "wz"]));
        let axle = unit(read(["ax", "ay", "az"]));
        // Any attitude with this axle.
        let attitude = from_y(axle);
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|e| turned(attitude, e));
        let in_disc = |v: Vector| axes.map(|axis| dot(axis, v)).to_vec();
        let state = State {
            q: centre.into_iter().chain(attitude).collect(),
            v: in_disc(omega),
            a: in_disc(cross(turning, omega)),
            u: vec![0.0; 3],
        };
        // ċ = r ω × e; the force is m (c̈ − g).
        let [ahead, aside, up] = directions(axle);
        let upward = cross(ahead, axle);
        let rate = cross(omega, upward).map(|x| 0.5 * x);
        let mut force = cross(turning, rate);
        force[2] += 9.81;
        let forces = [ahead, aside, up].map(|d| dot(d, force));
        let what = format!("at {} s", sample.at("t"));
        for way in WAYS {
            let value = |method| -> Vec<f64> { state.value(&robot.function(way, method)) };
            let tree = value(Method::TreeVelocity);
            assert_near(&tree[..3], &in_disc(rate), 1e-13, &what);
            assert_near(&value(Method::ForwardDynamics), &state.a, 1e-12, &what);
            assert_near(&value(Method::InverseDynamics), &state.u, 1e-12, &what);
            assert_near(&value(Method::Multipliers), &forces, 1e-12, &what);
            let height = value(Method::ConstraintResidual);
            assert_near(&height, &[0.0; 3], 1e-14, &what);
            let energy = value(Method::KineticEnergy)[0] + value(Method::PotentialEnergy)[0];
            assert_near(&[energy], &[sample.at("E")], 1e-13, &what);
        }
    }
}

/// The positions, velocities and accelerations of the reference's slides and rotations, along the heading here.
fn bicycle_state(sample: &Sample<'_>) -> ([State<f64>; 2], Vec<f64>) {
    let at = |column: &str| sample.at(column);
    let joints = [
        "x",
        "y",
        "yaw",
        "z",
        "lean",
        "rear_frame",
        "rear_wheel",
        "fork",
        "front_wheel",
    ];
    let read = |ending: &str| -> Vec<f64> {
        joints
            .iter()
            .map(|name| at(&format!("{name}{ending}")))
            .collect()
    };
    let (sin, cos) = at("yaw").sin_cos();
    let along = |all: &mut Vec<f64>| {
        let (x, y) = (all[0], all[1]);
        (all[0], all[1]) = (cos * x + sin * y, cos * y - sin * x);
    };
    let (mut v, mut a) = (read("_rate"), read("_acceleration"));
    along(&mut v);
    along(&mut a);
    (a[0], a[1]) = (a[0] + v[2] * v[1], a[1] - v[2] * v[0]);
    let independent = |all: &[f64]| vec![all[4], all[6], all[7]];
    let state = State {
        q: read(""),
        v: independent(&v),
        a: independent(&a),
        u: vec![0.0; 3],
    };
    let whole = State {
        q: vec![],
        v,
        a,
        u: vec![],
    };
    ([state, whole], forces(sample))
}

/// The forces on both wheels along the directions of their rows.
fn forces(sample: &Sample<'_>) -> Vec<f64> {
    let about = |axis: usize, name: &str, v: Vector| {
        let (sin, cos) = sample.at(name).sin_cos();
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut w = v;
        (w[i], w[j]) = (cos * v[i] - sin * v[j], sin * v[i] + cos * v[j]);
        w
    };
    let in_world = |v: Vector| about(2, "yaw", about(0, "lean", about(1, "rear_frame", v)));
    let y = [0.0, 1.0, 0.0];
    let (sin, cos) = sample.at("fork").sin_cos();
    let tilt = std::f64::consts::PI / 10.0;
    let steering = [tilt.sin(), 0.0, -tilt.cos()];
    let side = cross(steering, y);
    let front: Vector = std::array::from_fn(|i| cos * y[i] + sin * side[i]);
    let of = |wheel: &str, axle: Vector| {
        let force = ["x", "y", "z"].map(|k| sample.at(&format!("lambda_{wheel}_{k}")));
        directions(in_world(axle)).map(|d| dot(d, force))
    };
    [of("rear", y), of("front", front)].concat()
}

#[test]
fn the_bicycle_moves_as_with_multipliers() {
    let robot = Robot::read(&spec("whipple_bicycle"));
    let names = robot.mechanism.joint_names();
    assert_eq!(names, ["lean", "rear_spin", "steer"]);
    let samples = Samples::read("whipple_bicycle");
    for sample in samples.iter() {
        let ([state, whole], forces) = bicycle_state(&sample);
        let what = format!("at {} s", sample.at("t"));
        for way in WAYS {
            let value = |method| -> Vec<f64> { state.value(&robot.function(way, method)) };
            assert_near(&value(Method::TreeVelocity), &whole.v, 1e-13, &what);
            assert_near(&value(Method::ForwardDynamics), &state.a, 1e-12, &what);
            assert_near(&value(Method::TreeAcceleration), &whole.a, 1e-12, &what);
            assert_near(&value(Method::Multipliers), &forces, 1e-12, &what);
            let height = value(Method::ConstraintResidual);
            assert_near(&height, &[0.0; 6], 1e-14, &what);
        }
    }
}

pub(super) type Square = [[Dd; 2]; 2];

fn matrix(value: &Value) -> Square {
    let at = |i: usize, j: usize| Dd::from_f64(value[i][j].as_f64().expect("a number"));
    std::array::from_fn(|i| std::array::from_fn(|j| at(i, j)))
}

/// M⁻¹ A
fn divided(m: Square, a: Square) -> Square {
    let [[p, q], [r, s]] = m;
    let one = Dd::ONE / (p * s - q * r);
    let inverse = [[s * one, -q * one], [-r * one, p * one]];
    std::array::from_fn(|i| {
        std::array::from_fn(|j| inverse[i][0] * a[0][j] + inverse[i][1] * a[1][j])
    })
}

/// Derivatives of the accelerations of lean and steer about upright at a speed: by positions, by velocities.
fn linearised(robot: &Robot, speed: f64) -> [Square; 2] {
    let closure = robot.mechanism.closure().expect("wheels");
    let (h, forward) = (
        Dd::from_f64(1e-9),
        robot.function(None, Method::ForwardDynamics),
    );
    let spin = Dd::from_f64(speed) / "0.3".parse().expect("a number");
    let accelerations = |lean: Dd, steer: Dd, rates: [Dd; 2]| {
        let mut q = closure.start.clone();
        (q[4], q[7]) = (lean, steer);
        assert!(closure.close(&mut q));
        let state = State {
            q,
            v: vec![rates[0], spin, rates[1]],
            a: vec![],
            u: vec![Dd::ZERO; 3],
        };
        let a: Vec<Dd> = state.value(&forward);
        [a[0], a[2]]
    };
    let still = [Dd::ZERO; 2];
    let slope = |of: &dyn Fn(Dd) -> [Dd; 2]| {
        let [ahead, behind] = [h, -h].map(of);
        [0, 1].map(|i| (ahead[i] - behind[i]) / (h + h))
    };
    let zero = Dd::ZERO;
    let by_position = [
        slope(&|h| accelerations(h, zero, still)),
        slope(&|h| accelerations(zero, h, still)),
    ];
    let by_velocity = [
        slope(&|h| accelerations(zero, zero, [h, zero])),
        slope(&|h| accelerations(zero, zero, [zero, h])),
    ];
    let transposed =
        |columns: [[Dd; 2]; 2]| std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i]));
    [transposed(by_position), transposed(by_velocity)]
}

/// The characteristic polynomial det(λ² + λ D + K) and its derivative at a complex λ.
fn polynomial([k, d]: [Square; 2], [re, im]: [f64; 2]) -> [[f64; 2]; 2] {
    let [k, d] = [k, d].map(|m| m.map(|row| row.map(Dd::to_f64)));
    let coefficients = [
        k[0][0] * k[1][1] - k[0][1] * k[1][0],
        k[0][0] * d[1][1] + d[0][0] * k[1][1] - k[0][1] * d[1][0] - d[0][1] * k[1][0],
        k[0][0] + k[1][1] + d[0][0] * d[1][1] - d[0][1] * d[1][0],
        d[0][0] + d[1][1],
        1.0,
    ];
    let times = |a: [f64; 2]| [a[0] * re - a[1] * im, a[0] * im + a[1] * re];
    let (mut value, mut slope) = ([0.0; 2], [0.0; 2]);
    for c in coefficients.into_iter().rev() {
        slope = times(slope);
        slope = [slope[0] + value[0], slope[1] + value[1]];
        value = times(value);
        value[0] += c;
    }
    [value, slope]
}

/// The benchmark: the linearised equations at 5 m/s to 1e-12, the eigenvalues at all speeds of the paper to 1e-11.
#[test]
fn the_bicycle_has_the_eigenvalues_of_the_benchmark() {
    let robot = Robot::read(&spec("whipple_bicycle"));
    assert_equations_of_the_benchmark(|speed| linearised(&robot, speed));
}

/// Compares derivatives of the accelerations of lean and steer at a speed, by positions and by velocities.
pub(super) fn assert_equations_of_the_benchmark(linearised: impl Fn(f64) -> [Square; 2]) {
    let json = file("tests/golden/velocity_constraints", "whipple_bicycle.json");
    let json: Value = serde_json::from_str(&json).expect("JSON");
    let linear = &json["linearised"];
    let [m, c1, k0, k2] = ["M", "C1", "K0", "K2"].map(|name| matrix(&linear[name]));
    let found = linearised(5.0);
    let (g, square): (Dd, Dd) = ("9.81".parse().expect("a number"), Dd::from_f64(25.0));
    let stiffness: Square =
        std::array::from_fn(|i| std::array::from_fn(|j| -(g * k0[i][j] + square * k2[i][j])));
    let damping = c1.map(|row| row.map(|x| -(x * Dd::from_f64(5.0))));
    for (found, expected) in found.into_iter().zip([stiffness, damping]) {
        let expected = divided(m, expected);
        for (x, y) in found.iter().flatten().zip(expected.iter().flatten()) {
            let off = (*x - *y).to_f64().abs();
            assert!(off <= 1e-12 * y.to_f64().abs().max(1.0), "{x:?} {y:?}");
        }
    }
    let all = linear["eigenvalues"].as_array().expect("a list");
    assert_eq!(all.len(), 13);
    for at in all {
        let number = |x: &Value| x.as_f64().expect("a number");
        let [k, d] = linearised(number(&at["speed"]));
        let opposite = |m: Square| m.map(|row| row.map(|x| -x));
        for value in at["eigenvalues"].as_array().expect("a list") {
            let value = [number(&value[0]), number(&value[1])];
            let [p, slope] = polynomial([k, d].map(opposite), value);
            let off = p[0].hypot(p[1]) / slope[0].hypot(slope[1]);
            assert!(off < 1e-11, "{value:?} at {}: {off:e}", at["speed"]);
        }
    }
}

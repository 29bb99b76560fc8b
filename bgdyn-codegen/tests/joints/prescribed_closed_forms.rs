//! Prescribed joints against equations in closed form: a pendulum on a turning table, and one whose pivot is moved.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::random::Random;
use bgdyn_runtime::Dd;

use super::prescribed::{WAYS, value};
use super::robot::{Robot, close, dot};

fn number(text: &str) -> Dd {
    text.parse().expect("a number")
}

/// A point mass m at l below a hinge at the radius R of a turning table with the inertia J, in the plane of the
/// radius: with ρ = R − l sin θ,
/// τ = m l² θ̈ + m ρ l cos θ φ̇² + m g l sin θ, drive: (J + m ρ²) φ̈ − 2 m ρ l cos θ θ̇ φ̇.
#[test]
fn a_pendulum_on_a_turning_table() {
    let robot = Robot::read(
        "format: 1\nname: carousel\ngravity: [0, 0, -9.81]\nlinks:\n  - name: table\n    joint: { name: turn, type: continuous }\n    inertia: { xx: 0.4, yy: 0.4, zz: 0.7 }\n  - name: bob\n    parent: table\n    joint: { name: swing, type: revolute, axis: y, origin: { xyz: [0.8, 0, 0.3] } }\n    mass: 1.3\n    com: [0, 0, -0.5]\nconstraints:\n  motor: { type: prescribed, joint: turn }\n",
    );
    let [m, l, r, g, j] = ["1.3", "0.5", "0.8", "9.81", "0.7"].map(number);
    let mut random = Random(1);
    for _ in 0..20 {
        let mut some = || Dd::from_f64(3.0 * random.signed());
        let (angle, v, a) = (some(), some(), some());
        let course = [some(), some(), some()];
        let at = Inputs {
            q: vec![angle],
            v: vec![v],
            a: vec![a],
            parameters: course.to_vec(),
            ..Inputs::default()
        };
        let (sin, cos) = angle.sin_cos();
        let radius = r - l * sin;
        let [_, rate, acceleration] = course;
        let effort = m * l * l * a + m * radius * l * cos * rate * rate + m * g * l * sin;
        let drive = (j + m * radius * radius) * acceleration
            - Dd::from_f64(2.0) * m * radius * l * cos * v * rate;
        for way in WAYS {
            let found = value(&robot, way, Method::InverseDynamics, &at);
            close(&found, &[effort], 1e-28, 1.0, "effort of the hinge");
            let found = value(&robot, way, Method::DriveEfforts(1), &at);
            close(&found, &[drive], 1e-28, 1.0, "effort of the motor");
        }
    }
}

/// A pendulum whose pivot, with the mass M, is moved along x: with the place s − l sin θ of the bob,
/// τ = m l² θ̈ − m l cos θ s̈ + m g l sin θ, drive: (M + m) s̈ − m l (cos θ θ̈ − sin θ θ̇²).
#[test]
fn a_pendulum_with_a_moved_pivot() {
    let robot = Robot::read(
        "format: 1\nname: rheonomic\ngravity: [0, 0, -9.81]\nlinks:\n  - name: pivot\n    joint: { name: shake, type: prismatic, axis: x }\n    mass: 2\n  - name: bob\n    parent: pivot\n    joint: { name: swing, type: revolute, axis: y }\n    mass: 1.3\n    com: [0, 0, -0.5]\nconstraints:\n  exciter: { type: prescribed, joint: shake }\n",
    );
    let [m, l, g, pivot] = ["1.3", "0.5", "9.81", "2"].map(number);
    let mut random = Random(2);
    for _ in 0..20 {
        let mut some = || Dd::from_f64(3.0 * random.signed());
        let (angle, v, a) = (some(), some(), some());
        let course = [some(), some(), some()];
        let at = Inputs {
            q: vec![angle],
            v: vec![v],
            a: vec![a],
            parameters: course.to_vec(),
            ..Inputs::default()
        };
        let (sin, cos) = angle.sin_cos();
        let effort = m * l * l * a - m * l * cos * course[2] + m * g * l * sin;
        let drive = (pivot + m) * course[2] - m * l * (cos * a - sin * v * v);
        let energy = {
            let place = [course[1] - l * cos * v, l * sin * v];
            (dot(&place, &place) * m + pivot * course[1] * course[1]) * 0.5_f64.into()
        };
        for way in WAYS {
            let found = value(&robot, way, Method::InverseDynamics, &at);
            close(&found, &[effort], 1e-28, 1.0, "effort of the hinge");
            let found = value(&robot, way, Method::DriveEfforts(1), &at);
            close(&found, &[drive], 1e-28, 1.0, "force of the exciter");
            let found = value(&robot, way, Method::KineticEnergy, &at);
            close(&found, &[energy], 1e-28, 1.0, "kinetic energy");
        }
    }
}

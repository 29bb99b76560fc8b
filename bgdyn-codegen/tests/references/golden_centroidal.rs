//! Compares centroidal methods and the rate of the mass matrix with Pinocchio's values (`golden/centroidal`).

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::{Centroidal, Method};

use crate::common::{Robot, golden};
use crate::golden_values::{close, numbers, robot_of_joints, values};

/// Relative to the largest entry.
const TOLERANCE: f64 = 1e-12;

/// Returns the lower triangle of a square matrix.
fn triangle(whole: &[f64], n: usize) -> Vec<f64> {
    let entries = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
    entries.map(|(i, j)| whole[i * n + j]).collect()
}

fn check(name: &str, robot: &Robot) {
    let reference = values("centroidal", name);
    let states = reference["states"].as_array().expect("states");
    assert_eq!(states.len(), 3);
    for state in states {
        let at = Inputs {
            q: numbers(&state["q"]),
            v: numbers(&state["v"]),
            ..Inputs::default()
        };
        for of in Centroidal::ALL {
            let function = robot.emitted(Method::Centroidal(of));
            let found = function.evaluate(at.clone()).0;
            let what = format!("{name}: {}", of.name());
            close(&found, &numbers(&state[of.name()]), TOLERANCE, &what);
        }
        let rate = robot.emitted(Method::MassMatrixRate).evaluate(at.clone()).0;
        let expected = triangle(&numbers(&state["mass_matrix_rate"]), at.v.len());
        close(
            &rate,
            &expected,
            TOLERANCE,
            &format!("{name}: mass_matrix_rate"),
        );
    }
}

#[test]
fn momenta_of_arms_are_those_of_pinocchio() {
    for name in ["scara4", "puma560", "panda7"] {
        check(name, &golden::robot(name));
    }
}

#[test]
fn momenta_of_free_bodies_are_those_of_pinocchio() {
    for name in ["satellite_arm6", "spherical_chain3"] {
        check(name, &robot_of_joints(name));
    }
}

//! Compares centroidal methods and the rate of the mass matrix with Pinocchio's values (`golden/centroidal`).

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::{Centroidal, Method};
use serde_json::Value;

use crate::common::{Robot, golden};

/// Relative to the largest entry.
const TOLERANCE: f64 = 1e-12;

fn folder(name: &str) -> String {
    format!("{}/../tests/golden/{name}", env!("CARGO_MANIFEST_DIR"))
}

/// Returns the numbers of a vector or of a matrix, row by row.
fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(all) => all.iter().flat_map(numbers).collect(),
        other => vec![other.as_f64().expect("a number")],
    }
}

fn close(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let size = expected.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
    for (k, (x, y)) in found.iter().zip(expected).enumerate() {
        let off = (x - y).abs();
        assert!(
            off <= TOLERANCE * size,
            "{what}: entry {k}: {x} against {y}"
        );
    }
}

/// Returns the lower triangle of a square matrix.
fn triangle(whole: &[f64], n: usize) -> Vec<f64> {
    let entries = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
    entries.map(|(i, j)| whole[i * n + j]).collect()
}

fn check(name: &str, robot: &Robot) {
    let text = std::fs::read_to_string(folder(&format!("centroidal/{name}.json")));
    let reference: Value = serde_json::from_str(&text.expect("golden values")).expect("JSON");
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
            close(&found, &numbers(&state[of.name()]), &what);
        }
        let rate = robot.emitted(Method::MassMatrixRate).evaluate(at.clone()).0;
        let expected = triangle(&numbers(&state["mass_matrix_rate"]), at.v.len());
        close(&rate, &expected, &format!("{name}: mass_matrix_rate"));
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
        let text = std::fs::read_to_string(folder(&format!("joints/{name}.yaml")));
        check(name, &Robot::read(&text.expect("a spec"), Some(name)));
    }
}

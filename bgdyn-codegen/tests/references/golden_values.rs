//! Reads golden values, and compares with them.

use serde_json::Value;

use crate::common::Robot;

/// Returns the values of a file in a folder of `tests/golden`.
pub fn values(folder: &str, name: &str) -> Value {
    let text = text(&format!("{folder}/{name}.json"));
    serde_json::from_str(&text).expect("golden values are JSON")
}

/// Returns a robot of `tests/golden/joints`.
pub fn robot_of_joints(name: &str) -> Robot {
    Robot::read(&text(&format!("joints/{name}.yaml")), Some(name))
}

fn text(path: &str) -> String {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/golden");
    std::fs::read_to_string(format!("{folder}/{path}")).expect("a golden file")
}

/// Returns the numbers of a vector or of a matrix, row by row.
pub fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(all) => all.iter().flat_map(numbers).collect(),
        other => vec![other.as_f64().expect("a number")],
    }
}

/// Fails if an entry differs by more than the tolerance times the largest one, or times 1.
pub fn close(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let size = expected.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
    for (k, (x, y)) in found.iter().zip(expected).enumerate() {
        let off = (x - y).abs();
        assert!(
            off <= tolerance * size,
            "{what}: entry {k}: {x} against {y}"
        );
    }
}

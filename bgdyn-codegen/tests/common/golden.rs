//! The golden robots: specs and their reference values in random states.

use std::fs;
use std::path::PathBuf;

use serde_json::Value;

use super::Robot;

fn folder(name: &str) -> PathBuf {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..");
    root.join("tests/golden").join(name)
}

/// Names of all golden specs.
pub fn names() -> Vec<String> {
    let entries = fs::read_dir(folder("specs")).expect("the folder of golden specs");
    let name = |path: PathBuf| Some(path.file_stem()?.to_str()?.to_owned());
    let mut names: Vec<String> = entries
        .filter_map(|entry| name(entry.ok()?.path()))
        .collect();
    names.sort();
    assert!(names.len() >= 15, "golden specs are missing: {names:?}");
    names
}

/// A golden robot.
pub fn robot(name: &str) -> Robot {
    let path = folder("specs").join(format!("{name}.yaml"));
    let text = fs::read_to_string(path).expect("a golden spec");
    Robot::read(&text, Some(name))
}

/// The golden robots with at most `n` moving joints.
pub fn robots_up_to(n: usize) -> Vec<(String, Robot)> {
    let all = names().into_iter().map(|name| {
        let robot = robot(&name);
        (name, robot)
    });
    all.filter(|(_, robot)| robot.nv() <= n).collect()
}

/// Returns the reference values of a golden robot.
pub fn values(name: &str) -> Value {
    let path = folder("values").join(format!("{name}.json"));
    let text = fs::read_to_string(path).expect("golden values");
    serde_json::from_str(&text).expect("golden values are JSON")
}

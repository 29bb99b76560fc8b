//! The hard cases of `tests/hard_cases`: mechanisms in one state with reference solutions.

use std::fs;
use std::path::PathBuf;

use serde_json::Value;

use super::Robot;

#[path = "../../../tests/hard_cases/written.rs"]
mod written;

#[allow(unused_imports)] // each test file uses a part
pub use written::{Chain, links_of, list, sliders_of};

/// The cases of a file.
pub fn cases(name: &str) -> Vec<Value> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..");
    let path = root.join("tests/hard_cases").join(format!("{name}.json"));
    written::cases(&fs::read_to_string(path).expect("a file of hard cases"))
}

/// A chain as a robot.
pub fn robot(chain: &Chain) -> Robot {
    Robot::read(&chain.text(), None)
}

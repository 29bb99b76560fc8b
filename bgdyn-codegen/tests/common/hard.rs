//! The hard cases of `tests/hard_cases`: mechanisms in one state with reference solutions.

use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

use serde_json::Value;

use super::Robot;

/// The cases of a file.
pub fn cases(name: &str) -> Vec<Value> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..");
    let path = root.join("tests/hard_cases").join(format!("{name}.json"));
    let text = fs::read_to_string(path).expect("a file of hard cases");
    let file: Value = serde_json::from_str(&text).expect("hard cases are JSON");
    file["cases"].as_array().expect("a list of cases").clone()
}

/// A list of numbers, each the `f64` that was meant.
pub fn list(value: &Value) -> Vec<f64> {
    let numbers = value.as_array().expect("a list");
    numbers
        .iter()
        .map(|x| x.as_f64().expect("a number"))
        .collect()
}

/// A chain of links of unit length along x.
pub struct Chain {
    pub links: usize,
    /// All axes along y; else z and y in turns.
    pub planar: bool,
    /// Moments of inertia about the centre of mass of a link of mass 1, kg·m².
    pub moments: [f64; 3],
    /// Mass and inertia of the last link in units of the others'.
    pub last: f64,
}

impl Chain {
    pub fn robot(&self) -> Robot {
        // All digits of the numbers that are meant.
        let digits = |x: f64| format!("{x:.120}");
        let g = digits(-9.81);
        let mut text = format!("format: 1\nname: chain\ngravity: [0, 0, {g}]\nlinks:\n");
        for i in 0..self.links {
            let scale = if i + 1 == self.links { self.last } else { 1.0 };
            let axis = if self.planar || i % 2 == 1 { 'y' } else { 'z' };
            let from = usize::from(i > 0);
            writeln!(text, "  - name: link_{i}").unwrap();
            if i > 0 {
                writeln!(text, "    parent: link_{}", i - 1).unwrap();
            }
            writeln!(
                text,
                "    joint: {{ name: joint_{i}, type: revolute, axis: {axis}, origin: {{ xyz: [{from}, 0, 0] }} }}"
            )
            .unwrap();
            let [xx, yy, zz] = self.moments.map(|x| digits(x * scale));
            let mass = digits(scale);
            writeln!(text, "    mass: {mass}\n    com: [0.5, 0, 0]").unwrap();
            writeln!(text, "    inertia: {{ xx: {xx}, yy: {yy}, zz: {zz} }}").unwrap();
        }
        Robot::read(&text, None)
    }
}

//! Specs and reference files.

use std::fs;
use std::path::PathBuf;

use serde_json::Value;

pub fn file(folder: &str, name: &str) -> String {
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "..", folder, name]
        .iter()
        .collect();
    fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Returns a spec of `specs/constraints` with its name.
pub fn spec(name: &str) -> String {
    let text = file("specs/constraints", &format!("{name}.yaml"));
    text.replacen("format: 1", &format!("format: 1\nname: {name}"), 1)
}

/// The samples of a reference solution.
pub struct Samples {
    columns: Vec<String>,
    rows: Vec<Vec<f64>>,
}

/// One sample.
pub struct Sample<'a>(&'a Samples, usize);

impl Samples {
    pub fn read(name: &str) -> Self {
        let json = file("tests/golden/velocity_constraints", &format!("{name}.json"));
        let file: Value = serde_json::from_str(&json).expect("JSON");
        let list = |value: &Value| value.as_array().expect("a list").clone();
        let number = |x: &Value| x.as_f64().expect("a number");
        let text = |x: &Value| x.as_str().expect("a name").to_owned();
        Samples {
            columns: list(&file["columns"]).iter().map(text).collect(),
            rows: (list(&file["samples"]).iter())
                .map(|row| list(row).iter().map(number).collect())
                .collect(),
        }
    }

    pub fn iter(&self) -> impl Iterator<Item = Sample<'_>> {
        (0..self.rows.len()).map(|k| Sample(self, k))
    }
}

impl Sample<'_> {
    pub fn at(&self, column: &str) -> f64 {
        let k = self.0.columns.iter().position(|c| c == column);
        self.0.rows[self.1][k.unwrap_or_else(|| panic!("no column {column}"))]
    }
}

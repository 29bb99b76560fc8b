//! Tests the command `bgdyn` as a process: its output and its exit codes.

mod accuracy;
mod book;
mod check;
mod committed;
mod engines;
mod equations;
mod eval;
mod eval_scenes;
mod excite;
mod excite_faults;
mod free_scenes;
mod fuzz_invariants;
mod generate;
mod golden_specs;
mod graph;
mod identify;
mod identify_logs;
mod identify_writes;
mod import;
mod joints;
mod loops;
mod loops_scenes;
mod messages;
mod ops;
mod pictures;
mod prescribed;
mod schema;
mod schema_scene;
mod simulate;
mod simulate_contacts;
mod simulate_energy;
mod simulate_many;
mod simulate_page;
mod usage;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The root of the workspace.
fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// A run of the command from the root of the workspace.
struct Run {
    code: Option<i32>,
    stdout: String,
    stderr: String,
}

fn bgdyn(arguments: &[&str]) -> Run {
    bgdyn_in(root(), arguments)
}

/// A run from another folder.
fn bgdyn_in(folder: &Path, arguments: &[&str]) -> Run {
    let output: Output = Command::new(env!("CARGO_BIN_EXE_bgdyn"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the command starts");
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    Run {
        code: output.status.code(),
        stdout: text(output.stdout),
        stderr: text(output.stderr),
    }
}

impl Run {
    /// Returns its stdout, if it succeeded.
    fn good(self) -> String {
        assert_eq!(self.code, Some(0), "{}", self.stderr);
        self.stdout
    }

    /// Returns its stderr, if it refused a bad input.
    fn bad_input(self) -> String {
        assert_eq!(self.code, Some(1), "{}", self.stderr);
        self.stderr
    }

    /// Returns its stderr, if it was a usage error.
    fn bad_usage(self) -> String {
        assert_eq!(self.code, Some(2), "{}", self.stderr);
        assert_eq!(self.stdout, "");
        self.stderr
    }
}

/// The fields of a table's rows, without its first line.
fn table_rows(table: &str) -> Vec<Vec<String>> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let fields = |row: csv::StringRecord| row.iter().map(str::to_owned).collect();
    let rows = reader.records().map(|row| fields(row.expect("a row")));
    rows.collect()
}

/// Writes a file for one test, in a folder with the name of the test.
fn scratch(test: &str, file: &str, text: impl AsRef<[u8]>) -> String {
    let path: PathBuf = [env!("CARGO_TARGET_TMPDIR"), test, file].iter().collect();
    fs::create_dir_all(path.parent().expect("a parent")).expect("a directory");
    fs::write(&path, text).expect("a file");
    path.display().to_string()
}

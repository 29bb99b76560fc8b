//! The mechanisms and scenes of the repository.

use std::fs;
use std::path::{Path, PathBuf};

use bgdyn_codegen::files::{beside, stem};
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::system::SceneEquations;

/// One of so many mechanisms or scenes is compared by tests that do not compare all.
const ONE_OF: usize = 3;

/// Folders with sound files, relative to the root.
const FOLDERS: [&str; 14] = [
    "specs",
    "specs/loops",
    "specs/constraints",
    "specs/contact",
    "specs/scenes",
    "examples/closed_machines",
    "examples/controllers/plants",
    "examples/free_machines",
    "examples/rolling_machines",
    "tests/actuated",
    "tests/compiled/specs",
    "tests/free_scenes",
    "tests/golden/specs",
    "tests/rotors",
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Returns the text of a file, relative to the root.
pub fn text(path: &str) -> String {
    fs::read_to_string(root().join(path)).expect("a file of the repository")
}

/// Returns the files of all folders: scenes, or mechanisms.
fn files(scenes: bool) -> Vec<PathBuf> {
    let mut all = Vec::new();
    for folder in FOLDERS {
        let entries = fs::read_dir(root().join(folder)).expect("a folder of the repository");
        all.extend(entries.map(|entry| entry.expect("an entry").path()));
    }
    let is_one = |path: &PathBuf| {
        let name = path.to_string_lossy();
        name.ends_with(".yaml") && name.ends_with(".scene.yaml") == scenes
    };
    all.retain(is_one);
    all.sort();
    all
}

/// Returns one of [`ONE_OF`] of them, from the `first` on; all of them if the long test asks for everything.
pub fn some_of<T>(all: Vec<T>, first: usize) -> impl Iterator<Item = T> {
    let everything = std::env::var_os("BGDYN_EVERYTHING").is_some();
    let step = if everything { 1 } else { ONE_OF };
    all.into_iter().skip(first.min(step - 1)).step_by(step)
}

/// Returns the mechanisms with their names.
pub fn mechanisms() -> Vec<(String, Mechanism)> {
    let one = |path: PathBuf| {
        let text = fs::read_to_string(&path).expect("a spec");
        let name = stem(&path);
        let (mechanism, faults) = bgdyn_codegen::read(&text, Some(&name));
        (
            name,
            mechanism.unwrap_or_else(|| panic!("{}: {faults:?}", path.display())),
        )
    };
    let all: Vec<_> = files(false).into_iter().map(one).collect();
    assert!(all.len() > 50, "{} mechanisms", all.len());
    all
}

/// Returns the equations of the scenes with their names.
pub fn scenes() -> Vec<(String, SceneEquations)> {
    let one = |path: PathBuf| {
        let text = fs::read_to_string(&path).expect("a scene");
        let load = |mechanism: &str| {
            fs::read_to_string(beside(&path, mechanism)).map_err(|e| e.to_string())
        };
        let read = bgdyn_codegen::read_scene(&text, &stem(&path), load);
        let (system, _) = read.unwrap_or_else(|refusal| panic!("{}: {refusal:?}", path.display()));
        (stem(&path), system)
    };
    let all: Vec<_> = files(true).into_iter().map(one).collect();
    assert!(all.len() > 30, "{} scenes", all.len());
    all
}

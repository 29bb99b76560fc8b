//! Generates the variants of the scenes that the example `accuracy` compares.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs, thread};

use bgdyn_accuracy::generate::variants;
use bgdyn_codegen::files::{beside, stem};
use bgdyn_codegen::read_scene;
use bgdyn_codegen::system::SceneEquations;

/// The scenes, with the ends of their runs if they differ from the file, s.
const SCENES: [(&str, Option<f64>); 8] = [
    ("cart_and_pole", None),
    ("scara_everything", None),
    ("puma_distributed", None),
    ("ur5_contact", None),
    ("stiff_spring_pendulum", Some(0.2)),
    ("hydraulic_cylinder", Some(0.1)),
    ("motor_linear_stiff", None),
    ("stick_slip", None),
];

fn main() {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").expect("cargo"));
    let out = PathBuf::from(env::var("OUT_DIR").expect("cargo"));
    let (mut modules, mut list) = (String::new(), String::new());
    // Scenes do not depend on each other: a thread each.
    let texts = thread::scope(|scope| {
        let root = &root;
        let started = SCENES.map(|(name, end)| scope.spawn(move || text_of(root, name, end)));
        started.map(|thread| thread.join().expect("no panic"))
    });
    for ((name, _), text) in SCENES.into_iter().zip(texts) {
        fs::write(out.join(format!("{name}.rs")), text).expect("OUT_DIR is writable");
        let file = out.join(format!("{name}.rs")).display().to_string();
        writeln!(modules, "include!({file:?});").expect("text");
        write!(list, "({name:?}, {name}::test_case), ").expect("text");
    }
    let count = SCENES.len();
    modules += &format!(
        "/// The scenes' names, and what is measured of each.\npub const TEST_CASES: [(&str, Study); {count}] = [{list}];\n"
    );
    fs::write(out.join("modules.rs"), modules).expect("OUT_DIR is writable");
}

/// The modules of a scene's variants.
fn text_of(root: &Path, name: &str, end: Option<f64>) -> String {
    let path = root.join(format!("../../specs/scenes/{name}.scene.yaml"));
    variants(&read(&path), end).unwrap_or_else(|e| panic!("{e}"))
}

/// A scene.
fn read(path: &Path) -> SceneEquations {
    println!("cargo::rerun-if-changed={}", path.display());
    let text = fs::read_to_string(path).expect("a scene");
    let load = |mechanism: &str| {
        let path = beside(path, mechanism);
        println!("cargo::rerun-if-changed={}", path.display());
        fs::read_to_string(path).map_err(|e| e.to_string())
    };
    let found = read_scene(&text, &stem(path), load);
    found
        .unwrap_or_else(|e| panic!("{}: {e:?}", path.display()))
        .0
}

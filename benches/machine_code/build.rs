//! Generates the arms and the scenes in Rust.
//!
//! `models.rs` contains the modules, `calls.rs` calls of the macros `arms!` and `scenes!` with all of them, which the
//! benchmark defines.

use std::fmt::Write;
use std::path::PathBuf;
use std::{env, fs};

use bgdyn_codegen::build_script::Build;
use bgdyn_codegen::emit::struct_ident;
use bgdyn_codegen::files::stem;

const ARMS: [&str; 4] = ["scara", "puma560", "ur5", "panda"];
const METHODS: [&str; 4] = [
    "inverse_dynamics",
    "mass_matrix",
    "forward_dynamics",
    "forward_dynamics_derivatives",
];
const SCENES: [&str; 6] = [
    "specs/scenes/stick_slip",
    "specs/scenes/crane",
    "specs/scenes/scara_everything",
    "specs/scenes/puma_drives",
    "examples/free_machines/quadrotor_arm",
    "examples/closed_machines/delta_pick",
];

fn main() {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap()).join("../..");
    let out = PathBuf::from(env::var("OUT_DIR").unwrap());
    println!("cargo::rerun-if-changed={}", root.join("specs").display());
    let (mut models, mut arms, mut scenes) = (String::new(), String::new(), String::new());
    for arm in ARMS {
        let path = root.join(format!("specs/{arm}.yaml"));
        let written = Build::new(&path).methods(METHODS).derivatives(true).write();
        written.unwrap_or_else(|error| panic!("{error}"));
        let include = format!("include!(concat!(env!(\"OUT_DIR\"), \"/{arm}.rs\"));");
        writeln!(models, "{include}").unwrap();
        writeln!(arms, "{arm} {} {path:?},", struct_ident(arm)).unwrap();
    }
    for scene in SCENES {
        let path = root.join(format!("{scene}.scene.yaml"));
        println!("cargo::rerun-if-changed={}", path.display());
        let written = Build::new(&path).write();
        let file = written.unwrap_or_else(|error| panic!("{error}"));
        writeln!(models, "include!({:?});", file.display().to_string()).unwrap();
        let name = stem(&path);
        writeln!(scenes, "{name} {} {path:?},", struct_ident(&name)).unwrap();
    }
    fs::write(out.join("models.rs"), models).unwrap();
    let calls = format!("arms! {{\n{arms}}}\nscenes! {{\n{scenes}}}\n");
    fs::write(out.join("calls.rs"), calls).unwrap();
}

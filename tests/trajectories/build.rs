//! Generates the modules of the scenes whose motions are known.

use std::fmt::Write;
use std::path::PathBuf;
use std::{env, fs};

use bgdyn_codegen::Build;

/// Scenes of `tests/hard_cases/scenes`, integrated by an explicit method.
const SMOOTH: [&str; 6] = [
    "a01_simple_pendulum",
    "arm6_3d",
    "chain8_rods",
    "double_pendulum_chaotic",
    "mass_ratio_1e6_1",
    "mass_ratio_1e9_1",
];

/// Scenes of `specs/scenes`: some with the Jacobian that stiff methods use.
const SHARED: [(&str, bool); 6] = [
    ("hydraulic_cylinder", true),
    ("lugre_stick_slip", true),
    ("motor_linear_stiff", true),
    ("stick_slip", false),
    ("stiff_spring_pendulum", true),
    ("stiff_spring_two_mass", true),
];

fn main() {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap());
    let out = PathBuf::from(env::var("OUT_DIR").unwrap());
    let (own, shared) = ("../hard_cases/scenes", "../../specs/scenes");
    let scenes = SMOOTH.map(|name| (own, name, false)).into_iter();
    let scenes = scenes.chain(SHARED.map(|(name, stiff)| (shared, name, stiff)));
    let mut modules = String::new();
    for (folder, name, stiff) in scenes {
        let path = root.join(folder).join(format!("{name}.scene.yaml"));
        let file = Build::new(path).jacobian(stiff).write();
        let file = file.unwrap_or_else(|e| panic!("{e}"));
        let file = file.display().to_string();
        writeln!(modules, "include!({file:?});").unwrap();
    }
    fs::write(out.join("modules.rs"), modules).unwrap();
}

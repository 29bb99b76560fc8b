//! Generates the modules of the scenes whose motions are known.

use std::fmt::Write;
use std::path::PathBuf;
use std::{env, fs};

use bgdyn_codegen::Build;

/// Scenes of `tests/hard_cases/scenes`, and whether with the Jacobian that stiff methods use.
const OWN: [(&str, bool); 7] = [
    ("a01_simple_pendulum", false),
    ("arm6_3d", false),
    ("chain8_rods", false),
    ("double_pendulum_chaotic", false),
    ("mass_ratio_1e6_1", false),
    ("mass_ratio_1e9_1", false),
    ("stiff_spring_stretch", true),
];

/// The same of `specs/scenes`.
const SHARED: [(&str, bool); 5] = [
    ("hydraulic_cylinder", true),
    ("lugre_stick_slip", true),
    ("motor_linear_stiff", true),
    ("stick_slip", false),
    ("stiff_spring_two_mass", true),
];

fn main() {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap());
    let out = PathBuf::from(env::var("OUT_DIR").unwrap());
    let own = OWN.map(|(name, stiff)| ("../hard_cases/scenes", name, stiff));
    let shared = SHARED.map(|(name, stiff)| ("../../specs/scenes", name, stiff));
    let mut modules = String::new();
    for (folder, name, stiff) in own.into_iter().chain(shared) {
        let path = root.join(folder).join(format!("{name}.scene.yaml"));
        let file = Build::new(path).jacobian(stiff).write();
        let file = file.unwrap_or_else(|e| panic!("{e}"));
        let file = file.display().to_string();
        writeln!(modules, "include!({file:?});").unwrap();
    }
    fs::write(out.join("modules.rs"), modules).unwrap();
}

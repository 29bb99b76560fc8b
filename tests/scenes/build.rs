//! Generates the modules of the repository's scenes, and of those of this folder.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

use bgdyn_codegen::Build;
use bgdyn_codegen::emit::struct_ident;
use bgdyn_codegen::files::stem;

/// The scenes with a Jacobian and a canonical form.
const FORMED: [&str; 5] = [
    "hydraulic_cylinder",
    "motor_linear_stiff",
    "scara_everything",
    "series_elastic_arm",
    "stiff_spring_pendulum",
];

fn main() {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap());
    let out = PathBuf::from(env::var("OUT_DIR").unwrap());
    let (mut modules, mut each, mut formed) = (String::new(), String::new(), String::new());
    for path in scenes(&root.join("../../specs/scenes")) {
        let name = stem(&path);
        let forms = FORMED.contains(&name.as_str());
        let build = Build::new(&path).jacobian(forms).canonical(forms);
        let file = build.write().unwrap_or_else(|e| panic!("{e}"));
        let file = file.display().to_string();
        writeln!(modules, "include!({file:?});").unwrap();
        let model = struct_ident(&name);
        let path = path.display().to_string();
        let call = format!("$run!({name}, {model}, {path:?});\n");
        each += &call;
        if forms {
            formed += &call;
        }
    }
    let list = [("each_scene", each), ("each_formed", formed)].map(|(name, calls)| {
        format!(
            "/// Calls the macro `run` with each scene.\n#[macro_export]\nmacro_rules! {name} {{ ($run:ident) => {{ {calls} }} }}\n"
        )
    });
    fs::write(out.join("modules.rs"), modules + &list.concat()).unwrap();
}

/// The scenes of a folder.
fn scenes(folder: &Path) -> Vec<PathBuf> {
    println!("cargo::rerun-if-changed={}", folder.display());
    let entries = fs::read_dir(folder).expect("a folder of scenes");
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

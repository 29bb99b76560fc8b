//! Generates the modules of the repository's scenes, and of those of this folder.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

use bgdyn_codegen::emit::struct_ident;
use bgdyn_codegen::model::stem;

fn main() {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap());
    let out = PathBuf::from(env::var("OUT_DIR").unwrap());
    let (mut modules, mut each) = (String::new(), String::new());
    for path in scenes(&root.join("../../specs/scenes")) {
        let file = bgdyn_codegen::build(&path).unwrap_or_else(|e| panic!("{e}"));
        let (name, file) = (stem(&path), file.display().to_string());
        writeln!(modules, "include!({file:?});").unwrap();
        let model = struct_ident(&name);
        let path = path.display().to_string();
        writeln!(each, "$run!({name}, {model}, {path:?});").unwrap();
    }
    let list = format!(
        "/// Calls the macro `run` with each scene.\n#[macro_export]\nmacro_rules! each_scene {{ ($run:ident) => {{ {each} }} }}\n"
    );
    fs::write(out.join("modules.rs"), modules + &list).unwrap();
}

/// The scenes of a folder.
fn scenes(folder: &Path) -> Vec<PathBuf> {
    println!("cargo::rerun-if-changed={}", folder.display());
    let entries = fs::read_dir(folder).expect("a folder of scenes");
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

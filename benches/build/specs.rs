//! The mechanisms of `specs/`, each with the methods that are timed and counted.

use std::fs;
use std::path::{Path, PathBuf};

use bgdyn_codegen::build_script::Build;
use bgdyn_codegen::mechanism::Mechanism;

use crate::robots;

#[path = "../src/methods.rs"]
mod methods;

/// Generates the mechanisms of this folder. The line of each in `robots!` has the Jacobian of its tip, and what `rest`
/// returns for the path, the mechanism and the tip.
pub fn generate(specs: &Path, rest: impl Fn(&Path, &Mechanism, &str) -> String) {
    println!("cargo::rerun-if-changed={}", specs.display());
    robots::generate(&paths(specs), |path, mechanism| {
        let tip = tip(mechanism);
        let jacobian = format!("jacobian_world_{tip}");
        let rest = format!("{jacobian} {}", rest(path, mechanism, tip));
        let methods = methods::CONTROLLER
            .map(String::from)
            .into_iter()
            .chain([jacobian]);
        (Build::new(path).methods(methods), rest)
    });
}

/// Returns the paths of the specs in a folder, in the order of their names.
fn paths(specs: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(specs).expect("a folder of specs");
    let mut paths: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "yaml"));
    paths.sort();
    paths
}

/// Returns the last frame on a link, else the last link.
fn tip(mechanism: &Mechanism) -> &str {
    let frame = mechanism.frames().iter().rev().find(|f| f.link.is_some());
    let link = mechanism.links().last().expect("a link");
    frame.map_or(&link.name, |f| &f.name)
}

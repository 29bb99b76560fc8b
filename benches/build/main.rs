//! Generates the mechanisms of `specs/`, each with the methods that are timed, and `bundles.rs`: the modules of two arms
//! with the methods of a controller, one by one and in a bundle.

mod robots;
mod specs;

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

use bgdyn_codegen::build_script::Build;

fn main() {
    let folder = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap()).join("../specs");
    let out = PathBuf::from(env::var("OUT_DIR").unwrap());
    specs::generate(&folder, |path, _, tip| format!("{tip:?} {path:?}"));
    fs::write(out.join("bundles.rs"), bundles(&folder)).unwrap();
}

/// Writes the modules of the arms with a bundle, and returns the text that includes them.
fn bundles(specs: &Path) -> String {
    let mut text = String::new();
    for (arm, site) in [("ur5", "flange"), ("panda", "tool")] {
        let of_site = ["pose", "jacobian_world", "jacobian_dot_v_world"];
        let of_site = of_site.map(|method| format!("{method}_{site}"));
        let methods = ["mass_matrix", "bias"].map(String::from).into_iter();
        let methods: Vec<String> = methods.chain(of_site).collect();
        let build = Build::new(specs.join(format!("{arm}.yaml"))).module(&format!("{arm}_control"));
        let build = build.methods(methods.clone()).bundle("control", methods);
        let path = build.write().unwrap_or_else(|error| panic!("{error}"));
        writeln!(text, "include!({path:?});").unwrap();
    }
    text
}

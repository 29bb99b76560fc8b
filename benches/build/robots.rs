//! The mechanisms of `specs/`, each generated with the methods that are timed and counted.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use bgdyn_codegen::build_script::Build;
use bgdyn_codegen::emit::struct_ident;
use bgdyn_codegen::files::stem;
use bgdyn_codegen::mechanism::Mechanism;

const METHODS: [&str; 5] = [
    "inverse_dynamics",
    "mass_matrix",
    "forward_dynamics",
    "bias",
    "gravity",
];

/// Generates the robots of `specs` into `out`: `models.rs` contains their modules, `robots.rs` a call of the macro
/// `robots!`, which the including file defines. For each robot it has the module, the struct, the Jacobian of the tip,
/// and what `rest` returns for the path, the mechanism and the tip.
pub fn generate(specs: &Path, out: &Path, rest: impl Fn(&Path, &Mechanism, &str) -> String) {
    println!("cargo::rerun-if-changed={}", specs.display());
    let (mut models, mut calls) = (String::new(), String::new());
    for path in paths(specs) {
        let (name, mechanism) = (stem(&path), mechanism(&path));
        let tip = tip(&mechanism);
        let methods = METHODS.map(String::from).into_iter();
        let methods = methods.chain([format!("jacobian_world_{tip}")]);
        let written = Build::new(&path).methods(methods).write();
        written.unwrap_or_else(|error| panic!("{error}"));
        let include = format!("include!(concat!(env!(\"OUT_DIR\"), \"/{name}.rs\"));");
        writeln!(models, "{include}").unwrap();
        let (model, rest) = (struct_ident(&name), rest(&path, &mechanism, tip));
        writeln!(calls, "{name} {model} jacobian_world_{tip} {rest},").unwrap();
    }
    fs::write(out.join("models.rs"), models).unwrap();
    fs::write(out.join("robots.rs"), format!("robots! {{\n{calls}}}\n")).unwrap();
}

/// Returns the paths of the specs in a folder, in the order of their names.
fn paths(specs: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(specs).expect("a folder of specs");
    let mut paths: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "yaml"));
    paths.sort();
    paths
}

fn mechanism(path: &Path) -> Mechanism {
    let text = fs::read_to_string(path).expect("a spec");
    let (mechanism, faults) = bgdyn_codegen::read(&text, Some(&stem(path)));
    let shown = path.display().to_string();
    mechanism.unwrap_or_else(|| panic!("{}", faults.render(&shown, &text)))
}

/// Returns the last frame on a link, else the last link.
fn tip(mechanism: &Mechanism) -> &str {
    let frame = mechanism.frames().iter().rev().find(|f| f.link.is_some());
    let link = mechanism.links().last().expect("a link");
    frame.map_or(&link.name, |f| &f.name)
}

//! Generates the mechanisms of `specs/`, each with the methods that are timed: `models.rs` contains their
//! modules, `robots.rs` a call of the macro `robots!` with all of them, which the including file defines. `bundles.rs`
//! contains the modules of two arms with the methods of a controller, one by one and in a bundle.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

use bgdyn_codegen::build_script::Build;
use bgdyn_codegen::emit::struct_ident;
use bgdyn_codegen::files::stem;

const METHODS: [&str; 5] = [
    "inverse_dynamics",
    "mass_matrix",
    "forward_dynamics",
    "bias",
    "gravity",
];

fn main() {
    let specs = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap()).join("../specs");
    let out = PathBuf::from(env::var("OUT_DIR").unwrap());
    println!("cargo::rerun-if-changed={}", specs.display());
    let entries = fs::read_dir(&specs).expect("a folder of specs");
    let mut paths: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "yaml"));
    paths.sort();
    let (mut models, mut robots) = (String::new(), String::new());
    for path in paths {
        let (name, tip) = (stem(&path), tip(&path));
        let methods = METHODS.map(String::from).into_iter();
        let methods = methods.chain([format!("jacobian_world_{tip}")]);
        let written = Build::new(&path).methods(methods).write();
        written.unwrap_or_else(|error| panic!("{error}"));
        let model = struct_ident(&name);
        let include = format!("include!(concat!(env!(\"OUT_DIR\"), \"/{name}.rs\"));");
        writeln!(models, "{include}").unwrap();
        writeln!(
            robots,
            "{name} {model} jacobian_world_{tip} \"{tip}\" {path:?},"
        )
        .unwrap();
    }
    fs::write(out.join("models.rs"), models).unwrap();
    let robots = format!("robots! {{\n{robots}}}\n");
    fs::write(out.join("robots.rs"), robots).unwrap();
    fs::write(out.join("bundles.rs"), bundles(&specs)).unwrap();
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

/// Returns the last frame on the last link, else the last link.
fn tip(path: &Path) -> String {
    let text = fs::read_to_string(path).expect("a spec");
    let (mechanism, faults) = bgdyn_codegen::read(&text, Some(&stem(path)));
    let shown = path.display().to_string();
    let mechanism = mechanism.unwrap_or_else(|| panic!("{}", faults.render(&shown, &text)));
    let frame = mechanism.frames().iter().rev().find(|f| f.link.is_some());
    let link = mechanism.links().last().expect("a link");
    frame.map_or(&link.name, |f| &f.name).clone()
}

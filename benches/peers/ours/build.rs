//! Generates the models to be timed: the specs that `BGDYN_PEERS` names, one path per line. `robots.rs`
//! contains their modules, and one call of the macro `robots!` with all of them.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

use bgdyn_codegen::build_script::Build;
use bgdyn_codegen::emit::struct_ident;
use bgdyn_codegen::files::stem;

/// Largest number of joints for which derivatives are generated, and states in lanes timed: for more, the
/// C code of the peers takes minutes to compile.
const SMALL: usize = 12;

fn main() {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap()).join("../../..");
    let out = PathBuf::from(env::var("OUT_DIR").unwrap());
    println!("cargo::rerun-if-env-changed=BGDYN_PEERS");
    let specs = env::var("BGDYN_PEERS").unwrap_or("tests/golden/specs/scara4.yaml".into());
    let (mut modules, mut robots) = (String::new(), String::new());
    for spec in specs.lines().filter(|line| !line.is_empty()) {
        let path = root.join(spec);
        let name = stem(&path);
        let small = joints(&path) <= SMALL;
        let build = Build::new(&path)
            .methods(["inverse_dynamics", "mass_matrix", "forward_dynamics"])
            .derivatives(small);
        build.write().unwrap_or_else(|error| panic!("{error}"));
        writeln!(
            modules,
            "include!(concat!(env!(\"OUT_DIR\"), \"/{name}.rs\"));"
        )
        .unwrap();
        let size = if small { "small" } else { "large" };
        let model = struct_ident(&name);
        writeln!(robots, "{size} {name} {model} {path:?},").unwrap();
    }
    fs::write(
        out.join("robots.rs"),
        format!("{modules}robots! {{\n{robots}}}\n"),
    )
    .unwrap();
}

fn joints(path: &Path) -> usize {
    let shown = path.display().to_string();
    let text = fs::read_to_string(path).unwrap_or_else(|error| panic!("{shown}: {error}"));
    let (mechanism, faults) = bgdyn_codegen::read(&text, Some(&stem(path)));
    mechanism.map_or_else(|| panic!("{}", faults.render(&shown, &text)), |m| m.nv())
}

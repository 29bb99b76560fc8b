//! Generates the arms to be timed: the specs that `BGDYN_PEERS` names, one path per line. `robots.rs` contains their
//! modules, and one call of the macro `robots!` with all of them.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

use bgdyn_codegen::build_script::Build;
use bgdyn_codegen::emit::struct_ident;
use bgdyn_codegen::files::stem;

const METHODS: [&str; 14] = [
    "regressor",
    "inverse_mass_matrix",
    "inverse_dynamics_along",
    "inverse_dynamics_adjoint",
    "forward_dynamics_along",
    "forward_dynamics_adjoint",
    "inverse_dynamics_curvature",
    "mass_matrix_rate",
    "centre_of_mass",
    "com_jacobian",
    "centroidal_map",
    "centroidal_momentum",
    "centroidal_bias",
    "operational_inverse_",
];

fn main() {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap()).join("../../..");
    let out = PathBuf::from(env::var("OUT_DIR").unwrap());
    println!("cargo::rerun-if-env-changed=BGDYN_PEERS");
    let specs = env::var("BGDYN_PEERS").unwrap_or("tests/golden/specs/scara4.yaml".into());
    let (mut modules, mut robots) = (String::new(), String::new());
    for spec in specs.lines().filter(|line| !line.is_empty()) {
        let path = root.join(spec);
        let (name, arm) = (stem(&path), arm(&path));
        let tip = &arm.tip;
        let mut methods = METHODS.map(String::from).to_vec();
        *methods.last_mut().unwrap() += tip;
        // A link that fewer than six velocities move has no such inertia.
        let spatial = if arm.nv < 6 { "planar" } else { "spatial" };
        if arm.nv >= 6 {
            methods.push(format!("operational_inertia_{tip}"));
        }
        let build = Build::new(&path).methods(methods);
        build.write().unwrap_or_else(|error| panic!("{error}"));
        let include = format!("include!(concat!(env!(\"OUT_DIR\"), \"/{name}.rs\"));");
        writeln!(modules, "{include}").unwrap();
        let model = struct_ident(&name);
        let of_tip = format!("operational_inverse_{tip} operational_inertia_{tip}");
        writeln!(robots, "{spatial} {name} {model} {of_tip} {path:?},").unwrap();
    }
    let text = format!("{modules}robots! {{\n{robots}}}\n");
    fs::write(out.join("robots.rs"), text).unwrap();
}

/// What the build script has to know of an arm.
struct Arm {
    /// Number of velocities.
    nv: usize,
    /// The last link that a joint moves.
    tip: String,
}

fn arm(path: &Path) -> Arm {
    let shown = path.display().to_string();
    let text = fs::read_to_string(path).unwrap_or_else(|error| panic!("{shown}: {error}"));
    let (mechanism, faults) = bgdyn_codegen::read(&text, Some(&stem(path)));
    let mechanism = mechanism.unwrap_or_else(|| panic!("{}", faults.render(&shown, &text)));
    let last = mechanism.coordinates().last().expect("a joint that moves");
    Arm {
        nv: mechanism.nv(),
        tip: mechanism.links()[last.0].name.clone(),
    }
}

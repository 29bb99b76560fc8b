//! Generates scenes: those with known motions, the scenes of the repository, and those with effects of
//! zero strength.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use bgdyn_codegen::emit::{OutputOptions, scene_module, source_text, struct_ident};
use bgdyn_codegen::files::{beside, stem};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::read_scene;
use bgdyn_codegen::selection::scene_functions;
use bgdyn_codegen::system::SceneEquations;

use crate::arm::{ALL, TENSOR, mechanism};
use crate::dependence;

/// Scenes with the Jacobian for stiff integrators, or for the orders of those that read it.
const WITH_JACOBIAN: [&str; 9] = [
    "body_tumbling",
    "heavy_top_slow_cusp",
    "hydraulic_cylinder",
    "lugre_stick_slip",
    "motor_linear_stiff",
    "motor_pendulum",
    "spherical_pendulum",
    "stiff_spring_stretch",
    "stiff_spring_two_mass",
];

/// Scenes with a canonical form.
const CANONICAL: [&str; 1] = ["double_pendulum_chaotic"];

/// Scenes with loops, of `tests/closed_loops`.
const CLOSED: [&str; 4] = ["crank_run", "five_bar_run", "stewart_run", "swing"];

/// Returns every scene file of a folder.
fn files(folder: PathBuf) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder of scenes");
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

/// Returns the arm and sled without an effect besides the built-in ones, and with one whose strength is 0:
/// the scene's name, its text, its mechanism's.
fn of_no_strength() -> Vec<(String, String, String)> {
    let mut all = vec![("without".into(), ALL.into(), mechanism("", TENSOR, ""))];
    let mut add = |name: String, written: String| {
        let effects = format!("effects:\n  extra: {written}\n");
        let text = ALL.replace("velocity_products]", "velocity_products, extra]");
        all.push((name, text, mechanism("", TENSOR, &effects)));
    };
    for (kind, written) in [
        ("viscous", "{ type: viscous, joint: turn, damping: VALUE }"),
        ("spring", "{ type: spring, joint: slide, stiffness: VALUE }"),
        (
            "damper",
            "{ type: damper, between: [anchor, tip], damping: VALUE }",
        ),
        ("drag", "{ type: drag, at: tip, linear: VALUE }"),
    ] {
        add(format!("constant_{kind}"), written.replace("VALUE", "0"));
        let open = "{ parameter: strength, value: 0 }";
        add(format!("parameter_{kind}"), written.replace("VALUE", open));
    }
    add("input_wrench".into(), "{ type: wrench, at: tip }".into());
    all
}

/// Writes the module of a scene; returns the line that includes it.
fn module_of(out: &Path, name: &str, system: &SceneEquations, functions: &[Function]) -> String {
    let place = OutputOptions::source_text(format!("{name}.scene.yaml"));
    let place = place.with_module(name).expect("a name");
    let source = out.join(format!("scene_{name}.rs"));
    fs::write(
        &source,
        source_text(scene_module(system, functions, &place)),
    )
    .unwrap();
    format!("include!({source:?});\n")
}

/// Writes all modules; returns the text that includes them and lists those of the repository.
pub(crate) fn write(root: &Path, out: &Path) -> String {
    let [mut includes, mut calls, mut depends] = [const { String::new() }; 3];
    for (name, text, mechanism) in of_no_strength() {
        let read = read_scene(&text, &name, |_| Ok(mechanism.clone()));
        let (system, _) = read.unwrap_or_else(|e| panic!("{name}: {e:?}"));
        let functions = scene_functions(&system, &Options::default());
        includes += &module_of(out, &name, &system, &functions);
    }
    let driven = root.join("../free_scenes/satellite_torques.scene.yaml");
    let closed = CLOSED.map(|name| root.join(format!("../closed_loops/{name}.scene.yaml")));
    let known = files(root.join("scenes")).into_iter().chain([driven]);
    let known = known.chain(closed);
    let known = known.map(|path| (path, false));
    let shared = files(root.join("../../specs/scenes"))
        .into_iter()
        .map(|path| (path, true));
    for (path, is_shared) in known.chain(shared) {
        let (name, text) = (stem(&path), fs::read_to_string(&path).unwrap());
        let load = |mechanism: &str| {
            fs::read_to_string(beside(&path, mechanism)).map_err(|e| e.to_string())
        };
        let read = read_scene(&text, &name, load);
        let (system, _) = read.unwrap_or_else(|e| panic!("{}: {e:?}", path.display()));
        let options = Options {
            jacobian: WITH_JACOBIAN.contains(&name.as_str()),
            canonical: CANONICAL.contains(&name.as_str()),
            ..Options::default()
        };
        let functions = scene_functions(&system, &options);
        includes += &module_of(out, &name, &system, &functions);
        if is_shared {
            let derivative = functions
                .iter()
                .find(|f| f.name() == SceneFunction::Derivative.name());
            let masks = dependence::text(derivative.expect("every scene has one"));
            let layout = &system.scene.layout;
            writeln!(
                depends,
                "({name:?}, [{}, {}, {}], {masks}),",
                layout.nq(),
                layout.nv(),
                layout.nx()
            )
            .unwrap();
            let model = struct_ident(&name);
            writeln!(calls, "$run!({name}, {model});").unwrap();
        }
    }
    format!(
        "{includes}
/// Calls the macro `run` with each of the repository's scenes.
#[macro_export]
macro_rules! each_scene {{ ($run:ident) => {{ {calls} }} }}
/// Of each of them the numbers of positions, velocities and states of first order, and what the rates
/// of velocities and states depend on: one mask of parts of the state for each.
pub const DEPENDS: &[(&str, [usize; 3], &[u128])] = &[{depends}];
"
    )
}

//! Tests the generator's own verification: every spec and every scene passes, and functions with an error
//! of each known kind do not (`mistakes`).

#[path = "../common/allocator.rs"]
mod allocator;

mod mistakes;
mod rigid_contacts;

use std::path::{Path, PathBuf};

use bgdyn_codegen::bond_graph;
use bgdyn_codegen::choice::Choice;
use bgdyn_codegen::files::{beside, stem};
use bgdyn_codegen::formulation::FORMULATIONS;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::generated::Generated;
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::read_scene;
use bgdyn_codegen::selection::scene_functions;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_codegen::verify::{check_functions, check_scene, explain};

/// Files with this ending below a folder of the repository.
fn files(folder: &str, ending: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("..")
        .join(folder);
    let entries = std::fs::read_dir(folder).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut found: Vec<PathBuf> = paths
        .filter(|path| path.display().to_string().ends_with(ending))
        .collect();
    found.sort();
    assert!(!found.is_empty());
    found
}

fn text(path: &Path) -> String {
    std::fs::read_to_string(path).expect("a file")
}

fn mechanism(text: &str, name: &str) -> Mechanism {
    let (mechanism, faults) = bgdyn_codegen::read(text, Some(name));
    mechanism.unwrap_or_else(|| panic!("{}", faults.render(name, text)))
}

fn scene(text: &str, mechanism: &str) -> SceneEquations {
    let read = read_scene(text, "scene", |_| Ok(mechanism.to_owned()));
    read.unwrap_or_else(|refusal| panic!("{refusal:?}")).0
}

fn all() -> Options {
    Options {
        derivatives: true,
        ..Options::default()
    }
}

/// Returns every function, including scenes' Jacobian and canonical form.
fn functions(system: &SceneEquations) -> Vec<Function> {
    let options = Options {
        jacobian: true,
        canonical: true,
        ..Options::default()
    };
    scene_functions(system, &options)
}

#[test]
fn every_spec_passes() {
    let specs = files("specs", ".yaml");
    for path in specs.iter().chain(&files("tests/golden/specs", ".yaml")) {
        let mechanism = mechanism(&text(path), &stem(path));
        let options = Options {
            // Derivatives of long chains take a minute each.
            derivatives: mechanism.nv() <= 10,
            ..Options::default()
        };
        let model = bgdyn_codegen::selection::model(mechanism, &options).expect("a model");
        let found = check_functions("spec", &model.bond_graph, &model.functions);
        assert!(found.is_empty(), "{}: {}", path.display(), explain(&found));
    }
}

#[test]
fn every_scene_passes() {
    for path in files("specs/scenes", ".yaml") {
        let load = |mechanism: &str| Ok(text(&beside(&path, mechanism)));
        let (system, _) = read_scene(&text(&path), &stem(&path), load).expect("a scene");
        let found = check_scene(&system, &functions(&system));
        assert!(found.is_empty(), "{}: {}", path.display(), explain(&found));
    }
}

#[test]
fn every_formulation_passes() {
    let graph = bond_graph::build(&mechanism(ARM, "arm"));
    for formulation in FORMULATIONS {
        let choice = Choice::new(&graph, Some(formulation));
        let methods = Method::possible(&graph.sites).into_iter();
        let made = methods.filter_map(|m| choice.function(m));
        let made: Vec<Function> = made.map(|f| (*f).clone()).collect();
        let found = check_functions("arm", &graph, &made);
        assert!(found.is_empty(), "{}", explain(&found));
    }
}

const ARM: &str = "\
format: 1
links:
  - name: upper
    joint: { name: shoulder, type: revolute, axis: z }
    mass: 2
    com: [0.2, 0, 0.03]
    inertia: { xx: 0.01, yy: 0.05, zz: 0.05, xy: 0.002 }
  - name: fore
    parent: upper
    joint: { name: elbow, type: revolute, axis: [0, 0.8, 0.6], origin: { xyz: [0.4, 0.02, 0] } }
    mass: 1
    com: [0.15, 0, 0]
    inertia: { xx: 0.005, yy: 0.02, zz: 0.02 }
  - name: hand
    parent: fore
    joint: { name: wrist, type: revolute, axis: x, origin: { xyz: [0.3, 0, 0] } }
    mass: 0.5
    com: [0.05, 0, 0.02]
    inertia: { xx: 0.001, yy: 0.002, zz: 0.002 }
";

/// Returns the arm with a full rotor of the elbow on this link.
fn with_rotor(on: &str) -> SceneEquations {
    let text = format!(
        "scene: 1\nmechanism: arm.yaml\neffects: [inertia, velocity_products, gravity, motor: \
         {{ type: rotor, joint: elbow, inertia: 2e-4, ratio: 100, on: {on}, axis: [1, 2, 0.5] }}]\n"
    );
    scene(&text, ARM)
}

/// A full rotor on any link, inboard of its joint, on the link that it moves, and outboard: in every
/// function.
#[test]
fn full_rotors_on_any_link_pass() {
    for on in ["upper", "fore", "hand"] {
        let system = with_rotor(on);
        let found = check_scene(&system, &functions(&system));
        assert!(found.is_empty(), "on {on}: {}", explain(&found));
    }
}

/// Axes without snapping (`snap: 0`), almost coordinate axes and almost or exactly opposite, in every
/// method: of the arm, of its first two links with both joints at one place, and of the first link alone.
/// In the last two no common normal determines the axes of the first body.
#[test]
fn noisy_axes_pass() {
    let (two, _) = ARM.split_once("  - name: hand").expect("a hand");
    let (one, _) = ARM.split_once("  - name: fore").expect("a forearm");
    let two = two.replace("xyz: [0.4, 0.02, 0]", "xyz: [0, 0, 0]");
    for off in [1e-20, 1e-17, 1e-16, 3e-15, 1e-14, 1e-13] {
        for (text, second) in [
            (ARM, -off),
            (two.as_str(), -off),
            (two.as_str(), off),
            (one, 0.0),
        ] {
            let text = text
                .replace("format: 1", "format: 1\nsnap: 0")
                .replace("axis: z", &format!("axis: [{off:e}, 0, 1]"))
                .replace("axis: [0, 0.8, 0.6]", &format!("axis: [{second:e}, 0, -1]"));
            let graph = bond_graph::build(&mechanism(&text, "arm"));
            let choice = Choice::new(&graph, None);
            let methods = Method::possible(&graph.sites).into_iter();
            let made: Vec<Function> = methods
                .filter_map(|m| choice.function(m).map(|f| (*f).clone()))
                .collect();
            let found = check_functions("arm", &graph, &made);
            assert!(found.is_empty(), "{}\n{text}", explain(&found));
        }
    }
}

#[test]
fn a_difference_names_all_that_is_needed_to_see_it() {
    let graph = bond_graph::build(&mechanism(ARM, "arm"));
    let mut function = (*Choice::new(&graph, None)
        .function(Method::Gravity)
        .expect("one"))
    .clone();
    function.blocks[0].outputs[1].negative = !function.blocks[0].outputs[1].negative;
    let message = explain(&check_functions("arm", &graph, &[function]));
    for part in [
        "`gravity` of `arm`",
        "recursion",
        "component 1",
        "q = [",
        "verify = false",
    ] {
        assert!(message.contains(part), "{part}: {message}");
    }
}

/// Without coordinates only energies and poses are compared.
#[test]
fn a_mechanism_without_coordinates_passes() {
    let text = "format: 1\nlinks:\n  - name: post\n    joint: { type: fixed, origin: { xyz: [1, 2, 3] } }\n    \
                mass: 2\n    com: [0.1, 0, 0.3]\n";
    let model = bgdyn_codegen::selection::model(mechanism(text, "post"), &all()).expect("a model");
    let found = check_functions("post", &model.bond_graph, &model.functions);
    assert!(found.is_empty(), "{}", explain(&found));
}

/// The step of the pipeline between the functions and their text.
#[test]
fn a_wrong_function_is_named() {
    let path = &files("specs", "scara.yaml")[0];
    let generated = |turned: bool| {
        let mechanism = mechanism(&text(path), "scara");
        let mut model =
            bgdyn_codegen::selection::model(mechanism, &Options::default()).expect("a model");
        let bias = model
            .functions
            .iter_mut()
            .find(|f| f.method == Method::Bias);
        let output = &mut bias.expect("a bias").blocks[0].outputs[0];
        output.negative ^= turned;
        Generated::Mechanism(Box::new(model))
    };
    assert_eq!(generated(false).differences(), []);
    let differences = generated(true).differences();
    assert_eq!(differences.len(), 1);
    assert_eq!(differences[0].function, "bias");
}

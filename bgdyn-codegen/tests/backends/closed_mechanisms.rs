//! Generated C of mechanisms with loops, wheels, couplings, prescribed motions and contacts has the bits of the evaluator, in every
//! method that they can have.

use std::fs;
use std::path::Path;

use bgdyn_codegen::bond_graph::SiteId;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::{bond_graph, read};

use crate::c_program::everything;
use crate::same_bits::{check, model_of, name, text_of};

/// Derivatives, regressors, directions and derivatives by parameters are compared for up to so many velocities of the open
/// tree; in the long test for the second number of them.
const SMALL: [usize; 2] = [4, 8];

/// Mechanisms beside those of the specs: actuated joints that are not the independent ones, planar loops of every form on
/// a moving deck, a robot on wheels; spheres and boxes that may touch.
const OTHERS: [&str; 8] = [
    "specs/contact/ball.yaml",
    "tests/actuated/crank_and_rod.yaml",
    "tests/actuated/one_drive.yaml",
    "tests/actuated/three_drives.yaml",
    "tests/closed_loops/linkages.yaml",
    "tests/contact/branches.yaml",
    "tests/contact/turntable.yaml",
    "tests/rolling/robot.yaml",
];

/// Returns the paths of the specs with loops or constraints.
pub fn paths() -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut paths: Vec<String> = OTHERS.iter().map(ToString::to_string).collect();
    for folder in ["specs/loops", "specs/constraints"] {
        let files = fs::read_dir(root.join(folder)).expect("a folder");
        let names = files.map(|file| file.expect("a file").file_name());
        paths.extend(names.map(|name| format!("{folder}/{}", name.to_string_lossy())));
    }
    paths.sort();
    paths
}

/// Returns a model with every method that the mechanism can have.
fn whole_model(path: &str) -> Model {
    let (text, stem) = text_of(path);
    let (mechanism, _) = read(&text, Some(&stem));
    let graph = bond_graph::build(&mechanism.expect("sound"));
    let closed = graph.closed.as_deref();
    let size = closed.map_or(graph.coordinates.len(), |c| c.tree.coordinates.len());
    // The functions of other frames are alike.
    let repeats = |m: &Method| m.is_derived() && m.site() > Some(SiteId(0));
    let of_contacts = |m: &Method| matches!(m, Method::Contact(_));
    let is_slow = |m: &Method| m.differentiates_dynamics() || (m.is_derived() && !of_contacts(m));
    let few = SMALL[usize::from(everything())];
    let fits = |m: &Method| size <= few || !is_slow(m);
    let wanted = |m: &Method| fits(m) && !repeats(m);
    let methods = Method::possible_of(&graph).into_iter().filter(wanted);
    let methods = methods.map(|m| m.name_in(closed, &graph.sites)).collect();
    let options = Options {
        methods: Some(methods),
        ..Options::default()
    };
    model_of(&text, &stem, &options)
}

/// Compares every path whose index leaves this remainder: the tests run side by side. In `float` small ones only.
fn compare(part: usize) {
    for path in paths().iter().skip(part).step_by(4) {
        let model = whole_model(path);
        assert!(model.functions.len() > 9, "{path}");
        check::<f64>(&name(path), &model);
        if is_small(&model) {
            check::<f32>(&name(path), &model);
        }
    }
}

fn is_small(model: &Model) -> bool {
    let graph = &model.bond_graph;
    let closed = graph.closed.as_deref();
    closed.map_or(graph.coordinates.len(), |c| c.tree.coordinates.len()) <= 5
}

#[test]
#[ignore = "minutes of compiling: .ci/long"]
fn large_mechanisms_in_float() {
    let models = paths().into_iter().map(|path| {
        let model = whole_model(&path);
        (path, model)
    });
    for (path, model) in models.filter(|(_, model)| !is_small(model)) {
        check::<f32>(&name(&path), &model);
    }
}

#[test]
fn every_method_of_part_0() {
    compare(0);
}

#[test]
fn every_method_of_part_1() {
    compare(1);
}

#[test]
fn every_method_of_part_2() {
    compare(2);
}

#[test]
fn every_method_of_part_3() {
    compare(3);
}

//! The generator's own check accepts mechanisms with loops, with every method, and refuses wrong functions.

use bgdyn_codegen::formulation;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::pipeline::{model, verify};
use bgdyn_codegen::refusal::Refusal;
use bgdyn_codegen::verify::{check_functions, explain};

use super::references::spec;
use super::robot::{Robot, Way};

const PLANAR: [&str; 4] = [
    "five_bar",
    "four_bar",
    "slider_crank",
    "slider_crank_near_singular",
];

fn options(way: Way) -> Options {
    Options {
        derivatives: true,
        formulation: way.map(|name| formulation::by_name(name).expect("a formulation")),
        ..Options::default()
    }
}

fn whole(text: &str, way: Way) -> Model {
    model(Robot::read(text).mechanism, &options(way)).expect("a model")
}

fn accept(name: &str, way: Way) {
    let model = whole(&spec(name), way);
    match verify(&model, &options(way)) {
        Ok(()) => {}
        Err(Refusal::Unequal(found)) => panic!("{name}, {way:?}: {}", explain(&found)),
        Err(refusal) => panic!("{name}, {way:?}: {refusal:?}"),
    }
}

#[test]
fn planar_loops_are_accepted_with_every_formulation() {
    for name in PLANAR {
        for way in [None, Some("recursion"), Some("subspaces"), Some("literal")] {
            accept(name, way);
        }
    }
}

#[test]
fn the_delta_robot_is_accepted() {
    accept("delta_robot", None);
}

/// Each output of each function with its sign changed.
#[test]
fn a_turned_sign_is_refused_in_every_function() {
    let model = whole(&spec("five_bar"), None);
    for function in &model.functions {
        for k in 0..function.blocks[0].outputs.len() {
            let mut wrong = function.clone();
            let output = &mut wrong.blocks[0].outputs[k];
            if wrong.graph.constant_of(*output).is_some() {
                continue;
            }
            output.negative = !output.negative;
            let found = check_functions("five_bar", &model.bond_graph, &[wrong]);
            assert_eq!(found.len(), 1, "{} output {k}", function.name);
        }
    }
}

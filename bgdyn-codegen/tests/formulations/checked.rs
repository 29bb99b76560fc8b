//! Checks every function of a model as it is checked before it is written, and that the check finds a turned sign.

use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::selection::model;
use bgdyn_codegen::verify::{check_functions, check_model, explain};

use crate::common::Robot;

/// Returns the model of a robot; fails if one of its functions differs from equation (6).
pub fn checked(robot: &Robot, options: &Options, what: &str) -> Model {
    let model = model(robot.mechanism.clone(), options).expect("a model");
    let found = check_model(&model);
    assert!(found.is_empty(), "{what}\n{}", explain(&found));
    model
}

/// Returns the options that ask for these methods alone.
pub fn only(robot: &Robot, methods: &[Method]) -> Options {
    let sites = &robot.graph.sites;
    let names = methods.iter().map(|method| method.name(sites));
    Options {
        methods: Some(names.collect()),
        ..Options::default()
    }
}

/// Returns the model with these methods; fails if one of them is missing or differs from equation (6).
pub fn checked_methods(robot: &Robot, methods: &[Method], what: &str) -> Model {
    let model = checked(robot, &only(robot, methods), what);
    assert_eq!(model.functions.len(), methods.len(), "{what}");
    model
}

/// Returns the multiplications and additions of these methods, in the emitted form; zero for those that the mechanism
/// does not have.
pub fn counted<const N: usize>(robot: &Robot, methods: [Method; N]) -> [usize; N] {
    let possible = Method::possible_of(robot.graph);
    methods.map(|method| {
        if !possible.contains(&method) {
            return 0;
        }
        let operations = robot.emitted(method).operations();
        operations.mul + operations.add
    })
}

/// Fails if the check does not find the turned sign of an output. `is_read` says of which outputs: not of those that are
/// zero, nor of those that only say whether the result is finite.
pub fn every_turned_sign_is_refused(model: &Model, is_read: impl Fn(&Function, usize) -> bool) {
    let mut turned = 0;
    for function in &model.functions {
        for k in (0..function.output_count()).filter(|&k| is_read(function, k)) {
            let mut wrong: Function = function.clone();
            let last = wrong.blocks.last_mut().expect("a block");
            let output = &mut last.outputs[k];
            if wrong.graph.constant_of(*output).is_some() {
                continue;
            }
            output.negative = !output.negative;
            let found = check_functions("turned", &model.bond_graph, &[wrong]);
            assert_eq!(found.len(), 1, "{} output {k}", function.name);
            turned += 1;
        }
    }
    assert!(turned >= model.functions.len());
}

/// Returns the mechanisms of a folder of the repository, with their texts, by name.
pub fn of_folder(folder: &str) -> Vec<(String, String)> {
    let folder = format!("{}/../{folder}", env!("CARGO_MANIFEST_DIR"));
    let entries = std::fs::read_dir(folder).expect("the folder of specs");
    let paths = entries.map(|entry| entry.expect("a file").path());
    let mut specs: Vec<(String, String)> = paths
        .filter(|path| path.extension().is_some_and(|end| end == "yaml"))
        .map(|path| {
            let text = std::fs::read_to_string(&path).expect("a spec");
            let stem = path.file_stem().and_then(|stem| stem.to_str());
            (stem.expect("a name").to_owned(), text)
        })
        .collect();
    specs.sort();
    assert!(!specs.is_empty());
    specs
}

/// Returns the loops that are checked quickly.
pub fn quick_loops() -> Vec<(String, String)> {
    let quick = ["four_bar", "five_bar", "slider_crank", "rssr", "six_bar"];
    let mut specs = of_folder("specs/loops");
    specs.retain(|(name, _)| quick.contains(&&name[..]));
    assert_eq!(specs.len(), quick.len());
    specs
}

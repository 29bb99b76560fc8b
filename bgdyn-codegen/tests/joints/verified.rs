//! The generator's own check: it accepts every mechanism of these tests, and refuses wrong functions.

use bgdyn_codegen::formulation;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::selection::model;
use bgdyn_codegen::verify::{check_functions, check_model, explain};
use bgdyn_runtime::Dd;

use super::robot::{Robot, WAYS, Way};
use super::specs;

fn options(way: Way) -> Options {
    Options {
        derivatives: true,
        formulation: way.map(|name| formulation::by_name(name).expect("a formulation")),
        ..Options::default()
    }
}

/// What `model` returns, of functions that are made once for all tests.
fn whole(text: &str, way: Way) -> Model {
    let robot = Robot::read(text);
    let methods = options(way).select(&robot.graph).expect("methods");
    let functions = methods
        .into_iter()
        .map(|m| (*robot.function(way, m)).clone());
    Model {
        assembles: false,
        functions: functions.collect(),
        bundles: Vec::new(),
        base_parameters: Vec::new(),
        bond_graph: (*robot.graph).clone(),
        mechanism: robot.mechanism,
    }
}

#[test]
fn every_mechanism_is_accepted() {
    for (name, text) in specs::all() {
        for way in WAYS {
            let model = whole(&text, way);
            let found = check_model(&model);
            assert!(found.is_empty(), "{name}, {way:?}: {}", explain(&found));
        }
    }
}

/// Quaternions of any length are verified as those of length 1 are.
#[test]
fn quaternions_of_any_length_are_accepted() {
    for text in [specs::ZOO, specs::TOWER] {
        let any = text.replace("type: spherical", "type: spherical, quaternion: any");
        let any = any.replace("type: floating", "type: floating, quaternion: any");
        assert_ne!(any, text);
        let model = whole(&any, None);
        assert_eq!(check_model(&model), []);
    }
}

/// Each output of each function with its sign changed.
#[test]
fn a_turned_sign_is_refused_in_every_function() {
    for (name, text) in [
        ("zoo", specs::ZOO),
        ("loops", specs::LOOPS),
        ("tower", specs::TOWER),
    ] {
        let robot = Robot::read(text);
        let model = whole(text, None);
        let state = robot.state(41);
        let mut turned = 0;
        for function in &model.functions {
            let mut refused = |wrong: Function, k: usize| {
                let found = check_functions(name, &model.bond_graph, std::slice::from_ref(&wrong));
                assert_eq!(
                    found.len(),
                    1,
                    "{name}, {}, output {k} passes",
                    function.name
                );
                turned += 1;
            };
            if let Some(loops) = &function.loops {
                // Columns of a result that one piece of code computes.
                for (i, group) in loops.groups.iter().enumerate() {
                    let varying = |k: &usize| group.graph.constant_of(group.outputs[*k]).is_none();
                    for k in (0..group.outputs.len()).filter(varying).step_by(3) {
                        let mut wrong = function.clone();
                        let loops = wrong.loops.as_mut().expect("as before");
                        let output = &mut loops.groups[i].outputs[k];
                        output.negative = !output.negative;
                        refused(wrong, k);
                    }
                }
                continue;
            }
            let values = state.value(function);
            let sized: Vec<usize> = (0..values.len())
                .filter(|&k| values[k].to_f64().abs() > 1e-9)
                .collect();
            if sized.is_empty() {
                // A place that never accelerates: zeros by construction.
                let outputs = &function.blocks.last().expect("a block").outputs;
                let mut constants = outputs.iter().map(|e| function.graph.constant_of(*e));
                assert!(
                    constants.all(|x| x == Some(Dd::ZERO)),
                    "{name}, {}",
                    function.name
                );
            }
            // Every output of short functions, every seventh of long ones, and the last.
            let step = if sized.len() > 30 { 7 } else { 1 };
            let last = sized.last().copied();
            for k in sized.into_iter().step_by(step).chain(last) {
                let mut wrong = function.clone();
                let outputs = &mut wrong.blocks.last_mut().expect("a block").outputs;
                outputs[k].negative = !outputs[k].negative;
                refused(wrong, k);
            }
        }
        assert!(turned > 100, "{turned}");
    }
}

#[test]
fn a_turned_sign_is_a_difference_of_that_function_alone() {
    for name in specs::GOLDEN {
        let text = super::robot::golden_text(&format!("{name}.yaml"));
        let options = Options::default();
        let mut model = model(Robot::read(&text).mechanism, &options).expect("a model");
        let wrong = model
            .functions
            .iter_mut()
            .find(|f| f.name == "bias")
            .expect("a bias");
        let outputs = &mut wrong.blocks.last_mut().expect("a block").outputs;
        let varying = outputs
            .iter_mut()
            .find(|e| wrong.graph.constant_of(**e).is_none());
        let output = varying.expect("an output that varies");
        output.negative = !output.negative;
        let found = check_model(&model);
        let functions = found.iter().map(|f| f.function.as_str());
        assert_eq!(functions.collect::<Vec<_>>(), ["bias"], "{name}");
    }
}

/// The functions of a mechanism that differs by one number.
#[test]
fn functions_of_another_mechanism_are_refused() {
    for (text, of, by) in [
        (specs::ZOO, "lead: -70 mm", "lead: 70 mm"),
        (specs::ZOO, "lead: -70 mm", "lead: -70.0000001 mm"),
        (specs::ZOO, "ratio: -1.7", "ratio: -1.7000000001"),
        (specs::ZOO, "offset: 0.3", "offset: 0.3000000001"),
        (
            specs::ZOO,
            "rpy: [0.6, 0.1, -0.4]",
            "rpy: [0.6, 0.1, -0.4000000001]",
        ),
        (
            specs::TOWER,
            "axis2: [-1, 2, 0.5]",
            "axis2: [-1, 2, 0.500000001]",
        ),
        (specs::TOWER, "axis: [1, 2, 5]", "axis: [1, 2, 5.000000001]"),
        (specs::LOOPS, "offset: 20 deg", "offset: 20.0000001 deg"),
        (specs::LOOPS, "ratio: 30 mm/rad", "ratio: 30.0000001 mm/rad"),
    ] {
        let other = text.replace(of, by);
        assert_ne!(other, text);
        let right = Robot::read(text);
        let functions: Vec<Function> = whole(&other, None).functions;
        let found = check_functions("other", &right.graph, &functions);
        let names: Vec<&str> = found.iter().map(|d| d.function.as_str()).collect();
        for function in ["inverse_dynamics", "bias", "forward_dynamics"] {
            assert!(names.contains(&function), "{by}: only {names:?}");
        }
        assert_eq!(
            check_functions("same", &right.graph, &whole(text, None).functions),
            []
        );
    }
}

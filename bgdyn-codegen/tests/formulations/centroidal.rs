//! Tests centroidal methods and the rate of the mass matrix: equal to their definitions on random trees, coupled joints,
//! joints of every type and loops; relations between them; counts of operations.

use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::{Centroidal, Method};
use bgdyn_codegen::options::Options;
use bgdyn_codegen::selection::model;
use bgdyn_codegen::verify::{check_functions, check_model, explain};

use crate::common::random::Draft;
use crate::common::rng::Rng;
use crate::common::{Robot, golden};

fn methods(robot: &Robot) -> Vec<Method> {
    let centroidal = Method::centroidal_of(robot.graph).unwrap_or_default();
    let rate = Method::mass_matrix_rate_of(robot.graph).ok();
    centroidal.into_iter().chain(rate).collect()
}

fn options(robot: &Robot) -> Options {
    let names = methods(robot).into_iter().map(|method| method.name(&[]));
    Options {
        methods: Some(names.collect()),
        ..Options::default()
    }
}

fn passes(robot: &Robot, what: &str) {
    let options = options(robot);
    let model = model(robot.mechanism.clone(), &options).expect("a model");
    assert_eq!(model.functions.len(), methods(robot).len(), "{what}");
    let found = check_model(&model);
    assert!(found.is_empty(), "{what}\n{}", explain(&found));
}

/// Mechanisms of a folder of specs.
fn of_folder(folder: &str) -> Vec<(String, Robot)> {
    let folder = format!("{}/../specs/{folder}", env!("CARGO_MANIFEST_DIR"));
    let entries = std::fs::read_dir(folder).expect("the folder of specs");
    let paths = entries.map(|entry| entry.expect("a file").path());
    let specs = paths.filter(|path| path.extension().is_some_and(|end| end == "yaml"));
    specs
        .map(|path| {
            let text = std::fs::read_to_string(&path).expect("a spec");
            let stem = path.file_stem().and_then(|stem| stem.to_str());
            (path.display().to_string(), Robot::read(&text, stem))
        })
        .collect()
}

#[test]
fn random_trees_equal_the_definitions() {
    let mut rng = Rng::new(211);
    for _ in 0..24 {
        let text = Draft::random(&mut rng, 6).yaml();
        passes(&Robot::read(&text, None), &text);
    }
}

#[test]
fn golden_robots_equal_the_definitions() {
    for (name, robot) in golden::robots_up_to(8) {
        passes(&robot, &name);
    }
}

#[test]
fn every_turned_sign_is_refused() {
    let robot = golden::robot("puma560");
    let model = model(robot.mechanism.clone(), &options(&robot)).expect("a model");
    for function in &model.functions {
        for k in 0..function.output_count() {
            let mut wrong: Function = function.clone();
            let last = wrong.blocks.last_mut().expect("a block");
            let output = &mut last.outputs[k];
            if wrong.graph.constant_of(*output).is_some() {
                continue;
            }
            output.negative = !output.negative;
            let found = check_functions("puma560", &model.bond_graph, &[wrong]);
            assert_eq!(found.len(), 1, "{} output {k}", function.name);
        }
    }
}

/// Multiplications and additions by robot, before loops and blocks: centroidal map, momentum, its rate, Jacobian of the
/// centre of mass, centre of mass, rate of the mass matrix.
const COUNTS: [(&str, [usize; 6]); 6] = [
    ("scara_rrpr", [122, 132, 121, 22, 26, 27]),
    ("stanford_gen", [325, 253, 420, 94, 43, 396]),
    ("puma_gen", [369, 309, 462, 101, 49, 525]),
    ("ur5_gen", [333, 303, 415, 80, 49, 391]),
    ("panda_gen", [501, 368, 603, 175, 57, 767]),
    ("iiwa_gen", [483, 345, 572, 175, 57, 669]),
];

#[test]
fn counts_do_not_grow() {
    let methods = [
        Method::Centroidal(Centroidal::Map),
        Method::Centroidal(Centroidal::Momentum),
        Method::Centroidal(Centroidal::Bias),
        Method::Centroidal(Centroidal::Jacobian),
        Method::Centroidal(Centroidal::Centre),
        Method::MassMatrixRate,
    ];
    let counted = COUNTS.map(|(name, _)| {
        let robot = golden::robot(name);
        let counts = methods.map(|of| {
            let function = robot.emitted(of);
            let operations = function.operations();
            assert_eq!(operations.div + operations.sqrt, 0);
            operations.mul + operations.add
        });
        (name, counts)
    });
    assert_eq!(counted, COUNTS);
}

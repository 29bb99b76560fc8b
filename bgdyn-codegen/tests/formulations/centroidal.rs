//! Tests centroidal methods and the rate of the mass matrix: equal to their definitions on random trees, coupled joints,
//! joints of every type and loops; relations between them; counts of operations.

use bgdyn_codegen::formulation::by_name;
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

/// Returns the mechanisms of a folder, with their texts.
fn of_folder(folder: &str) -> Vec<(String, String)> {
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
    specs
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

/// Robots on a base whose motion is given, and with joints of every type.
#[test]
fn joints_of_every_type_equal_the_definitions() {
    let specs = of_folder("tests/golden/joints");
    assert!(specs.len() > 5);
    for (name, text) in specs {
        passes(&Robot::read(&text, Some(&name)), &name);
    }
    for (name, text) in of_folder("specs") {
        passes(&Robot::read(&text, Some(&name)), &name);
        let on_given_base = text.replacen("format: 1\n", "format: 1\nbase: given\n", 1);
        assert_ne!(text, on_given_base);
        if !text.contains("base:") {
            passes(
                &Robot::read(&on_given_base, Some(&name)),
                &format!("{name}, given base"),
            );
        }
    }
}

/// Mimics, gears, prescribed joints and wheels.
#[test]
fn constrained_mechanisms_equal_the_definitions() {
    let specs = of_folder("specs/constraints");
    assert!(specs.len() > 8);
    for (name, text) in specs {
        passes(&Robot::read(&text, Some(&name)), &name);
    }
}

/// The columns of the open tree, combined by the map of the loops.
#[test]
fn loops_equal_the_definitions() {
    let specs = of_folder("specs/loops");
    let quick = ["four_bar", "five_bar", "slider_crank", "rssr", "six_bar"];
    for (name, text) in specs.iter().filter(|(name, _)| quick.contains(&&name[..])) {
        passes(&Robot::read(text, Some(name)), name);
    }
}

/// Base parameters do not change the total momentum: with each body's own inertia it is the same.
#[test]
fn own_inertia_has_the_same_momentum() {
    for name in ["scara4", "puma560", "panda7", "dpend2"] {
        let robot = golden::robot(name);
        for of in ["recursion_own", "literal"] {
            let options = Options {
                formulation: by_name(of),
                ..options(&robot)
            };
            let model = model(robot.mechanism.clone(), &options).expect("a model");
            assert!(
                model
                    .functions
                    .iter()
                    .any(|f| f.formulation.starts_with(of))
            );
            let found = check_model(&model);
            assert!(found.is_empty(), "{name}, {of}\n{}", explain(&found));
        }
    }
}

const MASSLESS: &str = "format: 1
name: massless
links:
  - name: base
    mass: 3
  - name: arm
    parent: base
    joint: { name: turn, type: revolute, axis: y }
    inertia: { xx: 1, yy: 1, zz: 1 }
    nonphysical: allow
";

/// A link that is fixed to the world has a mass, but it does not move.
#[test]
fn without_a_mass_there_is_no_centre() {
    let robot = Robot::read(MASSLESS, None);
    let why = Method::named(robot.graph, "centroidal_map").expect_err("no mass");
    assert!(
        why.starts_with("`centroidal_map`: no link that a joint moves has a mass"),
        "{why}"
    );
    assert!(Method::named(robot.graph, "mass_matrix_rate").is_ok());
    let has_mass = MASSLESS.replace("    inertia: { xx", "    mass: 1\n    inertia: { xx");
    let robot = Robot::read(&has_mass, None);
    assert!(Method::named(robot.graph, "centroidal_map").is_ok());
}

/// Multiplications and additions by robot, before loops and blocks: centroidal map, momentum, its rate, Jacobian of the
/// centre of mass, centre of mass, rate of the mass matrix.
const COUNTS: [(&str, [usize; 6]); 6] = [
    ("scara_rrpr", [122, 126, 115, 22, 26, 27]),
    ("stanford_gen", [320, 253, 414, 94, 43, 396]),
    ("puma_gen", [364, 309, 456, 101, 49, 525]),
    ("ur5_gen", [328, 303, 409, 80, 49, 391]),
    ("panda_gen", [496, 368, 597, 175, 57, 767]),
    ("iiwa_gen", [478, 345, 566, 175, 57, 669]),
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

//! Tests centroidal methods and the rate of the mass matrix: equal to their definitions on random trees, coupled joints,
//! joints of every type and loops; relations between them; counts of operations.

use bgdyn_codegen::formulation::by_name;
use bgdyn_codegen::method::{Centroidal, Method};
use bgdyn_codegen::options::Options;

use crate::checked::{
    checked, checked_methods, every_turned_sign_is_refused, of_folder, only, quick_loops,
};
use crate::common::random::Draft;
use crate::common::rng::Rng;
use crate::common::{Robot, golden};

fn methods(robot: &Robot) -> Vec<Method> {
    let centroidal = Method::centroidal_of(robot.graph).unwrap_or_default();
    let rate = Method::mass_matrix_rate_of(robot.graph).ok();
    centroidal.into_iter().chain(rate).collect()
}

fn passes(robot: &Robot, what: &str) {
    checked_methods(robot, &methods(robot), what);
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
fn turned_signs_are_refused() {
    let robot = golden::robot("puma560");
    let model = checked_methods(&robot, &methods(&robot), "puma560");
    every_turned_sign_is_refused(&model, |_, _| true);
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
    for (name, text) in quick_loops() {
        passes(&Robot::read(&text, Some(&name)), &name);
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
                ..only(&robot, &methods(&robot))
            };
            let model = checked(&robot, &options, &format!("{name}, {of}"));
            let mut functions = model.functions.iter();
            assert!(functions.any(|f| f.formulation.starts_with(of)));
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

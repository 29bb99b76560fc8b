//! The generator's own check accepts mechanisms with wheels and knife edges, with every method, and refuses wrong
//! functions.

use bgdyn_codegen::formulation;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::selection::model;
use bgdyn_codegen::verify::{check_model, explain};

use super::files::spec;
use super::planar_references::ROBOT;
use super::random_mechanisms::{Text, Touch};
use super::robot::{Robot, Way};
use super::turned_signs::assert_turned_signs_are_refused;

const PLANAR: [&str; 3] = ["chaplygin_sleigh", "differential_drive", "snakeboard"];
const SPATIAL: [&str; 2] = ["rolling_disc", "whipple_bicycle"];

fn options(way: Way) -> Options {
    Options {
        formulation: way.map(|name| formulation::by_name(name).expect("a formulation")),
        ..Options::default()
    }
}

fn accepted(text: &str, way: Way) -> Model {
    let model = model(Robot::read(text).mechanism, &options(way)).expect("a model");
    let found = check_model(&model);
    assert!(found.is_empty(), "{way:?}: {}\n{text}", explain(&found));
    model
}

#[test]
fn the_specs_are_accepted_with_every_formulation() {
    for name in PLANAR {
        for way in [None, Some("subspaces"), Some("literal")] {
            accepted(&spec(name), way);
        }
    }
    for name in SPATIAL {
        for way in [None, Some("subspaces")] {
            accepted(&spec(name), way);
        }
    }
}

/// The methods that are generated if they are asked for, with a ball as well.
#[test]
fn methods_on_request_are_accepted() {
    let mut random = Random(31);
    let mut ball = Text::new(&mut random, "type: floating", 1);
    ball.touch(&mut random, 0, Touch::Ball);
    let names = [
        "constraint_bias",
        "constrained_dynamics",
        "project_velocity",
        "reactions",
        "joint_reactions",
    ];
    let options = Options {
        methods: Some(names.map(String::from).to_vec()),
        ..Options::default()
    };
    let texts = PLANAR.into_iter().chain(SPATIAL).map(spec);
    for text in texts.chain([ball.constrained()]) {
        let model = model(Robot::read(&text).mechanism, &options).expect("a model");
        assert_eq!(model.functions.len(), names.len());
        let found = check_model(&model);
        assert!(found.is_empty(), "{}\n{text}", explain(&found));
    }
}

/// Each output of each function with its sign changed.
#[test]
fn a_turned_sign_is_refused_in_every_function() {
    let model = accepted(&spec("snakeboard"), None);
    assert_turned_signs_are_refused("snakeboard", &model);
}

/// Beside a moving base, run-time parameters, a loop, and on a plane that another joint moves.
#[test]
fn other_features_beside_them_are_accepted() {
    let given = ROBOT.replacen("links:", "base: given\nlinks:", 1);
    let parameter = ROBOT.replace("mass: 10", "mass: { parameter: load, value: 10 }");
    let table = "  - name: table
    joint: { name: turntable, type: continuous, axis: [0.1, 0.2, 1] }
    mass: 4
    inertia: { xx: 0.3, yy: 0.3, zz: 0.5 }
  - name: cart
    parent: table
";
    let on_table = ROBOT
        .replace("  - name: cart\n", table)
        .replace("radius: 0.1", "radius: 0.1, on: deck")
        .replace(
            "constraints:",
            "planes:\n  deck: { link: table }\nconstraints:",
        )
        .replace("[right, left]", "[turntable, right, left]");
    // A rod from the wheel moves a piston.
    let piston = "  - name: piston
    parent: cart
    joint: { name: stroke, type: prismatic, axis: x, origin: { xyz: [0.2, -0.25, 0.01] } }
    mass: 0.3
constraints:";
    let rod = "loops:
  - { name: rod, type: distance, length: 0.2, a: { link: piston }, b: { link: right_wheel, origin: { xyz: [0.05, 0, 0] } } }
independent: [right, left]
";
    let looped = ROBOT
        .replace("constraints:", piston)
        .replace("independent: [right, left]\n", rod);
    for text in [given, parameter, on_table, looped] {
        assert_ne!(text, ROBOT);
        accepted(&text, None);
    }
}

#[test]
fn rows_in_general_position_are_accepted() {
    let mut random = Random(900);
    let mut text = Text::new(&mut random, "type: floating", 2);
    text.touch(&mut random, 0, Touch::Ball);
    text.wheel(&mut random, 2, Touch::Longitudinal);
    text.touch(&mut random, 1, Touch::Edge);
    accepted(&text.constrained(), None);
    let mut text = Text::new(&mut random, "type: floating", 2);
    text.touch(&mut random, 0, Touch::Ellipsoid);
    text.wheel(&mut random, 2, Touch::LongitudinalTyre);
    accepted(&text.constrained(), None);
}

/// Along the velocities of the open tree, with each sign of each entry turned as well.
#[test]
fn derivatives_are_accepted() {
    let derivatives = Options {
        methods: Some(vec![
            "inverse_dynamics_derivatives".into(),
            "forward_dynamics_derivatives".into(),
        ]),
        ..Options::default()
    };
    let mut random = Random(32);
    let mut ball = Text::new(&mut random, "type: floating", 1);
    ball.touch(&mut random, 0, Touch::Ball);
    let texts = PLANAR.into_iter().chain(["rolling_disc"]).map(spec);
    for text in texts.chain([ball.constrained()]) {
        let model = model(Robot::read(&text).mechanism, &derivatives).expect("a model");
        assert_eq!(model.functions.len(), 2);
        let found = check_model(&model);
        assert!(found.is_empty(), "{}\n{text}", explain(&found));
        assert_turned_signs_are_refused("derivatives", &model);
    }
}

/// Without wheels there is no position equation: nothing closes, and no method says so.
#[test]
fn nothing_closes_without_rows_of_positions() {
    for name in PLANAR {
        let model = accepted(&spec(name), None);
        let mut methods = model.functions.iter().map(|f| f.method);
        assert!(
            !methods.any(|m| matches!(m, Method::ClosingStep | Method::ConstraintResidual)),
            "{name}"
        );
    }
}

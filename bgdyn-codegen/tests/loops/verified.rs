//! The generator's own check accepts mechanisms with loops, with every method, and refuses wrong functions.

use bgdyn_codegen::formulation;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::{Options, Preference};
use bgdyn_codegen::selection::model;
use bgdyn_codegen::verify::{check_model, explain};

use super::actuated::actuated;
use super::references::spec;
use super::robot::{Robot, Way};
use super::turned_signs::assert_turned_signs_are_refused;

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
    let found = check_model(&model);
    assert!(found.is_empty(), "{name}, {way:?}: {}", explain(&found));
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

/// The methods that are generated if they are asked for.
pub const ON_REQUEST: [&str; 5] = [
    "constraint_bias",
    "constrained_dynamics",
    "project_velocity",
    "reactions",
    "joint_reactions",
];

fn on_request(text: &str, way: Way) -> Model {
    let options = Options {
        methods: Some(ON_REQUEST.map(String::from).to_vec()),
        derivatives: false,
        ..options(way)
    };
    let model = model(Robot::read(text).mechanism, &options).expect("a model");
    assert_eq!(model.functions.len(), ON_REQUEST.len());
    let found = check_model(&model);
    assert!(found.is_empty(), "{way:?}: {}\n{text}", explain(&found));
    model
}

#[test]
fn methods_on_request_are_accepted_with_every_formulation() {
    for name in PLANAR {
        for way in [None, Some("recursion"), Some("subspaces"), Some("literal")] {
            on_request(&spec(name), way);
        }
    }
    on_request(&spec("delta_robot"), None);
    let given = spec("five_bar").replacen("links:", "base: given\nlinks:", 1);
    let mass = "mass: { parameter: rod_mass, value: 0.5 }";
    let parameters = spec("five_bar").replace("mass: 0.5", mass);
    for text in [given, parameters] {
        on_request(&text, None);
    }
}

#[test]
fn a_turned_sign_is_refused_in_methods_on_request() {
    let model = on_request(&spec("five_bar"), None);
    assert_turned_signs_are_refused("five_bar", &model);
}

/// Each output of each function with its sign changed.
#[test]
fn a_turned_sign_is_refused_in_every_function() {
    let model = whole(&spec("five_bar"), None);
    assert_turned_signs_are_refused("five_bar", &model);
}

/// Loops beside other features: a moving base, run-time parameters, joints that follow others inside of the loop.
#[test]
fn loops_with_other_features_are_accepted() {
    let five_bar = spec("five_bar");
    let given = five_bar.replacen("links:", "base: given\nlinks:", 1);
    let parameters = five_bar.replace("mass: 0.5", "mass: { parameter: rod_mass, value: 0.5 }");
    // The second crank follows the first one by a gear, and by `mimic`: one velocity is left.
    let gear = "constraints:\n  belt: { type: gear, joints: { proximal2_angle: 2, proximal1_angle: -1 } }\nloops:";
    let one_crank = five_bar.replace(", proximal2_angle: 1.1", "");
    let geared = one_crank.replacen("loops:", gear, 1).replace(
        "independent: [proximal1_angle, proximal2_angle]",
        "independent: [proximal1_angle]",
    );
    let mimicked = one_crank
        .replace(
            "{ name: proximal2_angle, type: continuous,",
            "{ name: proximal2_angle, type: continuous, mimic: { joint: proximal1_angle, ratio: 0.5 },",
        )
        .replace("independent: [proximal1_angle, proximal2_angle]", "independent: [proximal1_angle]");
    for (what, text) in [
        ("a given base", given),
        ("parameters", parameters),
        ("a gear", geared),
        ("mimic", mimicked),
    ] {
        assert_ne!(text, five_bar, "{what}");
        for way in [None, Some("subspaces")] {
            let model = whole(&text, way);
            let found = check_model(&model);
            assert!(found.is_empty(), "{what}, {way:?}: {}", explain(&found));
        }
    }
}

/// `prefer: accuracy` has every method, without closed forms, and the generator's check accepts them.
#[test]
fn the_most_accurate_functions_are_accepted() {
    let most_accurate = Options {
        prefer: Preference::Accuracy,
        ..Options::default()
    };
    let mechanism = Robot::read(&spec("slider_crank")).mechanism;
    let usual = model(mechanism.clone(), &Options::default()).expect("a model");
    let model = model(mechanism, &most_accurate).expect("a model");
    assert_eq!(model.functions.len(), usual.functions.len());
    let closed = |model: &Model| {
        let mut functions = model.functions.iter();
        functions.any(|f| f.formulation.contains("closed form"))
    };
    assert_eq!([&usual, &model].map(closed), [true, false]);
    assert_eq!(check_model(&model), []);
}

/// Actuated joints other than the independent ones: as many, more with limits, fewer.
#[test]
fn methods_of_actuated_joints_are_accepted_and_turned_signs_refused() {
    let cranks = ["proximal1_angle", "proximal2_angle"];
    let rods = ["distal1_angle", "distal2_angle"];
    let three = ["proximal1_angle", "distal1_angle", "distal2_angle"];
    let names = |drives: &[&str]| {
        let both = [
            "inverse_dynamics",
            "forward_dynamics",
            "reduced_inverse_dynamics",
            "reactions",
            "joint_reactions",
        ];
        let few = drives.len() < 2;
        let all = both
            .into_iter()
            .filter(|name| !few || *name != "inverse_dynamics");
        all.map(String::from).collect::<Vec<String>>()
    };
    for drives in [&rods[..], &three[..], &rods[..1]] {
        let text = actuated("five_bar", &cranks, drives);
        for way in [None, Some("recursion"), Some("subspaces"), Some("literal")] {
            let model = whole(&text, way);
            assert_eq!(check_model(&model), [], "{drives:?}, {way:?}");
            let named = |name: &str| model.functions.iter().any(|f| f.name == name);
            assert_eq!(named("inverse_dynamics"), drives.len() > 1);
            for name in [
                "forward_dynamics",
                "reduced_inverse_dynamics",
                "reduced_forward_dynamics",
                "reduced_inverse_dynamics_derivatives",
            ] {
                assert!(named(name), "{name}");
            }
        }
        let asked = Options {
            methods: Some(names(drives)),
            ..Options::default()
        };
        let model = model(Robot::read(&text).mechanism, &asked).expect("a model");
        assert_eq!(model.functions.len(), names(drives).len());
        assert_eq!(check_model(&model), []);
        assert_turned_signs_are_refused("five_bar", &model);
    }
}

#[test]
fn methods_that_actuated_joints_exclude_are_named_with_a_way_out() {
    let text = actuated(
        "five_bar",
        &["proximal1_angle", "proximal2_angle"],
        &["distal1_angle"],
    );
    let asked = Options {
        methods: Some(vec!["inverse_dynamics".into()]),
        ..Options::default()
    };
    let refused = model(Robot::read(&text).mechanism, &asked).err();
    let refused = refused.expect("one drive for two velocities");
    assert_eq!(refused.len(), 1);
    let words = "reduced_inverse_dynamics";
    assert!(refused[0].message.contains(words), "{}", refused[0]);
}

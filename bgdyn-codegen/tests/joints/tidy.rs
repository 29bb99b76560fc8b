//! Tidy mechanisms, as people write them: bodies that are round about an axis, centres of mass on axes, joint
//! origins along axes with quarter turns. Special cases of the generator depend on such zeros and equal
//! numbers; random numbers never meet them.

use bgdyn_codegen::formulation;
use bgdyn_codegen::method::{Centroidal, Regressor};
use bgdyn_codegen::options::Options;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::selection::model;
use bgdyn_codegen::verify::{check_model, explain};

use super::robot::{Robot, Way};

const WAYS: [Way; 4] = [
    None,
    Some("recursion"),
    Some("articulated_base"),
    Some("subspaces"),
];

/// Joint types with their keys.
const JOINTS: [&str; 12] = [
    "type: revolute, axis: z",
    "type: revolute, axis: x",
    "type: revolute, axis: -y",
    "type: prismatic, axis: y",
    "type: prismatic, axis: -z",
    "type: spherical",
    "type: spherical",
    "type: floating",
    "type: planar",
    "type: cylindrical, axis: x",
    "type: universal, axis: x, axis2: y",
    "type: helical, axis: z, lead: 20 mm",
];

/// Centres of mass on an axis, in a plane, or at the origin.
const CENTRES: [&str; 6] = [
    "[0, 0, 0]",
    "[0, 0, -0.7]",
    "[0.3, 0, 0]",
    "[0, -0.2, 0]",
    "[0, 0, 0.4]",
    "[0.2, 0, 0.1]",
];

/// Spheres, rods, discs, a box.
const TENSORS: [&str; 6] = [
    "{ xx: 0.03, yy: 0.03, zz: 0.03 }",
    "{ xx: 0.08, yy: 0.08, zz: 0.002 }",
    "{ xx: 0.002, yy: 0.08, zz: 0.08 }",
    "{ xx: 0.05, yy: 0.05, zz: 0.1 }",
    "{ xx: 0.1, yy: 0.05, zz: 0.05 }",
    "{ xx: 0.04, yy: 0.05, zz: 0.07 }",
];

const ORIGINS: [&str; 6] = [
    "",
    ", origin: { xyz: [1.6, 0, 0] }",
    ", origin: { xyz: [0, 0, 0.5] }",
    ", origin: { xyz: [0, -0.3, 0], rpy: [90 deg, 0, 0] }",
    ", origin: { xyz: [0.4, 0, 0.2], rpy: [0, -90 deg, 0] }",
    ", origin: { rpy: [180 deg, 0, 90 deg] }",
];

fn one_of<'a>(random: &mut Random, list: &[&'a str]) -> &'a str {
    let at = (random.signed() + 1.0) / 2.0 * list.len() as f64;
    list[(at as usize).min(list.len() - 1)]
}

/// A tree of three or four links.
fn tidy(seed: u64) -> String {
    let mut random = Random(seed);
    let moving_base = random.signed() > 0.6;
    let mut text = String::from("format: 1\nname: tidy\n");
    if moving_base {
        text += "base: given\n";
    }
    text += "links:\n";
    for i in 0..3 + usize::from(random.signed() > 0.5) {
        let mut some = |list| one_of(&mut random, list);
        let (joint, origin) = (some(&JOINTS), some(&ORIGINS));
        let (com, tensor) = (some(&CENTRES), some(&TENSORS));
        let branches = random.signed() > 0.6;
        let parent = match i {
            0 => String::new(),
            1 => "    parent: l0\n".into(),
            i => format!("    parent: l{}\n", if branches { i - 2 } else { i - 1 }),
        };
        text += &format!(
            "  - name: l{i}\n{parent}    joint: {{ name: j{i}, {joint}{origin} }}\n    mass: {}\n    com: {com}\n    inertia: {tensor}\n",
            i + 1
        );
    }
    text
}

/// Checks all regressors of joints of every type, on bases at rest and moving ones.
fn has_regressors(seed: u64) {
    let text = tidy(seed);
    let robot = Robot::read(&text);
    let options = Options {
        methods: Some(Vec::new()),
        identification: true,
        ..Options::default()
    };
    let model = model(robot.mechanism, &options).expect("a model");
    assert_eq!(model.functions.len(), Regressor::ALL.len());
    let found = check_model(&model);
    assert!(found.is_empty(), "{text}\n{}", explain(&found));
}

/// Checks the centroidal methods of joints of every type, on bases at rest and moving ones.
fn has_a_momentum(seed: u64) {
    let text = tidy(seed);
    let robot = Robot::read(&text);
    let names = Centroidal::ALL.map(|of| of.name().to_owned());
    let options = Options {
        methods: Some(names.to_vec()),
        ..Options::default()
    };
    let model = model(robot.mechanism, &options).expect("a model");
    assert_eq!(model.functions.len(), Centroidal::ALL.len());
    let found = check_model(&model);
    assert!(found.is_empty(), "{text}\n{}", explain(&found));
}

#[test]
fn tidy_mechanisms_have_momenta() {
    (0..24).for_each(has_a_momentum);
}

#[test]
fn tidy_mechanisms_have_regressors() {
    (0..24).for_each(has_regressors);
}

#[test]
#[ignore = "a long run, see `.ci/long`"]
fn three_hundred_tidy_mechanisms_have_regressors() {
    (1000..1300).for_each(has_regressors);
}

fn accepted(seed: u64) {
    let text = tidy(seed);
    let robot = Robot::read(&text);
    for way in WAYS {
        let chosen = way.map(|name| formulation::by_name(name).expect("a formulation"));
        let options = Options {
            formulation: chosen,
            derivatives: seed.is_multiple_of(8),
            ..Options::default()
        };
        if chosen.is_some_and(|f| !f.serves(&robot.graph)) {
            continue;
        }
        let model = model(robot.mechanism.clone(), &options).expect("a model");
        let found = check_model(&model);
        assert!(found.is_empty(), "{text}\n{way:?}: {}", explain(&found));
    }
}

#[test]
fn tidy_mechanisms_are_accepted() {
    (0..16).for_each(accepted);
}

#[test]
#[ignore = "a long run, see `.ci/long`"]
fn five_hundred_tidy_mechanisms_are_accepted() {
    (1000..1500).for_each(accepted);
}

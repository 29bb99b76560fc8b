//! Loads through joints of mechanisms without loops: the generator's own check for joints of every type, and free bodies
//! with links that are welded to their parents.

use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::selection::model;
use bgdyn_codegen::verify::{check_model, explain};
use bgdyn_runtime::Dd;

use super::free_bodies::assert_free_bodies;
use super::robot::{Robot, WAYS};
use super::specs;

#[test]
fn joints_of_every_type_are_accepted() {
    for (name, text) in specs::all() {
        let prescribed = text.contains("prescribed");
        for way in WAYS.into_iter().filter(|way| !prescribed || way.is_none()) {
            let options = Options {
                methods: Some(vec!["joint_reactions".into()]),
                formulation: way
                    .map(|name| bgdyn_codegen::formulation::by_name(name).expect("a formulation")),
                ..Options::default()
            };
            let model = model(Robot::read(&text).mechanism, &options).expect("a model");
            let found = check_model(&model);
            assert!(found.is_empty(), "{name}, {way:?}: {}", explain(&found));
        }
    }
}

/// A post that is fixed to the ground, a slide, an arm with a flange that is welded to it, a wrist on the flange.
const ARM: &str = "format: 1
name: arm
gravity: [0.3, -0.4, -9.7]
links:
  - name: post
    joint: { name: bolts, type: fixed, origin: { xyz: [0.1, -0.2, 0.3], rpy: [0.2, 0.1, -0.3] } }
    mass: 3
    com: [0.05, 0.02, 0.4]
    inertia: { xx: 0.3, yy: 0.2, zz: 0.15, xy: 0.02 }
  - name: carriage
    parent: post
    joint: { name: slide, type: prismatic, axis: [0.3, 0.1, 1], origin: { xyz: [0, 0.1, 0.5] } }
    mass: 1.2
    com: [0.01, 0.03, -0.02]
    inertia: { xx: 0.02, yy: 0.03, zz: 0.025 }
  - name: arm
    parent: carriage
    joint: { name: shoulder, type: continuous, axis: [0.2, -0.3, 1], origin: { xyz: [0.1, 0, 0.1], rpy: [0.4, 0, 0] } }
    mass: 0.8
    com: [0.2, 0.01, 0.02]
    inertia: { xx: 0.01, yy: 0.03, zz: 0.025, xz: 0.002 }
  - name: flange
    parent: arm
    joint: { name: weld, type: fixed, origin: { xyz: [0.4, 0, 0.05], rpy: [0.1, -0.7, 0.2] } }
    mass: 0.3
    com: [0.01, 0.02, 0.03]
    inertia: { xx: 0.001, yy: 0.002, zz: 0.0015 }
  - name: hand
    parent: flange
    joint: { name: wrist, type: continuous, axis: y, origin: { xyz: [0.05, 0, 0] } }
    mass: 0.5
    com: [0.1, -0.02, 0.03]
    inertia: { xx: 0.002, yy: 0.004, zz: 0.003, yz: 0.0005 }
";

#[test]
fn links_of_an_arm_are_free_bodies() {
    let robot = Robot::read(ARM);
    for seed in 0..3 {
        let state = robot.state(seed);
        for way in WAYS {
            let value = |method| -> Vec<Dd> { state.value(&robot.function(way, method)) };
            let (joints, efforts) = (
                value(Method::JointReactions),
                value(Method::InverseDynamics),
            );
            let all = (&joints[..], &[][..], &efforts[..]);
            assert_free_bodies(
                &robot,
                &state,
                all,
                1e-17,
                &format!("state {seed}, {way:?}"),
            );
        }
    }
}

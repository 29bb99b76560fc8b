//! Tests full rotors anywhere: on a link inboard of their own joint, on the one that it moves, outboard,
//! on another branch; alone and with other effects.

use bgdyn_codegen::choice::Choice;
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::random::Random;
use std::fmt::Write;

use super::common::{scene, state};
use super::random::Draft;
use super::rng::Rng;
use super::{forms, laws};
use bgdyn_codegen::formulation::{Prepared, by_name};
use bgdyn_codegen::method::Method;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::Dd;

/// A chain of three joints and a branch from the first link, one of them prismatic.
const TREE: &str = "\
format: 1
links:
  - name: upper
    joint: { name: shoulder, type: revolute, axis: z }
    mass: 2
    com: [0.2, 0, 0]
    inertia: { xx: 0.01, yy: 0.05, zz: 0.05 }
  - name: fore
    parent: upper
    joint: { name: elbow, type: revolute, axis: y, origin: { xyz: [0.4, 0, 0] } }
    mass: 1
    com: [0.15, 0, 0]
    inertia: { xx: 0.005, yy: 0.02, zz: 0.02 }
  - name: hand
    parent: fore
    joint: { name: wrist, type: revolute, axis: -y, origin: { xyz: [0.3, 0, 0.1] } }
    mass: 0.5
    com: [0.05, 0, 0.02]
    inertia: { xx: 0.001, yy: 0.002, zz: 0.002 }
  - name: mast
    parent: upper
    joint: { name: lift, type: prismatic, axis: [1, 0, 2], origin: { xyz: [0, 0.2, 0] } }
    mass: 0.7
    com: [0.05, 0.01, 0.02]
    inertia: { xx: 0.002, yy: 0.002, zz: 0.002 }
  - name: head
    parent: mast
    joint: { name: nod, type: revolute, axis: x, origin: { xyz: [0, 0, 0.3] } }
    mass: 0.4
    com: [0, 0.05, 0.02]
    inertia: { xx: 0.001, yy: 0.002, zz: 0.002 }
";

const JOINTS: [&str; 5] = ["shoulder", "elbow", "wrist", "lift", "nod"];
const LINKS: [&str; 5] = ["upper", "fore", "hand", "mast", "head"];

fn with_rotors(rotors: &[(&str, &str)]) -> SceneEquations {
    let mut text = "scene: 1\nmechanism: tree.yaml\neffects:\n  - inertia\n  - velocity_products\n  - gravity\n".to_owned();
    for (k, (joint, on)) in rotors.iter().enumerate() {
        let axis = [[1.0, 2.0, 0.5], [0.0, -1.0, 0.25], [0.3, 0.0, 0.0]][k % 3];
        writeln!(text, "  - motor_{k}: {{ type: rotor, joint: {joint}, inertia: 2e-4, ratio: 80, on: {on}, axis: {axis:?} }}").unwrap();
    }
    scene(&text, TREE)
}

/// M, the inverse and its slopes by the recursion equal those of the literal sum.
fn equals_the_literal_sum(system: &SceneEquations) {
    let prepared = Prepared::new(&system.graph);
    let literal = Choice::new(&system.graph, by_name("literal"));
    let states: Vec<Inputs<Dd>> = (0..4)
        .map(|seed| {
            let mut at = state(system, &mut Random(seed), true);
            at.u = at.a.iter().map(|&a| a * Dd::from_f64(0.7)).collect();
            at
        })
        .collect();
    for method in [
        Method::MassMatrix,
        Method::Bias,
        Method::InverseDynamics,
        Method::KineticEnergy,
        Method::CoriolisMatrix,
        Method::InverseDynamicsDerivatives,
        Method::ForwardDynamics,
    ] {
        let literal = literal.function(method).expect("the literal sum");
        for name in ["recursion", "recursion_own", "subspaces"] {
            let way = by_name(name).expect("a formulation");
            if !way.knows(method) {
                continue;
            }
            let found = way.function(&prepared, method).expect("a function");
            for at in &states {
                let (wanted, _) = literal.evaluate(at.clone());
                let (found, refused) = found.evaluate(at.clone());
                assert!(refused.is_none());
                let size = wanted.iter().map(|x| x.to_f64().abs()).fold(1.0, f64::max);
                for (i, (found, wanted)) in found.iter().zip(&wanted).enumerate() {
                    let off = (*found - *wanted).to_f64().abs() / size;
                    assert!(
                        off < 1e-22,
                        "{name}, {method:?}, entry {i}: {found:?}, not {wanted:?}"
                    );
                }
            }
        }
    }
}

/// Every joint's rotor on every link: inboard of its joint, at it, outboard, on the other branch.
#[test]
fn a_rotor_on_any_link_is_as_in_the_literal_sum() {
    for joint in JOINTS {
        for on in LINKS {
            equals_the_literal_sum(&with_rotors(&[(joint, on)]));
        }
    }
}

/// Rotors of one joint on several links, and of several joints on one link.
#[test]
fn rotors_on_several_links_are_as_in_the_literal_sum() {
    equals_the_literal_sum(&with_rotors(&[
        ("elbow", "upper"),
        ("elbow", "hand"),
        ("elbow", "head"),
    ]));
    equals_the_literal_sum(&with_rotors(&[
        ("wrist", "fore"),
        ("elbow", "fore"),
        ("nod", "fore"),
    ]));
    equals_the_literal_sum(&with_rotors(&[
        ("lift", "hand"),
        ("shoulder", "head"),
        ("wrist", "hand"),
    ]));
}

#[test]
fn a_rotor_on_any_link_keeps_the_laws_and_the_jacobian() {
    for (joint, on) in [
        ("elbow", "upper"),
        ("wrist", "fore"),
        ("elbow", "fore"),
        ("elbow", "hand"),
        ("shoulder", "hand"),
        ("wrist", "head"),
        ("nod", "fore"),
        ("lift", "head"),
    ] {
        let system = with_rotors(&[(joint, on)]);
        laws::hold(&system);
        forms::hold(&system);
    }
}

/// Number of random scenes.
const TRIED: u64 = 10;

/// Effects of a random scene: full rotors on random links and about random axes, and some of all effects
/// that need no particular joints.
fn effects(rng: &mut Rng, draft: &Draft) -> String {
    let moving: Vec<&str> = (draft.links.iter())
        .filter(|l| l.joint.kind != "fixed")
        .map(|l| l.name.trim_start_matches("link_"))
        .collect();
    let link = |rng: &mut Rng| rng.pick(&draft.links).name.clone();
    let mut list: Vec<String> = Vec::new();
    // Enough inertia on each joint that M is positive definite for any links.
    for k in &moving {
        list.push(format!(
            "held_{k}: {{ type: rotor, joint: joint_{k}, inertia: 2e-3, ratio: 40 }}"
        ));
    }
    for i in 0..1 + rng.below(3) {
        let axis = [0; 3].map(|_| rng.within(1.0));
        let (k, on) = (*rng.pick(&moving), link(rng));
        list.push(format!(
            "full_{i}: {{ type: rotor, joint: joint_{k}, inertia: 2e-3, ratio: {}, on: {on}, axis: {axis:?} }}",
            20 + rng.below(80)
        ));
    }
    let (k, at) = (*rng.pick(&moving), link(rng));
    let others = [
        "gravity".to_owned(),
        "velocity_products".to_owned(),
        "inertia".to_owned(),
        format!("oil: {{ type: viscous, joint: joint_{k}, damping: 0.3 }}"),
        format!("dry: {{ type: coulomb, joint: joint_{k}, kinetic: 2, static: 3 }}"),
        format!("wind: {{ type: drag, at: {at}, linear: 3, quadratic: 5, angular: 1 }}"),
        format!("push: {{ type: wrench, at: {at}, axes: link }}"),
        "rope: { type: spring, between: [pole, hook], stiffness: 8, rest: 2 }".to_owned(),
    ];
    let share = [0.8, 0.8, 0.9, 0.5, 0.4, 0.4, 0.4, 0.5];
    let chosen = others.into_iter().zip(share);
    list.extend(
        chosen
            .filter(|(_, share)| rng.chance(*share))
            .map(|(e, _)| e),
    );
    list.iter().map(|e| format!("  - {e}\n")).collect()
}

#[test]
fn random_scenes_with_full_rotors_keep_the_laws_and_the_jacobian() {
    for seed in 0..TRIED {
        let mut rng = Rng::new(4200 + seed);
        let mut draft = Draft::random(&mut rng, 5);
        draft
            .frames
            .push("{ name: pole, link: world, origin: { xyz: [40, 30, 20] } }".into());
        // Off every axis of a link that moves, so that the rope's length changes.
        let last = draft.links.iter().rfind(|l| l.joint.kind != "fixed");
        let last = last.expect("a moving link");
        let hook = format!(
            "{{ name: hook, link: {}, origin: {{ xyz: [0.31, 0.17, -0.23] }} }}",
            last.name
        );
        draft.frames.push(hook);
        let text = format!(
            "scene: 1\nmechanism: random.yaml\neffects:\n{}",
            effects(&mut rng, &draft)
        );
        // Shown where the test fails.
        println!("{}{text}", draft.yaml());
        let system = scene(&text, &draft.yaml());
        assert!(system.scene.layout.nv() > 0);
        equals_the_literal_sum(&system);
        laws::hold(&system);
        forms::hold(&system);
    }
}

/// Accelerations by every formulation equal those of the literal sum.
fn moves_as_the_literal_sum(system: &SceneEquations) {
    let by = |name: &str| system.derivative_by(by_name(name).expect("a formulation"));
    let literal = by("literal").expect("the literal sum");
    for name in [
        "recursion",
        "recursion_own",
        "articulated",
        "articulated_base",
    ] {
        let way = by(name).expect("rotors that sit on no link are known to all");
        for seed in 0..4 {
            let at = state(system, &mut Random(seed), true);
            let (wanted, _) = literal.evaluate(at.clone());
            let (found, refused) = way.evaluate(at);
            assert!(refused.is_none());
            let size = wanted.iter().map(|x| x.to_f64().abs()).fold(1.0, f64::max);
            for (i, (found, wanted)) in found.iter().zip(&wanted).enumerate() {
                let off = (*found - *wanted).to_f64().abs() / size;
                assert!(off < 1e-20, "{name}, rate {i}: {found:?}, not {wanted:?}");
            }
        }
    }
}

/// A rotor behind a gear makes the projection along its joint incomplete, so that the inboard joints move
/// more of the outboard inertia: tested one at a time on a tree, and on every joint of random mechanisms.
#[test]
fn rotors_behind_gears_are_felt_by_the_joints_before() {
    let scene_of = |joints: &[&str], mechanism: &str| {
        let rotor = |joint: &&str| {
            format!("  - of_{joint}: {{ type: rotor, joint: {joint}, inertia: 2e-4, ratio: 40 }}\n")
        };
        let rotors: String = joints.iter().map(rotor).collect();
        scene(
            &format!(
                "scene: 1\nmechanism: random.yaml\neffects:\n  - inertia\n  - velocity_products\n  - gravity\n{rotors}"
            ),
            mechanism,
        )
    };
    for joint in JOINTS {
        moves_as_the_literal_sum(&scene_of(&[joint], TREE));
    }
    for seed in 0..TRIED {
        let draft = Draft::random(&mut Rng::new(4300 + seed), 5);
        let moving = draft.links.iter().filter(|l| l.joint.kind != "fixed");
        let joints: Vec<String> = moving
            .map(|l| format!("joint_{}", l.name.trim_start_matches("link_")))
            .collect();
        let joints: Vec<&str> = joints.iter().map(String::as_str).collect();
        let mechanism = draft.yaml();
        println!("{mechanism}");
        moves_as_the_literal_sum(&scene_of(&joints, &mechanism));
    }
}

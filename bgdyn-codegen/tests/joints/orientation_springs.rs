//! Springs between two orientations: the moment and the potential in closed form, the same law as a hold, the
//! generator's own check, what is refused.

use bgdyn_codegen::bond_graph::{Causality, NodeKind};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::read_scene;
use bgdyn_codegen::refusal::Refusal;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_codegen::verify::{check_scene, explain};
use bgdyn_runtime::Dd;
use bgdyn_runtime::manifold::spherical;

use super::findings::with_joints;
use super::scenes::{BALL, FREE};

/// A frame in the world and one on the first link, both turned.
const FRAMES: &str = "frames:\n  - { name: seat, link: world, origin: { rpy: [20 deg, 0, 50 deg] } }\n  - { name: plate, link: l0, origin: { xyz: [0.1, 0, 0], rpy: [0, 30 deg, 10 deg] } }\n";

fn read(joints: &[&str], effects: &str, keys: &str) -> Result<SceneEquations, Refusal> {
    let mechanism = with_joints(joints) + FRAMES;
    let scene = format!(
        "scene: 1\nmechanism: arm.yaml\neffects: [inertia, velocity_products{effects}]\n{keys}\n"
    );
    read_scene(&scene, "scene", |_| Ok(mechanism.clone())).map(|(system, _)| system)
}

fn scene(joints: &[&str], effects: &str, keys: &str) -> SceneEquations {
    read(joints, effects, keys).unwrap_or_else(|e| panic!("{effects}: {e:?}"))
}

/// A state with unit quaternions.
fn state(system: &SceneEquations, seed: u64) -> Inputs<Dd> {
    let layout = &system.scene.layout;
    let mut random = Random(seed);
    let mut some =
        |n: usize| -> Vec<Dd> { (0..n).map(|_| Dd::from_f64(random.signed())).collect() };
    let (mut q, v) = (some(layout.nq()), some(layout.nv()));
    layout.normalize(&mut q);
    Inputs {
        q,
        v,
        u: vec![Dd::ZERO; layout.inputs.len()],
        t: Some(Dd::ZERO),
        ..Inputs::default()
    }
}

fn values(system: &SceneEquations, role: SceneFunction, at: &Inputs<Dd>) -> Vec<Dd> {
    let (found, refused) = system.function(role).evaluate(at.clone());
    assert!(refused.is_none(), "{role:?}: {refused:?}");
    found
}

fn close(found: &[Dd], wanted: &[Dd], what: &str) {
    assert_eq!(found.len(), wanted.len(), "{what}");
    for (i, (found, wanted)) in found.iter().zip(wanted).enumerate() {
        let off = (*found - *wanted).to_f64().abs();
        assert!(
            off < 1e-26 * wanted.to_f64().abs().max(1.0),
            "{what}, {i}: {found:?}, not {wanted:?}"
        );
    }
}

/// On a ball joint from the axes of the world it is the law of a hold with one stiffness.
#[test]
fn a_spring_is_a_hold_that_the_scene_stores() {
    let axes = "frames:\n  - { name: seat, link: world }\n";
    let mechanism = with_joints(&[BALL]) + axes;
    let with = |keys: &str| {
        let scene = format!("scene: 1\nmechanism: arm.yaml\n{keys}\n");
        let read = read_scene(&scene, "scene", |_| Ok(mechanism.clone()));
        read.unwrap_or_else(|e| panic!("{keys}: {e:?}")).0
    };
    let spring = with(
        "effects: [inertia, velocity_products, k: { type: orientation_spring, between: [seat, l0], stiffness: 7, damping: 2 }]",
    );
    let hold = with(
        "effects: [inertia, velocity_products]\ninputs: { ball: { hold: { attitude: { target: { rpy: [0, 0, 0] }, stiffness: 7, damping: 2 } } } }",
    );
    for seed in 0..20 {
        let at = state(&spring, seed);
        let mut driven = at.clone();
        driven.u = vec![Dd::ZERO; 3];
        driven.u = values(&hold, SceneFunction::Inputs, &driven);
        close(
            &values(&spring, SceneFunction::Derivative, &at),
            &values(&hold, SceneFunction::Derivative, &driven),
            "derivative",
        );
    }
}

/// The energy is k (1 − cos θ) of the turn between two bodies.
#[test]
fn the_potential_is_that_of_the_angle_between_two_bodies() {
    let effect = ", k: { type: orientation_spring, between: [l0, l1], stiffness: 7 }";
    let second = "name: other, type: spherical";
    let system = scene(&[BALL, second], effect, "");
    for seed in 0..20 {
        let at = state(&system, seed);
        let part = |from: usize| -> [Dd; 4] { std::array::from_fn(|i| at.q[from + i]) };
        let turn = spherical::difference(part(4), part(0));
        let square = turn.into_iter().fold(Dd::ZERO, |sum, x| sum + x * x);
        let (_, cosine) = square.sqrt().sin_cos();
        let wanted = Dd::from_f64(7.0) * (Dd::ONE - cosine);
        let energy = values(&system, SceneFunction::Energy, &at);
        close(&energy[..1], &[wanted], "energy");
    }
}

/// The generator's check: equation (6), the balance of power with the rate of the potential, the Jacobian. The
/// bond graph has causal strokes without a conflict.
#[test]
fn springs_between_any_two_places_are_verified() {
    let hinge = "name: hinge, type: revolute, axis: y";
    for (joints, between) in [
        (&[BALL][..], "[seat, plate]"),
        (&[BALL], "[plate, seat]"),
        (&[FREE, BALL], "[plate, l1]"),
        (&[hinge, FREE], "[l1, plate]"),
    ] {
        let effect = format!(
            ", k: {{ type: orientation_spring, between: {between}, stiffness: 7, damping: 2 }}"
        );
        let system = scene(joints, &effect, "");
        let roles = system.roles_with(true, false).into_iter();
        let functions: Vec<Function> = roles.map(|role| system.function(role)).collect();
        let found = check_scene(&system, &functions);
        assert!(found.is_empty(), "{between}: {}", explain(&found));
        let causality = Causality::of(&system.network);
        assert!(causality.conflicts.is_empty(), "{between}");
        assert!(causality.loops.is_empty(), "{between}");
        let kinds = system.network.nodes.iter().filter(|n| n.element.is_some());
        let count = |kind| kinds.clone().filter(|node| node.kind == kind).count();
        assert_eq!(
            [count(NodeKind::Compliance), count(NodeKind::Resistor)],
            [1, 1]
        );
    }
}

/// Places that do not turn against each other are reported; a slide does not turn anything.
#[test]
fn a_spring_between_places_that_do_not_turn_is_idle() {
    let slide = "name: slide, type: prismatic, axis: y";
    let effect = ", k: { type: orientation_spring, between: [seat, plate], stiffness: 7 }";
    let system = scene(&[slide], effect, "");
    let idle: Vec<&str> = system.idle().iter().map(|e| e.name.as_str()).collect();
    assert_eq!(idle, ["k"]);
    let mechanism = with_joints(&[slide]) + FRAMES;
    let text = format!("scene: 1\nmechanism: arm.yaml\neffects: [inertia{effect}]\n");
    let (_, findings) =
        read_scene(&text, "scene", |_| Ok(mechanism.clone())).expect("a sound scene");
    let said: Vec<&str> = findings.0.iter().map(|f| f.message.as_str()).collect();
    let expected =
        "`k` does nothing: no joint moves `plate` against `seat` in a direction in which it acts";
    assert_eq!(said, [expected]);
}

#[test]
fn numbers_and_places_are_checked() {
    let rule = |effect: &str| match read(&[BALL], &format!(", k: {{ {effect} }}"), "") {
        Err(Refusal::Spec(faults)) => faults.0[0].rule,
        other => panic!("{effect}: {:?}", other.map(|_| "accepted")),
    };
    let kind = "type: orientation_spring";
    assert_eq!(
        rule(&format!("{kind}, between: [seat, l0], stiffness: -1")),
        "effect-sign"
    );
    assert_eq!(
        rule(&format!(
            "{kind}, between: [seat, l0], stiffness: 1, damping: -1"
        )),
        "effect-sign"
    );
    assert_eq!(rule(&format!("{kind}, between: [seat, l0]")), "missing-key");
    assert_eq!(rule(&format!("{kind}, stiffness: 1")), "missing-key");
    assert_eq!(
        rule(&format!("{kind}, between: [seat, l0], stiffness: 1 N/m")),
        "unit-misfit"
    );
    assert_eq!(
        rule(&format!("{kind}, between: [seat, l9], stiffness: 1")),
        "unknown-name"
    );
}

//! Scenes of mechanisms with constraints: an effect on a joint that follows several others adds Sᵀ of what it adds
//! in the open tree; locks; what such joints refuse.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::read_scene;
use bgdyn_codegen::refusal::Refusal;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_codegen::verify::{check_scene, explain};
use bgdyn_runtime::Dd;

use super::findings::with_joints;

const JOINTS: [&str; 3] = [
    "name: left, type: revolute, axis: y",
    "name: right, type: continuous, axis: [1, 0, 1], origin: { xyz: [0.2, 0, 0.1] }",
    "name: slide, type: prismatic, axis: [1, 2, 0]",
];
/// slide = 0.25 left + 0.125 right − 0.05 m
const GEAR: &str = "type: gear, joints: { left: 1, right: 1/2, slide: -4 rad/m }, offset: 0.2";
const LINEAR: &str = "type: linear, row: { left: 1, right: 1/2, slide: -4 rad/m }";
const S: [[f64; 2]; 3] = [[1.0, 0.0], [0.0, 1.0], [0.25, 0.125]];

const EFFECTS: [&str; 8] = [
    "type: viscous, joint: slide, damping: 0.4",
    "type: damper, joint: slide, damping: 3",
    "type: spring, joint: slide, stiffness: 80, rest: 0.1, preload: 2",
    "type: coulomb_smooth, joint: slide, kinetic: 3, width: 0.5",
    "type: stribeck, joint: slide, kinetic: 3, static: 4, stribeck_speed: 0.5, width: 0.05",
    "type: lugre, joint: slide, stiffness: 40, damping: 2, viscous: 3, kinetic: 3, static: 4, stribeck_speed: 0.5",
    "type: stop, joint: slide, stiffness: 800, restitution: 0.5, impact_speed: 1, lower: -0.02, upper: 0.08",
    "type: series_elastic, joint: slide, stiffness: 80, damping: 2, inertia: 1e-2, ratio: 5",
];

fn read(constraint: Option<&str>, effects: &str, keys: &str) -> Result<SceneEquations, Refusal> {
    let scene = format!(
        "scene: 1\nmechanism: arm.yaml\neffects: [inertia, velocity_products, gravity{effects}]\n{keys}\n"
    );
    let own = constraint.map(|c| format!("constraints:\n  c: {{ {c} }}\n"));
    let mechanism = with_joints(&JOINTS) + &own.unwrap_or_default();
    read_scene(&scene, "scene", |_| Ok(mechanism.clone())).map(|(system, _)| system)
}

fn scene(constraint: Option<&str>, effect: &str) -> SceneEquations {
    let read = read(constraint, &format!(", e: {{ {effect} }}"), "");
    read.unwrap_or_else(|e| panic!("{effect}: {e:?}"))
}

/// Returns each effect with each constraint: on positions, and on velocities only.
fn each() -> impl Iterator<Item = (&'static str, &'static str)> {
    let effects = |constraint| EFFECTS.into_iter().map(move |effect| (constraint, effect));
    [GEAR, LINEAR].into_iter().flat_map(effects)
}

/// The rate of the third position is that of its velocity.
#[test]
fn a_position_of_its_own_has_the_rate_of_its_velocity() {
    let system = scene(Some(LINEAR), EFFECTS[0]);
    let [own, tree] = states(&system, 3);
    let rates = values(&system, SceneFunction::PositionRates, own.clone());
    let rates_of_all = values(&system, SceneFunction::Derivative, own);
    for (found, wanted) in rates.iter().zip(&tree.v) {
        assert!((*found - *wanted).to_f64().abs() < 1e-30);
    }
    assert_eq!(rates_of_all.last(), rates.get(2));
    assert!(!system.roles().contains(&SceneFunction::ClosingStep));
}

fn values(system: &SceneEquations, role: SceneFunction, at: Inputs<Dd>) -> Vec<Dd> {
    let (found, refused) = system.function(role).evaluate(at);
    assert!(refused.is_none(), "{role:?}: {refused:?}");
    found
}

/// S u, with what follows the joints unchanged.
fn mapped(u: &[Dd]) -> Vec<Dd> {
    let of = |row: &[f64; 2]| Dd::from_f64(row[0]) * u[0] + Dd::from_f64(row[1]) * u[1];
    S.iter().map(of).chain(u[2..].iter().copied()).collect()
}

/// A state of the scene with the constraint, and the same of the open tree.
fn states(one: &SceneEquations, seed: u64) -> [Inputs<Dd>; 2] {
    let layout = &one.scene.layout;
    let mut random = Random(seed);
    let mut some = |n: usize, size: f64| -> Vec<Dd> {
        (0..n)
            .map(|_| Dd::from_f64(size * random.signed()))
            .collect()
    };
    let own = Inputs {
        q: some(layout.nq(), 0.4),
        v: some(layout.nv(), 0.6),
        a: some(layout.nv(), 2.0),
        x: some(layout.nx(), 0.05),
        u: some(layout.inputs.len(), 0.7),
        modes: vec![Dd::ONE; layout.modes.len()],
        parameters: vec![],
        t: Some(Dd::ZERO),
        passed: vec![],
    };
    // With a constraint on velocities only, the third position is its own.
    let free = layout.positions.iter().any(|p| p.name == "slide");
    let mut q = own.q.clone();
    if !free {
        q = mapped(&own.q);
        q[2] -= Dd::from_f64(5.0) / Dd::from_f64(100.0);
    }
    let tree = Inputs {
        q,
        v: mapped(&own.v),
        a: mapped(&own.a),
        ..own.clone()
    };
    [own, tree]
}

#[test]
fn effects_on_a_joint_that_follows_two_act_on_both() {
    for (constraint, effect) in each() {
        let (one, open) = (scene(Some(constraint), effect), scene(None, effect));
        for seed in 0..4 {
            let [own, tree] = states(&one, seed);
            let found = values(&one, SceneFunction::Inverse, own.clone());
            let full = values(&open, SceneFunction::Inverse, tree.clone());
            let mut wanted: Vec<Dd> = (0..2)
                .map(|j| {
                    let terms = S
                        .iter()
                        .zip(&full)
                        .map(|(row, &p)| Dd::from_f64(row[j]) * p);
                    terms.fold(Dd::ZERO, |sum, x| sum + x)
                })
                .collect();
            wanted.extend(&full[3..]);
            assert_eq!(found.len(), wanted.len(), "{effect}");
            for (j, (&found, &wanted)) in found.iter().zip(&wanted).enumerate() {
                let off = (found - wanted).to_f64().abs();
                let size = 1.0 + wanted.to_f64().abs();
                assert!(off < 1e-25 * size, "{effect}, {j}: {off:e}");
            }
            let own_energy = values(&one, SceneFunction::Energy, own);
            let full_energy = values(&open, SceneFunction::Energy, tree);
            let size = full_energy
                .iter()
                .fold(1.0, |s: f64, x| s.max(x.to_f64().abs()));
            for (a, b) in own_energy.iter().zip(&full_energy) {
                assert!((*a - *b).to_f64().abs() < 1e-25 * size, "{effect}: energy");
            }
        }
    }
}

/// The generator's check: equation (6) under the laws, the balance of power, the Jacobian, the canonical form.
#[test]
fn coupled_scenes_are_verified() {
    for (constraint, effect) in each() {
        let system = scene(Some(constraint), effect);
        let roles = system.roles_with(true, true).into_iter();
        let functions: Vec<Function> = roles.map(|role| system.function(role)).collect();
        let found = check_scene(&system, &functions);
        assert!(found.is_empty(), "{effect}: {}", explain(&found));
    }
}

/// Asserts one fault whose text has these words.
fn refused((constraint, rule): (&str, &str), effects: &str, keys: &str, words: &[&str]) {
    let faults = match read(Some(constraint), effects, keys) {
        Err(Refusal::Spec(faults)) => faults,
        other => panic!("{effects}{keys}: {:?}", other.map(|_| "accepted")),
    };
    assert_eq!(faults.0.len(), 1, "{:?}", faults.0);
    let fault = &faults.0[0];
    let said = format!("{} {}", fault.message, fault.help.as_deref().unwrap_or(""));
    assert_eq!(fault.rule, rule, "{said}");
    for word in words {
        assert!(said.contains(word), "{word}: {said}");
    }
}

#[test]
fn effects_that_hold_a_joint_are_refused_on_one_that_follows_two() {
    for (keyword, effect) in [
        (
            "coulomb",
            ", e: { type: coulomb, joint: slide, kinetic: 3 N }",
        ),
        ("rotor", ", e: { type: rotor, joint: slide, inertia: 2 kg }"),
    ] {
        let words = [keyword, "`left`, `right`", "`independent`"];
        refused((GEAR, "follower"), effect, "", &words);
    }
}

#[test]
fn locks_of_coupled_joints() {
    let position = |system: &SceneEquations, joint: &str| {
        let links = system.scene.mechanism.links().iter();
        let mut joints = links.map(|link| &link.joint);
        joints
            .find(|own| own.name == joint)
            .expect("a joint")
            .origin
            .translation
    };
    let length = |system: &SceneEquations| {
        let p = position(system, "slide");
        p.dot(p).to_f64().sqrt()
    };
    // One leader locked: the follower keeps the other.
    let one = read(Some(GEAR), "", "lock: { left: 0.4 }").expect("a scene");
    assert_eq!(one.scene.mechanism.joint_names(), ["right"]);
    let (_, coupling, _) = one.scene.mechanism.followers().next().expect("a follower");
    assert_eq!(coupling.velocities.len(), 1);
    assert!((coupling.offset.to_f64() - 0.05).abs() < 1e-16);
    // Both locked: the follower is at 0.25 · 0.4 + 0.125 · 0.2 − 0.05.
    let lock = "lock: { left: 0.4, right: 0.2 }";
    let both = scene_of_four(lock);
    assert!((length(&both) - 0.075).abs() < 1e-15, "{}", length(&both));
    refused(
        (GEAR, "follower"),
        "",
        "lock: { slide: 0 }",
        &["`slide` follows `left`, `right`", "lock `left`, `right`"],
    );
}

#[test]
fn constraints_on_velocities_have_no_canonical_form() {
    let keys = "integration: { method: canonical_gauss2, step: 1 ms, end: 1 s }";
    let words = ["`slide`", "canonical_gauss2", "write `gauss2`"];
    refused((LINEAR, "canonical-of-constraints"), "", keys, &words);
}

/// The scene of the gear with a further joint, so that something moves.
fn scene_of_four(keys: &str) -> SceneEquations {
    let mut joints = JOINTS.to_vec();
    joints.push("name: free, type: revolute, axis: x");
    let mechanism = with_joints(&joints) + &format!("constraints:\n  c: {{ {GEAR} }}\n");
    let scene =
        format!("scene: 1\nmechanism: arm.yaml\neffects: [inertia, velocity_products]\n{keys}\n");
    let read = read_scene(&scene, "scene", |_| Ok(mechanism.clone())).map(|(system, _)| system);
    read.unwrap_or_else(|e| panic!("{keys}: {e:?}"))
}

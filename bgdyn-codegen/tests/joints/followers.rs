//! Effects on joints with `mimic`: they act as the same effects on the leader with the numbers converted by the
//! ratio.

use bgdyn_codegen::bond_graph::{Causality, NodeKind};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_codegen::verify::{check_scene, explain};
use bgdyn_runtime::Dd;

use super::scenes::{FOLLOWER, read, refused};

/// A joint that turns with the slide `grip` of the leader: 0.3 rad − 2.5 rad/m · q.
const TAIL: &str = "name: tail, type: revolute, axis: y, origin: { xyz: [0.2, 0.1, 0] }, mimic: { joint: grip, ratio: -2.5 rad/m, offset: 0.3 }";
/// A joint that slides with it: 1 cm + 1.5 q.
const SLIDE: &str =
    "name: tail, type: prismatic, axis: z, mimic: { joint: grip, ratio: 1.5, offset: 1 cm }";

/// The same effect on `tail` and on `grip`, with numbers that are converted by −2.5 rad/m and 0.3 rad.
const PAIRS: &[(&str, &str)] = &[
    (
        "type: viscous, joint: tail, damping: 0.4 N*m*s/rad",
        "type: viscous, joint: grip, damping: 2.5 N*s/m",
    ),
    (
        "type: viscous, joint: tail, damping: 0.4, reference: belt",
        "type: viscous, joint: grip, damping: 2.5, reference: belt",
    ),
    (
        "type: damper, joint: tail, damping: 0.4",
        "type: damper, joint: grip, damping: 2.5",
    ),
    (
        "type: spring, joint: tail, stiffness: 8 N*m/rad, rest: 0.8 rad, preload: 2 N*m",
        "type: spring, joint: grip, stiffness: 50 N/m, rest: -0.2 m, preload: -5 N",
    ),
    (
        "type: coulomb_smooth, joint: tail, kinetic: 3, width: 0.5 rad/s",
        "type: coulomb_smooth, joint: grip, kinetic: 7.5, width: 0.2 m/s",
    ),
    (
        "type: stribeck, joint: tail, kinetic: 3, static: 4, stribeck_speed: 0.5, width: 0.05",
        "type: stribeck, joint: grip, kinetic: 7.5, static: 10, stribeck_speed: 0.2, width: 0.02",
    ),
    (
        "type: coulomb, joint: tail, kinetic: 3 N*m, static: 4 N*m",
        "type: coulomb, joint: grip, kinetic: 7.5 N, static: 10 N",
    ),
    (
        "type: coulomb, joint: tail, kinetic: 3, reference: belt",
        "type: coulomb, joint: grip, kinetic: 7.5, reference: belt",
    ),
    (
        "type: stop, joint: tail, stiffness: 800, restitution: 0.5, impact_speed: 1, lower: -0.2, upper: 0.8",
        "type: stop, joint: grip, stiffness: 5000, restitution: 0.5, impact_speed: 0.4, lower: -0.2, upper: 0.2",
    ),
    (
        "type: lugre, joint: tail, stiffness: 40, damping: 2, viscous: 3, kinetic: 3, static: 4, stribeck_speed: 0.5",
        "type: lugre, joint: grip, stiffness: 250, damping: 12.5, viscous: 18.75, kinetic: 7.5, static: 10, stribeck_speed: 0.2",
    ),
    (
        "type: rotor, joint: tail, inertia: 1e-2 kg*m^2, ratio: 8",
        "type: rotor, joint: grip, inertia: 1e-2, ratio: 20",
    ),
    (
        "type: rotor, joint: tail, inertia: 1e-2, ratio: 8, on: l1, axis: [1, 0, 0]",
        "type: rotor, joint: grip, inertia: 1e-2, ratio: -20, on: l1, axis: [1, 0, 0]",
    ),
    (
        "type: dc_motor, joint: tail, resistance: 1, inductance: 1e-2, torque_constant: 0.05, ratio: 50, efficiency: 0.8",
        "type: dc_motor, joint: grip, resistance: 1, inductance: 1e-2, torque_constant: 0.05, ratio: -125, efficiency: 0.8",
    ),
    (
        "type: series_elastic, joint: tail, stiffness: 80, damping: 2, inertia: 1e-2, ratio: 5",
        "type: series_elastic, joint: grip, stiffness: 500, damping: 12.5, inertia: 6.25e-2, ratio: 5",
    ),
];

/// A scene of the slide and the joint `tail`, with this effect and inputs for what the effect adds.
fn scene(joint: &str, effect: &str) -> SceneEquations {
    let effects = format!(", e: {{ {effect} }}");
    let read = read(joint, &effects, "initial: { grip: 0.1, grip_rate: 0.4 }");
    read.unwrap_or_else(|e| panic!("{effect}: {e:?}"))
}

/// States of a scene: positions, velocities, first-order states, modes and inputs.
fn states(system: &SceneEquations) -> Vec<Inputs<Dd>> {
    let layout = &system.scene.layout;
    let mut random = Random(3);
    let mut all = Vec::new();
    for mode in [-1.0, 0.0, 1.0, 1.0, -1.0] {
        let mut some = |n: usize, size: f64| -> Vec<Dd> {
            (0..n)
                .map(|_| Dd::from_f64(size * random.signed()))
                .collect()
        };
        all.push(Inputs {
            q: some(layout.nq(), 0.4),
            v: some(layout.nv(), 0.6),
            a: some(layout.nv(), 2.0),
            x: some(layout.nx(), 0.05),
            u: some(layout.inputs.len(), 0.7),
            modes: vec![Dd::from_f64(mode); layout.modes.len()],
            parameters: vec![],
            t: Some(Dd::ZERO),
            passed: vec![],
        });
    }
    all
}

/// The state and inputs of the scene at the leader that belong to those of the scene at the follower: the moving
/// counterpart and the bristles in the leader's units, the drive of an elastic joint likewise.
fn converted(system: &SceneEquations, effect: &str, at: &Inputs<Dd>) -> Inputs<Dd> {
    let (ratio, offset) = (Dd::from_f64(-2.5), Dd::from_f64(3.0) / Dd::from_f64(10.0));
    let mut moved = at.clone();
    for (input, u) in system.scene.layout.inputs.iter().zip(&mut moved.u) {
        if input.name.starts_with("belt") {
            *u /= ratio;
        }
    }
    moved.x.iter_mut().for_each(|x| *x /= ratio);
    if effect.contains("series_elastic") {
        moved.q[1] = (moved.q[1] - offset) / ratio;
        moved.v[1] /= ratio;
        moved.a[1] /= ratio;
    }
    moved
}

fn values(system: &SceneEquations, role: SceneFunction, at: &Inputs<Dd>) -> Vec<Dd> {
    let (found, refused) = system.function(role).evaluate(at.clone());
    assert!(refused.is_none(), "{role:?}: {refused:?}");
    found
}

/// The part of a function's results that both scenes give in the same units.
fn shared(effect: &str, role: SceneFunction, mut found: Vec<Dd>) -> Vec<Dd> {
    let elastic = effect.contains("series_elastic");
    match role {
        // The rates of bristles, and of the drive of an elastic joint, are in the units of the joint.
        SceneFunction::Derivative if effect.contains("lugre") || elastic => found.truncate(1),
        SceneFunction::Inverse if elastic => found.truncate(1),
        // The event of bristles is the slip of the joint; that of a gear's load is its effort. The upper stop of
        // one is the lower stop of the other.
        SceneFunction::Events
            if ["lugre", "stop", "dc_motor"]
                .iter()
                .any(|e| effect.contains(e)) =>
        {
            found.clear();
        }
        _ => {}
    }
    found
}

#[test]
fn an_effect_acts_on_a_follower_as_a_converted_one_on_its_leader() {
    for (on_tail, on_grip) in PAIRS {
        let (tail, grip) = (scene(TAIL, on_tail), scene(TAIL, on_grip));
        let roles = tail.roles_with(true, true);
        assert_eq!(roles, grip.roles_with(true, true), "{on_tail}");
        for at in &states(&tail) {
            let moved = converted(&grip, on_tail, at);
            for role in [
                SceneFunction::Derivative,
                SceneFunction::Inverse,
                SceneFunction::Power,
                SceneFunction::Energy,
                SceneFunction::Events,
                SceneFunction::Contacts,
            ] {
                if !roles.contains(&role) {
                    continue;
                }
                let found = shared(on_tail, role, values(&tail, role, at));
                let wanted = shared(on_grip, role, values(&grip, role, &moved));
                assert_eq!(found.len(), wanted.len(), "{on_tail}, {role:?}");
                let size = wanted
                    .iter()
                    .fold(1.0, |size: f64, x| size.max(x.to_f64().abs()));
                for (i, (&found, &wanted)) in found.iter().zip(&wanted).enumerate() {
                    let off = (found - wanted).to_f64().abs();
                    assert!(
                        off < 1e-24 * size,
                        "{on_tail}, {role:?}, result {i}: {} instead of {}",
                        found.to_f64(),
                        wanted.to_f64()
                    );
                }
            }
        }
    }
}

/// The generator's check: equation (6) under the laws, the balance of power, the Jacobian, the canonical form.
#[test]
fn scenes_with_effects_on_followers_are_verified() {
    for (on_tail, _) in PAIRS {
        let system = scene(TAIL, on_tail);
        let roles = system.roles_with(true, true).into_iter();
        let functions: Vec<Function> = roles.map(|role| system.function(role)).collect();
        let found = check_scene(&system, &functions);
        assert!(found.is_empty(), "{on_tail}: {}", explain(&found));
    }
}

/// An effect acts on a junction of the follower's velocity, behind a transformer from the leader's.
#[test]
fn the_bond_graph_has_a_transformer_to_the_follower() {
    for (on_tail, _) in PAIRS {
        let network = scene(TAIL, on_tail).network;
        let mut nodes = network.nodes.iter();
        let transformer = nodes.position(|node| node.text == "-2.5 of coupling");
        let transformer = transformer.unwrap_or_else(|| panic!("{on_tail}: no transformer"));
        assert_eq!(network.nodes[transformer].kind, NodeKind::Transformer);
        let causality = Causality::of(&network);
        assert!(causality.conflicts.is_empty(), "{on_tail}");
        let with = network.nodes.iter().filter(|node| node.text == "q̇ tail");
        assert_eq!(with.count(), 1, "{on_tail}");
    }
    let none = scene(TAIL, "type: viscous, joint: grip, damping: 1").network;
    assert!(
        none.nodes
            .iter()
            .all(|node| !node.text.contains("coupling"))
    );
}

/// Friction at both fingers of a gripper holds with the sum of both.
#[test]
fn frictions_at_leader_and_follower_hold_together() {
    let fingers = ", left: { type: coulomb, joint: grip, kinetic: 3 N }, right: { type: coulomb, joint: tail, kinetic: 4 N }";
    let keys = "inputs: { grip: given }\ninitial: { left_mode: 0, right_mode: 0 }";
    let system = read(SLIDE, fingers, keys).expect("a sound scene");
    let mut at = states(&system)[1].clone();
    at.v = vec![Dd::ZERO];
    at.u = vec![Dd::from_f64(5.0)];
    let rates = values(&system, SceneFunction::Derivative, &at);
    assert_eq!(rates[0].to_f64(), 0.0);
    let contacts = values(&system, SceneFunction::Contacts, &at);
    // Both hold 5 N and the weight of the second slide; the limits are 3 N and 1.5 · 4 N at the leader.
    let (holding, margin) = (contacts[2].to_f64(), contacts[3].to_f64());
    assert!(
        (holding.abs() + margin - 9.0).abs() < 1e-12,
        "{holding}, {margin}"
    );
    assert_eq!(contacts[2..4], contacts[6..8]);
}

#[test]
fn an_elastic_drive_of_a_follower_begins_unstretched() {
    let effect = "type: series_elastic, joint: tail, stiffness: 80, inertia: 1e-2, ratio: 5";
    let system = scene(TAIL, effect);
    let close = |found: Dd, wanted: f64| (found.to_f64() - wanted).abs() < 1e-15;
    assert!(
        close(system.initial.q[1], 0.3 - 0.25),
        "{:?}",
        system.initial
    );
    assert!(close(system.initial.v[1], -1.0), "{:?}", system.initial);
}

#[test]
fn a_controller_of_a_motor_follows_the_follower() {
    let motor = ", e: { type: dc_motor, joint: tail, resistance: 1, torque_constant: 0.05 }";
    let keys = "inputs: { e: { pd: { target: 0.5, stiffness: 4, damping: 2 } } }";
    let system = read(TAIL, motor, keys).expect("a sound scene");
    let at = &states(&system)[0];
    let found = values(&system, SceneFunction::Inputs, at)[0].to_f64();
    let (q, v) = (at.q[0].to_f64(), at.v[0].to_f64());
    let wanted = 4.0 * (0.5 - (0.3 - 2.5 * q)) - 2.0 * (-2.5 * v);
    assert!((found - wanted).abs() < 1e-14, "{found}, {wanted}");
}

/// A stop without keys has the limits of its joint, in the joint's own units.
#[test]
fn units_are_those_of_the_follower() {
    let spring = ", k: { type: spring, joint: tail, stiffness: 3 N/m }";
    refused((TAIL, spring, ""), "unit-misfit", &["N/m"]);
    let stop = "type: stop, joint: tail, stiffness: 800, restitution: 0.5, impact_speed: 1";
    let limited = format!("{TAIL}, limits: {{ lower: -0.2, upper: 0.8 }}");
    let system = scene(&limited, stop);
    let element = system.scene.elements.iter().find(|e| e.name == "e");
    let lower = element.and_then(|e| e.quantity(e.effect.key("lower")));
    assert_eq!(lower.map(|q| q.value.to_f64()), Some(-0.2));
}

#[test]
fn effects_that_need_a_drive_name_the_leader() {
    let gear = ", g: { type: gear, joint: other, efficiency: 0.9 }";
    refused(
        (FOLLOWER, gear, ""),
        "follower",
        &["`other`", "joint: grip"],
    );
    let rotor =
        ", r: { type: rotor, joint: other, inertia: 1e-3 kg, ratio: { parameter: n, value: 3 } }";
    refused((FOLLOWER, rotor, ""), "follower", &["`other`", "run-time"]);
}

/// A follower is locked with its leader, and effects on it say so.
#[test]
fn effects_on_a_locked_follower_name_the_lock() {
    let spring = ", k: { type: spring, joint: other, stiffness: 3 N/m }";
    let lock = "lock: { grip: 0.1 }";
    refused((FOLLOWER, spring, lock), "locked-joint", &["`other`"]);
}

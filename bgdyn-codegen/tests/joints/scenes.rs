//! Scenes with joints of several degrees of freedom: what they accept, what they refuse and how.

use bgdyn_codegen::mechanism::Motion;
use bgdyn_codegen::mechanism::joint::JOINT_TYPES;
use bgdyn_codegen::read_scene;
use bgdyn_codegen::refusal::Refusal;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::{QuasiJoint, QuasiJointKind};

use super::findings::*;

const EFFECTS: &str = "effects: [inertia, velocity_products, gravity";

/// Reads a scene of a slide `grip` and this joint, with these effects and keys.
pub(super) fn read(joint: &str, effects: &str, keys: &str) -> Result<SceneEquations, Refusal> {
    let scene = format!("scene: 1\nmechanism: arm.yaml\n{EFFECTS}{effects}]\n{keys}\n");
    let mechanism = with_joints(&[LEADER, joint]);
    read_scene(&scene, "scene", |_| Ok(mechanism.clone())).map(|(system, _)| system)
}

/// Asserts that a scene is refused by one fault of this rule, whose text and advice have these words.
pub(super) fn refused((joint, effects, keys): (&str, &str, &str), rule: &str, words: &[&str]) {
    let faults = match read(joint, effects, keys) {
        Err(Refusal::Spec(faults)) => faults,
        other => panic!("{joint}{effects}{keys}: {:?}", other.map(|_| "accepted")),
    };
    let messages: Vec<String> = faults
        .0
        .iter()
        .map(|f| {
            format!(
                "[{}] {}: {}",
                f.rule,
                f.message,
                f.help.as_deref().unwrap_or("")
            )
        })
        .collect();
    assert_eq!(faults.0.len(), 1, "{messages:?}");
    assert_eq!(faults.0[0].rule, rule, "{messages:?}");
    for word in words {
        assert!(messages[0].contains(word), "{word}: {messages:?}");
    }
}

pub(super) const BALL: &str = "name: ball, type: spherical";
pub(super) const FREE: &str = "name: free, type: floating";
pub(super) const CART: &str = "name: cart, type: planar";
const SCREW: &str = "name: feed, type: helical, lead: 5 mm";
pub(super) const FOLLOWER: &str = "name: other, type: prismatic, mimic: { joint: grip }";

/// Names of positions, velocities and coordinates.
#[test]
fn the_state_has_the_names_of_positions_and_velocities() {
    for (joint, names) in [
        (
            BALL,
            "grip ball_qx ball_qy ball_qz ball_qw grip_rate ball_rx_velocity ball_ry_velocity ball_rz_velocity",
        ),
        (
            CART,
            "grip cart_x cart_y cart_turn grip_rate cart_x_velocity cart_y_velocity cart_turn_rate",
        ),
        (SCREW, "grip feed grip_rate feed_rate"),
        (FOLLOWER, "grip grip_rate"),
        (
            "name: c, type: cylindrical",
            "grip c_turn c_slide grip_rate c_turn_rate c_slide_rate",
        ),
    ] {
        let system = read(joint, "", "").unwrap_or_else(|e| panic!("{joint}: {e:?}"));
        let found: Vec<&str> = system.scene.layout.state_names().collect();
        assert_eq!(found.join(" "), names);
    }
}

#[test]
fn effects_that_read_a_position_do_not_act_on_quasi_velocities() {
    let spring = ", k: { type: spring, joint: ball_rx, stiffness: 3 N*m/rad }";
    let words = ["`k` is a `spring`", "`ball_rx`", "spherical", "between"];
    refused((BALL, spring, ""), "no-position", &words);
    let stop = ", s: { type: stop, joint: free_z, stiffness: 3 N/m, upper: 1 m, restitution: 0.5, impact_speed: 1 m/s }";
    refused((FREE, stop, ""), "no-position", &["`free_z`", "floating"]);
    let rotor = ", r: { type: rotor, joint: ball_rz, inertia: 1e-3 kg*m^2 }";
    refused((BALL, rotor, ""), "no-position", &["`rotor`"]);
    let elastic = ", e: { type: series_elastic, joint: cart_x, stiffness: 3 N/m, inertia: 1 kg }";
    refused((CART, elastic, ""), "no-position", &["`cart_x`"]);
}

#[test]
fn effects_that_read_a_velocity_act_on_any() {
    for (joint, effect) in [
        (
            BALL,
            "{ type: viscous, joint: ball_rx, damping: 1 N*m*s/rad }",
        ),
        (FREE, "{ type: viscous, joint: free_z, damping: 1 N*s/m }"),
        (FREE, "{ type: coulomb, joint: free_x, kinetic: 1 N }"),
        (
            BALL,
            "{ type: dc_motor, joint: ball_rz, torque_constant: 1 N*m/A, resistance: 1 ohm }",
        ),
        (
            CART,
            "{ type: spring, joint: cart_turn, stiffness: 1 N*m/rad }",
        ),
        (SCREW, "{ type: spring, joint: feed, stiffness: 1 N*m/rad }"),
    ] {
        let read = read(joint, &format!(", e: {effect}"), "");
        assert!(read.is_ok(), "{joint}, {effect}: {:?}", read.err());
    }
}

#[test]
fn a_joint_of_several_degrees_is_not_among_all_joints() {
    let effect = ", e: { type: viscous, joints: all, damping: 1 N*s/m }";
    let system = read(FREE, effect, "").expect("a sound scene");
    let names: Vec<&str> = system
        .scene
        .elements
        .iter()
        .map(|e| e.name.as_str())
        .collect();
    assert!(
        names.contains(&"e_grip") && !names.contains(&"e_free_x"),
        "{names:?}"
    );
}

#[test]
fn quaternions_at_the_start_have_length_one() {
    let initial = "initial: { ball_qx: 0.5 }";
    refused(
        (BALL, "", initial),
        "quaternion-length",
        &["`ball`", "1.11803", "rpy"],
    );
    let initial = "initial: { free: { quaternion: [0, 0, 0.6, 0.8001] } }";
    refused(
        (FREE, "", initial),
        "quaternion-length",
        &["`free`", "1.00008"],
    );
    let initial = "initial: { free: { quaternion: [0, 0, 0.6, 0.8000001] } }";
    let system = read(FREE, "", initial).expect("a sound scene");
    let q = &system.initial.q[4..8];
    let square: f64 = q.iter().map(|x| x.to_f64().powi(2)).sum();
    assert!((square - 1.0).abs() < 1e-15, "{square}");
    let any = "name: ball, type: spherical, quaternion: any";
    let system = read(any, "", "initial: { ball: { quaternion: [0, 0, 3, 4] } }");
    let system = system.unwrap_or_else(|e| panic!("{e:?}"));
    let found: Vec<f64> = system.initial.q[1..].iter().map(|x| x.to_f64()).collect();
    assert_eq!(found, [0.0, 0.0, 0.6, 0.8]);
    refused(
        (any, "", "initial: { ball: { quaternion: [0, 0, 0, 0] } }"),
        "quaternion-length",
        &["length 0"],
    );
}

#[test]
fn poses_at_the_start_have_these_keys() {
    let initial = "initial: { free: { xyz: [1, 2, 30 cm], rpy: [0, 0, 90 deg] } }";
    let system = read(FREE, "", initial).expect("a sound scene");
    let found: Vec<f64> = system.initial.q[1..].iter().map(|x| x.to_f64()).collect();
    let half = 0.5_f64.sqrt();
    assert_eq!(found, [1.0, 2.0, 0.3, 0.0, 0.0, half, half]);
    for (keys, rule, word) in [
        ("{ xzy: [0, 0, 0] }", "unknown-key", "xyz"),
        (
            "{ rpy: [0, 0, 0], quaternion: [0, 0, 0, 1] }",
            "initial",
            "both",
        ),
        ("{ quaternion: [0, 0, 1] }", "initial", "3 numbers; 4"),
    ] {
        refused(
            (FREE, "", &format!("initial: {{ free: {keys} }}")),
            rule,
            &[word],
        );
    }
    refused(
        (BALL, "", "initial: { ball: { xyz: [0, 0, 0] } }"),
        "unknown-key",
        &["rpy"],
    );
}

/// A pose and its components, the place and words of a wrong length, and names that are almost right.
#[test]
fn a_start_says_each_thing_once() {
    for initial in [
        "free: { xyz: [1, 2, 3] }, free_x: 5",
        "free_x: 5, free: { xyz: [1, 2, 3] }",
        "free: { rpy: [0, 0, 0] }, free_qx: 0.5",
    ] {
        let keys = format!("initial: {{ {initial} }}");
        refused(
            (FREE, "", &keys),
            "initial",
            &["also part of the pose of `free`"],
        );
    }
    let keys = "initial: { free_rz_velocity: 1.5, free: { quaternion: [0, 0, 0.6, 0.9] } }";
    let Err(Refusal::Spec(faults)) = read(FREE, "", keys) else {
        panic!("accepted");
    };
    assert_eq!(faults.0[0].path, "initial.free");
    // A component that is refused makes no length.
    let keys = "initial: { ball_qz: 0.6 m, ball_qw: 0.8 }";
    refused((BALL, "", keys), "unit-misfit", &[]);
    let keys = "initial: { fre: { rpy: [0, 0, 0] } }";
    refused(
        (FREE, "", keys),
        "unknown-name",
        &["did you mean `free`", "begins with a pose"],
    );
    let any = "name: ball, type: spherical, quaternion: any";
    let keys = "initial: { ball: { quaternion: [0, 0, 0, 0] } }";
    refused(
        (any, "", keys),
        "quaternion-length",
        &["every length but 0"],
    );
}

#[test]
fn lock_names_what_can_be_locked() {
    refused(
        (FREE, "", "lock: { free_x: 0 }"),
        "lock-of-several",
        &["`free` is a floating"],
    );
    let follower = "name: tail, type: prismatic, axis: y, mimic: { joint: grip }";
    refused(
        (follower, "", "lock: { tail: 0 }"),
        "follower",
        &["lock `grip`"],
    );
    refused(
        (FREE, "", "lock: { girp: 0 }"),
        "unknown-name",
        &["did you mean `grip`"],
    );
}

#[test]
fn momenta_of_quasi_velocities_are_not_canonical() {
    let run = "integration: { method: canonical_gauss2, step: 1 ms }";
    for joint in [BALL, FREE, CART] {
        refused(
            (joint, "", run),
            "canonical-form",
            &["Lie–Poisson", "use `gauss2`"],
        );
    }
    for joint in [SCREW, FOLLOWER] {
        let read = read(joint, "", run);
        assert!(read.is_ok(), "{joint}: {:?}", read.err());
    }
}

#[test]
fn locks_take_joints_of_one_degree() {
    refused(
        (FREE, "", "lock: { free: 0 }"),
        "lock-of-several",
        &["`free`", "floating"],
    );
    // A locked screw has its position along the axis; a locked leader holds its follower.
    let system = read(SCREW, "", "lock: { feed: 180 deg }").expect("a sound scene");
    let link = system
        .scene
        .mechanism
        .links()
        .iter()
        .find(|l| l.joint.name == "feed");
    let along = link
        .expect("its link")
        .joint
        .origin
        .translation
        .0
        .map(|x| x.to_f64());
    assert!(
        along.iter().any(|x| (x.abs() - 0.0025).abs() < 1e-15),
        "{along:?}"
    );
    let system = read(FOLLOWER, "", "lock: { grip: 20 mm }").expect("a sound scene");
    assert_eq!(system.scene.layout.nv(), 0);
}

/// Every joint type whose velocities are not rates of positions has its integration in runs.
#[test]
fn every_manifold_has_a_kind() {
    for joint in JOINT_TYPES {
        if let Motion::Compound(motion) = joint.motion
            && !motion.manifold.is_empty()
        {
            let kind = QuasiJointKind::of_module(motion.manifold);
            let kind = kind.unwrap_or_else(|| panic!("{} in runs", joint.keyword));
            let own = QuasiJoint {
                kind,
                position: 0,
                velocity: 0,
            };
            let sizes = (own.positions(), own.velocities());
            assert_eq!(sizes, (motion.positions.len(), motion.velocities.len()));
            assert_eq!(own.quaternion(), motion.quaternion());
        }
    }
}

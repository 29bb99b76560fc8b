//! Faults of prescribed joints: each with its place, its rule, and the way out.

use bgdyn_codegen::formulation;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::selection;

use super::findings::{found, refused_text, with_joints};
use super::robot::Robot;

const JOINTS: [&str; 4] = [
    "name: left, type: revolute",
    "name: right, type: continuous, axis: y",
    "name: slide, type: prismatic, axis: x",
    "name: ball, type: spherical",
];

/// Asserts exactly one fault of a file with these joints and keys.
fn refused(joints: &[&str], keys: &str, rule: &str, path: &str, words: &[&str]) {
    let text = format!("{}{keys}", with_joints(joints));
    refused_text(&text, rule, path, words);
}

const LEFT: &str = "constraints:\n  c: { type: prescribed, joint: left }\n";

#[test]
fn keys_and_names() {
    refused(
        &JOINTS,
        "constraints:\n  c: { type: prescribed }\n",
        "missing-key",
        "constraints.c",
        &["`c` has no `joint`", "at run time"],
    );
    refused(
        &JOINTS,
        "constraints:\n  c: { type: prescribed, joint: lift }\n",
        "unknown-name",
        "constraints.c.joint",
        &["`lift`", "did you mean `left`?"],
    );
    refused(
        &JOINTS,
        "constraints:\n  c: { type: prescribed, joint: ball }\n",
        "constraint-on-joint",
        "constraints.c.joint",
        &["`ball` is a spherical joint", "one degree of freedom"],
    );
    refused(
        &JOINTS,
        "constraints:\n  c: { type: prescribed, joint: left, motion: 3 }\n",
        "unknown-key",
        "constraints.c",
        &["`motion`", "`joint`"],
    );
    refused(
        &JOINTS,
        &format!("{LEFT}  d: {{ type: prescribed, joint: left }}\n"),
        "prescribed-twice",
        "constraints.d.joint",
        &["`c` prescribes `left` already", "leave one"],
    );
}

#[test]
fn joints_that_follow_and_joints_that_are_followed() {
    let follower = "name: tip, type: revolute, mimic: { joint: right, ratio: 2 }";
    let mut joints = JOINTS.to_vec();
    joints.push(follower);
    refused(
        &joints,
        "constraints:\n  c: { type: prescribed, joint: tip }\n",
        "prescribed-follower",
        "constraints.c.joint",
        &["`tip`", "`mimic`", "follows `right`", "leave `mimic` out"],
    );
    refused(
        &joints,
        "constraints:\n  c: { type: prescribed, joint: right }\n",
        "prescribed-leader",
        "constraints.c.joint",
        &[
            "`right` is prescribed, and `tip` follows it",
            "prescribe `tip` as well",
        ],
    );
    refused(
        &JOINTS,
        &format!("{LEFT}  pair: {{ type: gear, joints: {{ left: 1, right: 2 }} }}\n"),
        "prescribed-row",
        "constraints.c.joint",
        &["`left` is prescribed", "`pair` relates it to other joints"],
    );
    refused(
        &JOINTS,
        &format!("{LEFT}independent: [left]\n"),
        "prescribed-independent",
        "constraints.c.joint",
        &["`independent`", "no velocity in v"],
    );
}

#[test]
fn parameters_and_effects() {
    let text =
        with_joints(&JOINTS).replacen("mass: 1", "mass: { parameter: left_velocity, value: 1 }", 1);
    let text = format!("{text}{LEFT}");
    let faults = found(&text);
    assert_eq!(faults.0.len(), 1, "{}", faults.render("arm.yaml", &text));
    assert_eq!(faults.0[0].rule, "parameter-of-prescribed");
    assert_eq!(faults.0[0].path, "links[0].mass");
    for effect in [
        "{ type: viscous, joint: left, damping: 1 }",
        "{ type: rotor, joint: left, inertia: 1e-4, ratio: 50 }",
        "{ type: dc_motor, joint: left, torque_constant: 1, resistance: 1, inductance: 1 mH }",
    ] {
        refused(
            &JOINTS,
            &format!("{LEFT}effects:\n  e: {effect}\n"),
            "effect-on-prescribed",
            "effects.e.joint",
            &["the motion of `left` is prescribed", "`drive_efforts`"],
        );
    }
}

#[test]
fn loops_beside_prescribed_joints() {
    let loops = "loops:\n  - { name: pin, type: distance, length: 0.5, a: { link: l0, origin: { xyz: [0.3, 0, 0] } }, b: { link: l1, origin: { xyz: [0.3, 0.1, 0] } } }\n";
    let text = format!("{}{LEFT}{loops}", with_joints(&JOINTS[..3]));
    let faults = found(&text);
    let own = faults.0.iter().find(|f| f.rule == "prescribed-with-loops");
    let own = own.unwrap_or_else(|| panic!("{}", faults.render("arm.yaml", &text)));
    assert_eq!(own.path, "constraints.c.joint");
    assert!(
        own.message.contains("`left` is prescribed"),
        "{}",
        own.message
    );
}

/// A file whose joints are all prescribed has no motion to compute.
#[test]
fn one_joint_has_to_move() {
    let faults = found(&format!("{}{LEFT}", with_joints(&JOINTS[..1])));
    let rules: Vec<&str> = faults.0.iter().map(|f| f.rule).collect();
    assert_eq!(rules, ["no-coordinates"]);
}

/// Formulations for rotations and translations alone name the joint.
#[test]
fn a_formulation_that_does_not_serve_says_so() {
    let robot = Robot::read(&format!("{}{LEFT}", with_joints(&JOINTS[..3])));
    let options = Options {
        formulation: formulation::by_name("common_axes"),
        ..Options::default()
    };
    let refusal = selection::model(robot.mechanism, &options)
        .err()
        .expect("it does not serve");
    let said = refusal[0].message.as_str();
    for word in [
        "`common_axes`",
        "link `l0`",
        "is prescribed",
        "literal or recursion or recursion_own or subspaces",
    ] {
        assert!(said.contains(word), "no {word:?} in {said}");
    }
}

/// `drive_efforts` is a method of mechanisms with such joints only.
#[test]
fn other_mechanisms_have_no_drive_efforts() {
    let options = Options {
        methods: Some(vec!["drive_efforts".into()]),
        ..Options::default()
    };
    let plain = Robot::read(&with_joints(&JOINTS));
    let refusal = selection::model(plain.mechanism, &options)
        .err()
        .expect("no such method");
    assert!(
        refusal[0].message.contains("drive_efforts"),
        "{}",
        refusal[0].message
    );
    let own = Robot::read(&format!("{}{LEFT}", with_joints(&JOINTS)));
    let model = selection::model(own.mechanism, &options).expect("its method");
    assert_eq!(model.functions.len(), 1);
    assert_eq!(model.functions[0].name(), "drive_efforts");
}

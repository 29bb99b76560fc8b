//! Tests the check: the mechanism of a valid spec, and the rule that an error violates.

mod directions;
mod inertia;
mod parameters;

use bgdyn_codegen::fault::Faults;
use bgdyn_codegen::math::{Mat3, Vec3};
use bgdyn_codegen::mechanism::{CoordinateId, Link, LinkId, Mechanism, Motion, Value};
use bgdyn_codegen::read;
use bgdyn_runtime::Dd;

/// Returns the findings, except joints without inertia, which these specs have for brevity.
fn checked(text: &str) -> (Option<Mechanism>, Faults) {
    let (mechanism, mut faults) = read(text, Some("arm"));
    faults
        .0
        .retain(|fault| !["no-inertia", "no-coordinates"].contains(&fault.rule));
    (mechanism, faults)
}

fn sound(text: &str) -> Mechanism {
    let (mechanism, faults) = checked(text);
    assert_eq!(faults, Faults::default());
    mechanism.expect("a mechanism without faults")
}

/// Returns the rules violated by a spec.
fn rules(text: &str) -> Vec<&'static str> {
    let (mechanism, faults) = checked(text);
    assert_eq!(mechanism.is_none(), faults.any_fault());
    faults.0.iter().map(|fault| fault.rule).collect()
}

/// A mechanism of one link with these keys.
fn link(keys: &str) -> String {
    format!("format: 1\nlinks: [{{ name: a, {keys} }}]\n")
}

/// A mechanism of one link with a revolute joint with these keys.
fn joint(keys: &str) -> String {
    link(&format!("joint: {{ name: j, type: revolute, {keys} }}"))
}

fn dd(text: &str) -> Dd {
    text.parse().expect("a decimal")
}

fn whole(rows: [[f64; 3]; 3]) -> Mat3<Dd> {
    Mat3(rows).map(Dd::from_f64)
}

#[test]
fn what_is_left_out_has_its_default() {
    let arm = sound("format: 1\nlinks: [{ name: base }]\n");
    assert_eq!(
        (arm.name(), arm.label(), arm.description()),
        ("arm", None, None)
    );
    assert_eq!(arm.gravity(), Vec3([Dd::ZERO, Dd::ZERO, dd("-9.81")]));
    assert_eq!(
        (arm.nq(), arm.nv(), arm.links().len(), arm.frames().len()),
        (0, 0, 1, 0)
    );
    let Link {
        parent,
        joint,
        inertial,
        ..
    } = &arm.links()[0];
    assert_eq!(
        (*parent, joint.name.as_str(), joint.kind.motion),
        (None, "base_mount", Motion::None)
    );
    assert_eq!(
        joint.origin.rotation,
        whole([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    );
    assert_eq!(inertial.mass, Value::Fixed(Dd::ZERO));
}

#[test]
fn what_is_written_is_carried_over() {
    let arm = sound(
        "
format: 1
name: arm
label: The Arm
description: Two joints
gravity: [0, -1.62, 0]
links:
  - name: a
    label: link_1
    joint: { name: lift, label: J1, type: prismatic, limits: { lower: -5 mm, upper: 0.4, velocity: 1 } }
    mass: 2.5
    com: [1 mm, 0.1, 0]
frames: [{ name: tool, label: TCP, link: a, origin: { xyz: [0, 0, 0.1] } }, { name: cell, link: world }]
",
    );
    assert_eq!(
        (arm.label(), arm.description()),
        (Some("The Arm"), Some("Two joints"))
    );
    assert_eq!(arm.gravity(), Vec3([Dd::ZERO, dd("-1.62"), Dd::ZERO]));
    let a = &arm.links()[0];
    assert_eq!(
        (a.label.as_deref(), a.joint.label.as_deref()),
        (Some("link_1"), Some("J1"))
    );
    assert_eq!(
        a.joint.axis,
        Vec3([Dd::ZERO, Dd::ZERO, Dd::ONE]),
        "z is the default"
    );
    let limits = a.joint.limits;
    assert_eq!(
        (limits.lower, limits.upper, limits.velocity),
        (Some(-0.005), Some(0.4), Some(1.0))
    );
    assert_eq!(limits.effort, None);
    assert_eq!(a.inertial.com.0[0], Value::Fixed(dd("0.001")));
    assert_eq!(
        (arm.frames()[0].link, arm.frames()[1].link),
        (Some(LinkId(0)), None)
    );
    assert_eq!(arm.frames()[0].origin.translation.0[2], dd("0.1"));
    assert_eq!(arm.joint(CoordinateId(0)).name, "lift");
}

#[test]
fn the_name_is_the_stem_up_to_its_first_dot() {
    let text = "format: 1\nlinks: [{ name: base }]\n";
    assert_eq!(
        read(text, Some("pick.scene"))
            .0
            .expect("a mechanism")
            .name(),
        "pick"
    );
    let named = format!("name: pick\n{text}");
    assert_eq!(
        read(&named, Some("pick.scene"))
            .0
            .expect("a mechanism")
            .name(),
        "pick"
    );
    assert_eq!(read(&named, None).0.expect("a mechanism").name(), "pick");
    assert_eq!(read(text, None).1.0[0].rule, "no-name");
}

#[test]
fn parents_come_first_otherwise_the_order_is_the_files() {
    let arm = sound(
        "
format: 1
links:
  - { name: hand, parent: fore, joint: { name: wrist, type: revolute } }
  - { name: other, joint: { name: side, type: prismatic } }
  - { name: fore, parent: upper, joint: { name: elbow, type: continuous } }
  - { name: finger, parent: hand, joint: { name: grip, type: prismatic } }
  - { name: upper }
",
    );
    let names: Vec<&str> = arm.links().iter().map(|link| link.name.as_str()).collect();
    assert_eq!(names, ["upper", "fore", "hand", "other", "finger"]);
    let parents: Vec<Option<usize>> = arm.links().iter().map(|l| l.parent.map(|p| p.0)).collect();
    assert_eq!(parents, [None, Some(0), Some(1), None, Some(2)]);
    let joints: Vec<&str> = (0..arm.nv())
        .map(|i| arm.joint(CoordinateId(i)).name.as_str())
        .collect();
    assert_eq!(joints, ["elbow", "wrist", "side", "grip"]);
    assert_eq!(arm.links()[2].joint.coordinate, Some(CoordinateId(1)));
    assert_eq!(arm.links()[0].joint.coordinate, None);
}

#[test]
fn every_circle_is_named_once() {
    let text = "
format: 1
links:
  - { name: x, parent: b }
  - { name: a, parent: c }
  - { name: b, parent: a }
  - { name: c, parent: b }
  - { name: s, parent: s }
";
    let (_, faults) = read(text, Some("arm"));
    let messages: Vec<(&str, &str)> = faults
        .0
        .iter()
        .map(|f| (f.path.as_str(), f.message.as_str()))
        .collect();
    assert_eq!(messages.len(), 2, "{messages:?}");
    assert_eq!(messages[0].0, "links[1].parent");
    assert!(messages[0].1.contains("a → c → b → a"), "{messages:?}");
    assert_eq!(messages[1].0, "links[4].parent");
}

#[test]
fn a_very_long_chain_is_no_trouble() {
    let mut text = String::from("format: 1\nlinks:\n");
    for i in 0..3000 {
        text += &format!("- {{ name: l{i}, parent: l{} }}\n", i + 1);
    }
    text += "- name: l3000\n";
    assert_eq!(sound(&text).links()[3000].name, "l0");
}

#[test]
fn limits_fit_their_joint() {
    let prismatic = |keys: &str| {
        rules(&link(&format!(
            "joint: {{ name: j, type: prismatic, limits: {{ {keys} }} }}"
        )))
    };
    assert_eq!(prismatic("lower: -1 deg"), ["unit-misfit"]);
    assert_eq!(
        prismatic("velocity: 1 rad/s, effort: 2 N*m"),
        ["unit-misfit"; 2]
    );
    assert_eq!(prismatic("lower: 1, upper: 1"), [""; 0]);
    assert_eq!(prismatic("effort: -1, velocity: -1"), ["negative-limit"; 2]);
    let both = "joint: { name: j, type: continuous, limits: { lower: -1, upper: 1 } }";
    assert_eq!(rules(&link(both)), ["position-limit"; 2]);
    let velocity = "joint: { name: j, type: continuous, limits: { velocity: 10 deg/s } }";
    assert_eq!(rules(&link(velocity)), [""; 0]);
    assert_eq!(
        rules(&joint("limits: { lower: 1 m, upper: -1 rad }")),
        ["unit-misfit"]
    );
}

#[test]
fn names_are_checked_everywhere() {
    let text = "
format: 1
links:
  - { name: Arm, joint: { name: 1st, type: revolute } }
  - { name: a, parent: Arm, joint: { name: j__1, type: revolute } }
  - { name: fn, parent: a }
frames: [{ name: world, link: fn }, { name: a, link: world }, { name: ok, link: nowhere }]
";
    let found = rules(text);
    assert_eq!(
        found,
        [
            "name",
            "name",
            "name",
            "name",
            "reserved-name",
            "repeated-name",
            "unknown-link"
        ]
    );
}

#[test]
fn a_merge_key_is_the_only_fault_of_its_mapping() {
    let text = "format: 1\nlinks:\n  - &a { name: a, mass: 1 }\n  - { <<: *a }\n";
    assert_eq!(rules(text), ["merge-key"]);
}

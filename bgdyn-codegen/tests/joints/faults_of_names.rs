//! Names of velocities, joints without inertia.

use super::findings::*;

/// A joint of several degrees names its velocities: these are names of joints in `JOINT_NAMES`, of leaders,
/// and of ports.
#[test]
fn names_of_velocities_are_not_names_of_other_joints() {
    for (joint, name) in [
        ("name: c, type: cylindrical", "c_turn"),
        ("name: c, type: universal, axis: x, axis2: y", "c_second"),
        ("name: c, type: spherical", "c_rx"),
        ("name: c, type: planar", "c_x"),
        ("name: c, type: floating", "c_rz"),
    ] {
        for joints in [
            [joint.to_owned(), format!("name: {name}, type: revolute")],
            [format!("name: {name}, type: revolute"), joint.to_owned()],
        ] {
            let text = with_joints(&[&joints[0], &joints[1]]);
            let (mechanism, faults) = bgdyn_codegen::read(&text, None);
            let names = mechanism.map(|m| m.joint_names());
            assert!(
                faults.any_fault(),
                "two velocities have one name: {names:?}\n{text}"
            );
        }
    }
}

/// A link without inertia at a tip: forward dynamics fails in every state, whatever its joint.
#[test]
fn a_tip_without_inertia_is_warned_of() {
    for kind in [
        "revolute",
        "helical, lead: 5 mm",
        "cylindrical",
        "universal, axis: x, axis2: y",
        "spherical",
        "planar",
        "floating",
    ] {
        let text = format!("{HEAD}  - {{ name: tip, joint: {{ name: j, type: {kind} }} }}\n");
        let rules: Vec<&str> = found(&text).0.iter().map(|f| f.rule).collect();
        assert!(rules.contains(&"no-inertia"), "{kind}: {rules:?}");
    }
}

/// The massless link between two joints in series has a name of its own, which no other link may have.
#[test]
fn names_of_hidden_links_are_not_names_of_other_links() {
    let text = format!(
        "{HEAD}  - {{ name: a, joint: {{ name: c, type: cylindrical }}, {BODY} }}\n  \
         - {{ name: a_c_turn, joint: {{ name: d, type: revolute }}, {BODY} }}\n"
    );
    assert_eq!(one(&text).rule, "repeated-name");
}

/// The functions that read and set poses have names that no other function of the model has.
#[test]
fn names_of_pose_functions_are_unique() {
    for (joint, other) in [
        (
            "name: pose, type: floating",
            "name: pose, joint: { name: a, type: revolute }",
        ),
        (
            "name: x, type: floating",
            "name: b, joint: { name: set_x, type: floating }",
        ),
        (
            "name: x, type: spherical",
            "name: b, joint: { name: set_x, type: spherical }",
        ),
        (
            "name: velocity_a, type: spherical",
            "name: a_rotation, joint: { name: c, type: revolute }",
        ),
    ] {
        let text = format!(
            "{HEAD}  - {{ name: l, joint: {{ {joint} }}, {BODY} }}\n  - {{ {other}, {BODY} }}\n"
        );
        let fault = one(&text);
        assert_eq!(fault.rule, "repeated-name", "{text}");
        assert!(
            fault.message.contains("functions of the model"),
            "{}",
            fault.message
        );
    }
}

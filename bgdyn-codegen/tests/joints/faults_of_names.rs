//! Names of velocities, scenes with joints of several degrees, joints without inertia.

use bgdyn_codegen::read_scene;
use bgdyn_codegen::refusal::Refusal;

use super::findings::*;

/// Asserts that a scene refuses the mechanism of a slide and this joint for one reason.
fn refused_in_a_scene(joint: &str, said: &str) {
    let scene = "scene: 1\nmechanism: arm.yaml\neffects: [inertia, velocity_products, gravity]\n";
    let mechanism = with_joints(&[LEADER, joint]);
    let Err(Refusal::Spec(faults)) = read_scene(scene, "scene", |_| Ok(mechanism)) else {
        panic!("{joint}: not refused by its faults");
    };
    let shown = faults.render("scene.yaml", scene);
    assert_eq!(faults.0.len(), 1, "{joint}:\n{shown}");
    let fault = &faults.0[0];
    let place = (fault.rule, fault.path.as_str(), fault.position.line);
    assert_eq!(place, ("joint-in-scene", "mechanism", 2), "{shown}");
    assert!(fault.message.contains(said), "{shown}");
    let help = fault.help.as_deref().unwrap_or_default();
    assert!(
        help.contains("bgdyn eval") && help.contains("revolute"),
        "{help}"
    );
}

#[test]
fn scenes_refuse_joints_of_several_degrees() {
    refused_in_a_scene("name: j, type: spherical", "`j` is spherical");
    refused_in_a_scene("name: j, type: floating", "`j` is floating");
    refused_in_a_scene("name: j, type: planar", "`j` is planar");
}

#[test]
fn scenes_refuse_screws() {
    refused_in_a_scene("name: j, type: helical, lead: 5 mm", "`j` is helical");
}

#[test]
fn scenes_refuse_followers() {
    refused_in_a_scene(
        "name: j, type: prismatic, mimic: { joint: grip }",
        "`j` has `mimic`",
    );
}

/// Joints that are made of plain ones need no support.
#[test]
fn scenes_accept_joints_of_plain_ones() {
    let scene = "scene: 1\nmechanism: arm.yaml\neffects: [inertia, velocity_products, gravity]\n";
    for joint in [
        "name: j, type: cylindrical",
        "name: j, type: universal, axis: x, axis2: y",
    ] {
        let mechanism = with_joints(&[joint]);
        let read = read_scene(scene, "scene", |_| Ok(mechanism));
        assert!(read.is_ok(), "{joint}: {:?}", read.err());
    }
}

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

//! Controllers that hold the pose of a joint: what they accept, what they refuse and how.

use bgdyn_codegen::scene::{InputSource, PoseTarget};

use super::scenes::{BALL, CART, FREE, read, refused};

/// The input `joint: { hold: { … } }`.
fn hold(joint: &str, parts: &str) -> String {
    format!("inputs: {{ {joint}: {{ hold: {{ {parts} }} }} }}")
}

#[test]
fn controllers_of_one_coordinate_do_not_follow_quasi_velocities() {
    let input = "inputs: { ball_rx: { pd: { target: 0, stiffness: 1, damping: 1 } } }";
    let words = ["`ball_rx`", "ball: { hold: … }", "difference"];
    refused((BALL, "", input), "drive", &words);
    let accepted = read(BALL, "", "inputs: { ball_rx: { constant: 1 } }");
    assert!(accepted.is_ok(), "{:?}", accepted.err());
}

/// A hold drives the efforts of its parts, and leaves the others.
#[test]
fn a_hold_drives_the_efforts_of_its_parts() {
    let attitude =
        "attitude: { target: { rpy: [0, 0, 90 deg] }, stiffness: 3 N*m/rad, damping: 1 }";
    let position = "position: { target: [0, 0, 1], stiffness: [1, 2, 3], damping: 2 N*s/m }";
    let flat = "position: { target: [0, { ramp: { rate: 1 } }], stiffness: 2 }";
    let angle = "angle: { target: { table: [[0 s, 0], [2 s, 90 deg]] }, stiffness: 2 }";
    for (joint, name, parts, driven) in [
        (BALL, "ball", attitude.to_owned(), "ball_rx ball_ry ball_rz"),
        (FREE, "free", attitude.to_owned(), "free_rx free_ry free_rz"),
        (FREE, "free", position.to_owned(), "free_x free_y free_z"),
        (
            FREE,
            "free",
            format!("{attitude}, {position}"),
            "free_x free_y free_z free_rx free_ry free_rz",
        ),
        (CART, "cart", flat.to_owned(), "cart_x cart_y"),
        (CART, "cart", angle.to_owned(), "cart_turn"),
    ] {
        let system = read(joint, "", &hold(name, &parts));
        let system = system.unwrap_or_else(|e| panic!("{parts}: {e:?}"));
        let inputs = system.scene.layout.inputs.iter();
        let names: Vec<&str> = inputs.map(|i| i.name.as_str()).collect();
        assert_eq!(names.join(" "), driven, "{parts}");
        let drives = system.scene.drives.iter();
        assert!(drives.clone().all(InputSource::is_controller), "{parts}");
    }
    // The other efforts may have sources of their own.
    let both = format!("inputs: {{ free: {{ hold: {{ {attitude} }} }}, free_z: 5 N }}");
    let system = read(FREE, "", &both).expect("a sound scene");
    assert_eq!(system.scene.drives.len(), 4);
    // A run ends steps where targets bend.
    let system = read(CART, "", &hold("cart", angle)).expect("a sound scene");
    assert_eq!(system.scene.corners(), [0.0, 2.0]);
}

#[test]
fn a_target_is_a_unit_quaternion() {
    let part = "attitude: { target: { rpy: [0, 0, 90 deg] }, stiffness: 3 }";
    let system = read(BALL, "", &hold("ball", part)).expect("a sound scene");
    let InputSource::Hold(hold_of, 2) = &system.scene.drives[2] else {
        panic!("{:?}", system.scene.drives);
    };
    let PoseTarget::Quaternion(q) = hold_of.target else {
        panic!("{hold_of:?}");
    };
    let half = 0.5_f64.sqrt();
    assert_eq!(q.map(|x| x.to_f64()), [0.0, 0.0, half, half]);
    let part = "attitude: { target: { quaternion: [0, 0, 0.6, 0.9] }, stiffness: 3 }";
    let words = ["`ball`", "1.08167", "rpy"];
    refused((BALL, "", &hold("ball", part)), "quaternion-length", &words);
    let any = "name: ball, type: spherical, quaternion: any";
    let part = "attitude: { target: { quaternion: [0, 0, 3, 4] }, stiffness: 3 }";
    assert!(read(any, "", &hold("ball", part)).is_ok());
}

#[test]
fn joints_of_other_types_have_other_parts() {
    let words = ["`ball` is a spherical joint", "attitude"];
    let part = "position: { target: [0, 0, 0], stiffness: 3 }";
    refused((BALL, "", &hold("ball", part)), "unknown-key", &words);
    let words = ["`cart` is a planar joint", "position and angle"];
    let part = "attitude: { target: { rpy: [0, 0, 0] }, stiffness: 3 }";
    refused((CART, "", &hold("cart", part)), "unknown-key", &words);
    let words = ["planar, spherical or floating", "`pd`"];
    let part = "position: { target: 1, stiffness: 3 }";
    refused((FREE, "", &hold("grip", part)), "drive", &words);
    refused((FREE, "", &hold("free_rx", part)), "drive", &words);
}

#[test]
fn a_joint_of_several_degrees_has_no_single_source() {
    for source in ["2 N", "given", "{ pd: { target: 0 } }", "{ constant: 1 }"] {
        let input = format!("inputs: {{ free: {source} }}");
        let words = ["`free` is a floating joint", "hold", "`free_x: …`"];
        refused((FREE, "", &input), "drive", &words);
    }
}

#[test]
fn keys_of_a_hold_are_needed() {
    for (parts, key) in [
        ("attitude: { stiffness: 3 }", "target"),
        ("attitude: { target: { rpy: [0, 0, 0] } }", "stiffness"),
        ("position: { stiffness: 3, damping: 1 }", "target"),
        ("position: { target: [0, 0, 0], damping: 1 }", "stiffness"),
    ] {
        let words = [format!("no `{key}`")];
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        refused((FREE, "", &hold("free", parts)), "missing-key", &words);
    }
    let words = ["held at nothing", "`position`, `attitude`"];
    refused((FREE, "", &hold("free", "")), "missing-key", &words);
}

#[test]
fn gains_are_not_negative() {
    let rest = "target: { rpy: [0, 0, 0] }";
    for (gains, words) in [
        ("stiffness: -3", ["`stiffness` is -3", "pushes away"]),
        (
            "stiffness: [1, -2 N*m/rad, 3]",
            ["`stiffness` is -2 N*m/rad", "pushes away"],
        ),
        (
            "stiffness: 3, damping: -0.1",
            ["`damping` is -0.1", "drive the motion"],
        ),
    ] {
        let parts = format!("attitude: {{ {rest}, {gains} }}");
        refused((BALL, "", &hold("ball", &parts)), "drive", &words);
    }
}

#[test]
fn targets_and_gains_have_their_shapes_and_units() {
    for (part, rule, word) in [
        (
            "position: { target: [0, 0], stiffness: 1 }",
            "drive",
            "a list of 2; 3",
        ),
        (
            "position: { target: [0, 0, 0], stiffness: [1, 2] }",
            "drive",
            "a list of 2; 3",
        ),
        (
            "attitude: { target: { quaternion: [0, 0, 1] }, stiffness: 1 }",
            "drive",
            "a list of 3; 4",
        ),
        (
            "attitude: { target: { rpy: [0, 0, 0], quaternion: [0, 0, 0, 1] }, stiffness: 1 }",
            "drive",
            "one orientation",
        ),
        (
            "attitude: { target: { euler: [0, 0, 0] }, stiffness: 1 }",
            "unknown-key",
            "rpy",
        ),
        (
            "attitude: { target: { rpy: [0, 0, 0] }, stiff: 1 }",
            "unknown-key",
            "stiffness",
        ),
        (
            "attitude: { target: { rpy: [0, 0, 0] }, stiffness: 1 N/m }",
            "unit-misfit",
            "N/m",
        ),
        (
            "position: { target: [0, 0, 1 rad], stiffness: 1 }",
            "unit-misfit",
            "rad",
        ),
    ] {
        refused((FREE, "", &hold("free", part)), rule, &[word]);
    }
}

#[test]
fn an_effort_has_one_source() {
    let input = "inputs: { free: { hold: { attitude: { target: { rpy: [0, 0, 0] }, stiffness: 1 } } }, free_rx: 2 }";
    refused((FREE, "", input), "drive", &["`free_rx`", "`free`"]);
    let input = "inputs: { free_rx: 2, free: { hold: { attitude: { target: { rpy: [0, 0, 0] }, stiffness: 1 } } } }";
    refused((FREE, "", input), "drive", &["`free_rx`", "`free`"]);
}

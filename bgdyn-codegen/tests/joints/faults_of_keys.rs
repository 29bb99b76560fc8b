//! Faults of the keys of joints: rule, place, and help.

use bgdyn_codegen::fault::Severity;
use bgdyn_codegen::mechanism::Limits;

use super::findings::*;

#[test]
fn joints_without_an_axis() {
    for kind in ["spherical", "floating", "planar"] {
        refused(
            &[&format!("name: j, type: {kind}, axis: x")],
            "axis-of-joint",
            "links[0].joint.axis",
            &[
                &format!("a {kind} joint has no axis"),
                "leave `axis` out",
                "rpy",
            ],
        );
    }
}

#[test]
fn second_axes() {
    refused(
        &["name: j, type: universal, axis: x"],
        "no-second-axis",
        "links[0].joint",
        &["needs its second axis", "axis2: y"],
    );
    for axes in [
        "axis: x, axis2: x",
        "axis: x, axis2: -x",
        "axis2: z",
        "axis: [1, 2, 3], axis2: [-2, -4, -6]",
        "axis: [0.3, 0.1, 0.7], axis2: [0.9, 0.3, 2.1]",
    ] {
        refused(
            &[&format!("name: j, type: universal, {axes}")],
            "parallel-axes",
            "links[0].joint.axis2",
            &["`axis2` is parallel to `axis`", "type: revolute"],
        );
    }
    sound(&["name: j, type: universal, axis: [1, 2, 2], axis2: [2, 1, -2]"]);
}

/// Axes that are not perpendicular are allowed, with a warning.
#[test]
fn oblique_axes() {
    warned(
        &["name: j, type: universal, axis: x, axis2: [1, 1, 0]"],
        "oblique-axes",
        "links[0].joint.axis2",
        &["45°", "right angle"],
    );
}

/// A floating joint on a moving link is allowed, with a warning.
#[test]
fn floating_on_a_link() {
    let text = format!(
        "{HEAD}  - {{ name: cart, joint: {{ name: slide, type: prismatic }}, {BODY} }}\n  \
         - {{ name: drone, parent: cart, joint: {{ name: free, type: floating }}, {BODY} }}\n"
    );
    let fault = one(&text);
    assert_eq!(
        (fault.rule, fault.severity),
        ("floating-on-link", Severity::Warning)
    );
    assert!(fault.message.contains("`free`") && fault.message.contains("`cart`"));
}

#[test]
fn keys_of_other_joints() {
    for kind in [
        "revolute",
        "continuous",
        "prismatic",
        "helical, lead: 1 mm",
        "cylindrical",
        "spherical",
        "floating",
        "planar",
    ] {
        let word = kind.split(',').next().expect("a word");
        refused(
            &[&format!("name: j, type: {kind}, axis2: y")],
            "key-of-other-joint",
            "links[0].joint.axis2",
            &[
                &format!("a {word} joint has no `axis2`"),
                "leave `axis2` out",
                "type: universal",
            ],
        );
    }
    for kind in [
        "revolute",
        "prismatic",
        "cylindrical",
        "universal, axis: x, axis2: y",
        "spherical",
        "fixed",
    ] {
        let word = kind.split(',').next().expect("a word");
        refused(
            &[&format!("name: j, type: {kind}, lead: 5 mm")],
            "key-of-other-joint",
            "links[0].joint.lead",
            &[&format!("a {word} joint has no `lead`"), "type: helical"],
        );
    }
    for kind in [
        "revolute",
        "planar",
        "universal, axis: x, axis2: y",
        "helical, lead: 1 mm",
    ] {
        let word = kind.split(',').next().expect("a word");
        refused(
            &[&format!("name: j, type: {kind}, quaternion: any")],
            "key-of-other-joint",
            "links[0].joint.quaternion",
            &[
                &format!("a {word} joint has no `quaternion`"),
                "type: spherical` or `floating`",
            ],
        );
    }
}

#[test]
fn leads() {
    refused(
        &["name: j, type: helical"],
        "no-lead",
        "links[0].joint",
        &["needs its lead", "5 mm", "full turn", "mm/rad"],
    );
    for lead in ["0", "0 mm", "-0.0", "0 mm/rad"] {
        refused(
            &[&format!("name: j, type: helical, lead: {lead}")],
            "zero-lead",
            "links[0].joint.lead",
            &["does not advance", "type: revolute"],
        );
    }
    for lead in ["5 deg", "5 kg", "5 rad/m"] {
        refused(
            &[&format!("name: j, type: helical, lead: {lead}")],
            "unit-misfit",
            "links[0].joint.lead",
            &["length", "mm/turn", "mm/rad"],
        );
    }
}

#[test]
fn lengths_of_quaternions() {
    for (kind, word) in [
        ("spherical", "unit"),
        ("floating", "Any"),
        ("floating", "all"),
    ] {
        refused(
            &[&format!("name: j, type: {kind}, quaternion: {word}")],
            "unknown-quaternion",
            "links[0].joint.quaternion",
            &[&format!("`{word}`"), "any length", "must be 1"],
        );
    }
    sound(&["name: j, type: spherical, quaternion: any"]);
}

#[test]
fn limits_of_joints_of_several_degrees() {
    for kind in ["spherical", "floating", "planar"] {
        refused(
            &[&format!("name: j, type: {kind}, limits: {{ velocity: 1 }}")],
            "limits-of-joint",
            "links[0].joint.limits",
            &[
                &format!("a {kind} joint has no limits"),
                "leave `limits` out",
            ],
        );
    }
    for (kind, part, keyword) in [
        ("cylindrical", "first", "cylindrical"),
        ("universal, axis: x, axis2: y", "slide", "universal"),
        ("revolute", "turn", "revolute"),
        ("helical, lead: 1 mm", "slide", "helical"),
    ] {
        refused(
            &[&format!(
                "name: j, type: {kind}, limits: {{ {part}: {{ velocity: 1 }} }}"
            )],
            "limits-of-part",
            &format!("links[0].joint.limits.{part}"),
            &[
                &format!("a {keyword} joint has no part `{part}`"),
                "`cylindrical`",
                "`universal`",
            ],
        );
    }
    for (kind, keyword, parts) in [
        ("cylindrical", "cylindrical", ["turn", "slide"]),
        (
            "universal, axis: x, axis2: y",
            "universal",
            ["first", "second"],
        ),
    ] {
        for key in ["lower: -1", "upper: 1", "velocity: 1", "effort: 1"] {
            let word = key.split(':').next().expect("a key");
            refused(
                &[&format!("name: j, type: {kind}, limits: {{ {key} }}")],
                "limits-of-chain",
                &format!("links[0].joint.limits.{word}"),
                &[
                    &format!("a {keyword} joint has limits for each"),
                    "limits: {",
                    parts[0],
                    parts[1],
                ],
            );
        }
    }
}

/// Parts have no parts.
#[test]
fn parts_of_parts() {
    refused(
        &["name: j, type: cylindrical, limits: { slide: { turn: { lower: 0 } } }"],
        "unknown-key",
        "links[0].joint.limits.slide",
        &["`turn`", "`lower`"],
    );
}

/// Units and order of the limits of parts.
#[test]
fn limits_of_parts_have_their_units() {
    let cylindrical = |limits: &str| format!("name: j, type: cylindrical, limits: {{ {limits} }}");
    for (limits, path) in [
        ("turn: { lower: -3 mm }", "turn.lower"),
        ("slide: { upper: 3 deg }", "slide.upper"),
        ("turn: { velocity: 3 m/s }", "turn.velocity"),
        ("slide: { effort: 3 N*m }", "slide.effort"),
    ] {
        let path = format!("links[0].joint.limits.{path}");
        refused(&[&cylindrical(limits)], "unit-misfit", &path, &[]);
    }
    refused(
        &[&cylindrical("slide: { lower: 2 cm, upper: 1 cm }")],
        "lower-above-upper",
        "links[0].joint.limits.slide.lower",
        &[],
    );
    let robot = sound(&[&cylindrical(
        "turn: { velocity: 3 }, slide: { lower: 1 cm, upper: 12 cm }",
    )]);
    let limits: Vec<Limits> = robot
        .mechanism
        .links()
        .iter()
        .map(|l| l.joint.limits)
        .collect();
    let turn = Limits {
        velocity: Some(3.0),
        ..Limits::default()
    };
    let slide = Limits {
        lower: Some(0.01),
        upper: Some(0.12),
        ..Limits::default()
    };
    assert_eq!(limits, [turn, slide]);
    let robot = sound(&[
        "name: j, type: universal, axis: x, axis2: y, limits: { second: { upper: 90 deg } }",
    ]);
    let limits: Vec<Limits> = robot
        .mechanism
        .links()
        .iter()
        .map(|l| l.joint.limits)
        .collect();
    assert_eq!(limits[0], Limits::default());
    assert!((limits[1].upper.expect("a limit") - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
}

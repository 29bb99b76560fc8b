//! Faults of joints: rule, place, and help.

use bgdyn_codegen::fault::{Fault, Faults};
use bgdyn_codegen::mechanism::Limits;
use bgdyn_codegen::read_scene;
use bgdyn_codegen::refusal::Refusal;

use super::robot::Robot;

const HEAD: &str = "format: 1\nname: arm\nlinks:\n";
const BODY: &str = "mass: 1, inertia: { xx: 1, yy: 1, zz: 1 }";

/// A mechanism of links with these joints, each on the world.
fn with_joints(joints: &[&str]) -> String {
    let mut text = HEAD.to_owned();
    for (i, joint) in joints.iter().enumerate() {
        text += &format!("  - {{ name: l{i}, joint: {{ {joint} }}, {BODY} }}\n");
    }
    text
}

fn found(text: &str) -> Faults {
    let (mechanism, faults) = bgdyn_codegen::read(text, None);
    assert_eq!(mechanism.is_none(), faults.any_fault(), "{text}");
    faults
}

/// Asserts exactly one finding.
fn one(text: &str) -> Fault {
    let faults = found(text);
    assert_eq!(
        faults.0.len(),
        1,
        "{text}\n{}",
        faults.render("arm.yaml", text)
    );
    faults.0[0].clone()
}

/// Asserts exactly one fault with this rule at this path, and these words in message and help.
fn refused(joints: &[&str], rule: &str, path: &str, words: &[&str]) {
    let text = with_joints(joints);
    let fault = one(&text);
    let help = fault.help.clone().unwrap_or_default();
    let said = format!("{}\n{help}", fault.message);
    assert_eq!(
        (fault.rule, fault.path.as_str()),
        (rule, path),
        "{text}\n{said}"
    );
    assert!(!help.is_empty(), "{rule}: no help");
    assert!(!said.contains("  "), "{rule}: a gap in {said:?}");
    for word in words {
        assert!(said.contains(word), "{rule}: no {word:?} in {said:?}");
    }
    // The position is that of the line of the link, after its dash.
    let line = 4 + path["links[".len()..]
        .split(']')
        .next()
        .map_or(0, |i| i.parse::<usize>().expect("an index"));
    assert_eq!(fault.position.line, line, "{rule}");
}

fn sound(joints: &[&str]) -> Robot {
    let text = with_joints(joints);
    let faults = found(&text);
    assert_eq!(
        faults,
        Faults::default(),
        "{}",
        faults.render("arm.yaml", &text)
    );
    Robot::read(&text)
}

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
    sound(&["name: j, type: universal, axis: x, axis2: [1, 0.01, 0]"]);
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

const LEADER: &str = "name: grip, type: prismatic, axis: y";

#[test]
fn joints_that_cannot_mimic() {
    for kind in [
        "spherical",
        "floating",
        "planar",
        "cylindrical",
        "universal, axis: x, axis2: y",
        "fixed",
    ] {
        let word = kind.split(',').next().expect("a word");
        refused(
            &[
                LEADER,
                &format!("name: j, type: {kind}, mimic: {{ joint: grip }}"),
            ],
            "mimic-of-joint",
            "links[1].joint.mimic",
            &[
                &format!("a {word} joint cannot mimic"),
                "`revolute`",
                "`helical`",
            ],
        );
    }
}

#[test]
fn leaders_that_are_none() {
    refused(
        &[LEADER, "name: j, type: prismatic, mimic: { joint: gripp }"],
        "unknown-leader",
        "links[1].joint.mimic.joint",
        &["no joint is called `gripp`", "did you mean `grip`?"],
    );
    refused(
        &[
            LEADER,
            "name: j, type: prismatic, mimic: { joint: something_else }",
        ],
        "unknown-leader",
        "links[1].joint.mimic.joint",
        &["the joints are `grip`, `j`"],
    );
    for kind in ["spherical", "floating", "planar", "fixed"] {
        refused(
            &[
                &format!("name: lead, type: {kind}"),
                "name: j, type: revolute, mimic: { joint: lead }",
            ],
            "leader-of-type",
            "links[1].joint.mimic.joint",
            &[
                &format!("`lead` is a {kind} joint"),
                "revolute, continuous, prismatic or helical",
            ],
        );
    }
}

/// A joint that is two in series is there: it must not be said that no joint has its name.
#[test]
#[ignore = "open: a chain of joints is reported as unknown"]
fn leaders_of_two_degrees() {
    for kind in ["cylindrical", "universal, axis: x, axis2: y"] {
        let word = kind.split(',').next().expect("a word");
        refused(
            &[
                &format!("name: lead, type: {kind}"),
                "name: j, type: revolute, mimic: { joint: lead }",
            ],
            "leader-of-type",
            "links[1].joint.mimic.joint",
            &[&format!("`lead` is a {word} joint")],
        );
    }
}

#[test]
fn ratios_and_offsets() {
    const TURN: &str = "name: turn, type: revolute";
    const SCREW: &str = "name: screw, type: helical, lead: 5 mm";
    let zero = [
        (LEADER, "prismatic", "grip", "0"),
        (TURN, "prismatic", "turn", "0 mm/rad"),
        (LEADER, "revolute", "grip", "-0 rad/m"),
    ];
    for (leader, kind, name, ratio) in zero {
        refused(
            &[
                leader,
                &format!("name: j, type: {kind}, mimic: {{ joint: {name}, ratio: {ratio} }}"),
            ],
            "zero-ratio",
            "links[1].joint.mimic.ratio",
            &["ratio 0", "does not move", "type: fixed"],
        );
    }
    for (leader, kind, name, ratio) in [
        (LEADER, "prismatic", "grip", "1 mm/rad"),
        (LEADER, "prismatic", "grip", "1 rad/m"),
        (LEADER, "revolute", "grip", "1 m/rad"),
        (TURN, "prismatic", "turn", "1 rad/m"),
        (TURN, "revolute", "turn", "1 mm/rad"),
        (SCREW, "prismatic", "screw", "1 rad/m"),
        (LEADER, "helical, lead: 1 mm", "grip", "2 mm/turn"),
    ] {
        refused(
            &[
                leader,
                &format!("name: j, type: {kind}, mimic: {{ joint: {name}, ratio: {ratio} }}"),
            ],
            "unit-misfit",
            "links[1].joint.mimic.ratio",
            &[],
        );
    }
    for (leader, kind, name, offset) in [
        (LEADER, "prismatic", "grip", "3 deg"),
        (LEADER, "revolute", "grip", "3 mm"),
        (TURN, "prismatic", "turn", "3 rad"),
        (TURN, "helical, lead: 1 mm", "turn", "3 cm"),
        (TURN, "revolute", "turn", "3 kg"),
    ] {
        refused(
            &[
                leader,
                &format!("name: j, type: {kind}, mimic: {{ joint: {name}, offset: {offset} }}"),
            ],
            "unit-misfit",
            "links[1].joint.mimic.offset",
            &[],
        );
    }
    sound(&[
        LEADER,
        "name: j, type: revolute, mimic: { joint: grip, ratio: 2 rad/m, offset: 3 deg }",
    ]);
    sound(&[
        TURN,
        "name: j, type: prismatic, mimic: { joint: turn, ratio: 2 mm/turn, offset: 3 mm }",
    ]);
    sound(&[
        SCREW,
        "name: j, type: revolute, mimic: { joint: screw, ratio: 2, offset: 3 deg }",
    ]);
}

/// The units that the file's parser refuses before it knows the joints.
#[test]
#[ignore = "open: the help names no unit for a plain number"]
fn ratios_of_no_relation() {
    for (ratio, what) in [
        ("1 kg", "a mass"),
        ("1 deg", "an angle"),
        ("1 mm", "a length"),
    ] {
        refused(
            &[
                LEADER,
                &format!("name: j, type: prismatic, mimic: {{ joint: grip, ratio: {ratio} }}"),
            ],
            "unit-misfit",
            "links[1].joint.mimic.ratio",
            &[&format!("`{ratio}` is {what}"), "rad/m", "mm/turn"],
        );
    }
}

#[test]
fn circles() {
    let follower = |name: &str, leader: &str| {
        format!("name: {name}, type: revolute, mimic: {{ joint: {leader} }}")
    };
    let circle = |joints: &[String], at: &str, path: &str| {
        let joints: Vec<&str> = joints.iter().map(String::as_str).collect();
        refused(
            &joints,
            "mimic-circle",
            at,
            &[path, "leave `mimic` out of one"],
        );
    };
    circle(&[follower("a", "a")], "links[0].joint.mimic", ": a → a");
    circle(
        &[follower("a", "b"), follower("b", "a")],
        "links[0].joint.mimic",
        ": a → b → a",
    );
    // A tail that leads into the circle is no part of it.
    circle(
        &[
            follower("t", "b"),
            follower("a", "b"),
            follower("b", "c"),
            follower("c", "a"),
        ],
        "links[2].joint.mimic",
        ": b → c → a → b",
    );
}

/// The limits of the first joint of a mechanism.
fn limits(joints: &[&str]) -> Limits {
    sound(joints).mechanism.links()[0].joint.limits
}

fn near(found: Option<f64>, expected: f64) {
    let found = found.expect("a limit");
    assert!((found - expected).abs() <= 1e-15, "{found} not {expected}");
}

#[test]
fn limits_of_followers_are_limits_of_leaders() {
    let leader =
        "name: grip, type: prismatic, limits: { lower: 0, upper: 40 mm, velocity: 2, effort: 100 }";
    let follower = |keys: &str, limits: &str| {
        format!(
            "name: j, type: prismatic, mimic: {{ joint: grip, {keys} }}, limits: {{ {limits} }}"
        )
    };
    let all = "lower: -50 mm, upper: 30 mm, velocity: 1, effort: 10";
    // (x − 0.01)/−2: −0.01 … 0.03.
    let found = limits(&[leader, &follower("ratio: -2, offset: 10 mm", all)]);
    near(found.lower, 0.0);
    near(found.upper, 0.03);
    near(found.velocity, 0.5);
    near(found.effort, 20.0);
    // (x − 0.01)/2: −0.03 … 0.01.
    let found = limits(&[leader, &follower("ratio: 2, offset: 10 mm", all)]);
    near(found.lower, 0.0);
    near(found.upper, 0.01);
    // One side only, with a ratio that turns it: q ≥ 0.005.
    let found = limits(&[leader, &follower("ratio: -1", "upper: -5 mm")]);
    near(found.lower, 0.005);
    near(found.upper, 0.04);
    near(found.velocity, 2.0);
    near(found.effort, 100.0);
    // A leader without limits has its followers'; two of them, and the follower of a follower.
    let first = "name: f, type: prismatic, mimic: { joint: lead, ratio: 30 mm/rad, offset: 6 mm }, limits: { lower: 0, velocity: 0.3 }";
    let second = "name: s, type: revolute, mimic: { joint: f, ratio: -100 rad/m, offset: 0.2 }, limits: { lower: -1, velocity: 6, effort: 3 }";
    for order in [[first, second], [second, first]] {
        // lead is joint 0; s = −3 q − 0.4.
        let found = limits(&["name: lead, type: revolute", order[0], order[1]]);
        near(found.lower, -0.2);
        near(found.upper, 0.2);
        near(found.velocity, 2.0);
        near(found.effort, 9.0);
    }
    // Limits that touch leave one position.
    let found = limits(&[leader, &follower("ratio: 1", "lower: 40 mm")]);
    assert_eq!((found.lower, found.upper), (Some(0.04), Some(0.04)));
}

#[test]
fn limits_that_exclude_each_other() {
    let leader = "name: grip, type: prismatic, limits: { lower: 0, upper: 40 mm }";
    refused(
        &[
            leader,
            "name: j, type: prismatic, mimic: { joint: grip, ratio: -2, offset: 10 mm }, limits: { lower: 20 mm, upper: 30 mm }",
        ],
        "mimic-empty-range",
        "links[1].joint.mimic",
        &[
            "`grip`",
            "at least 0 and at most -0.005",
            "`ratio`, `offset` or one of the limits",
        ],
    );
    // Two followers of a leader without limits.
    refused(
        &[
            "name: grip, type: prismatic",
            "name: a, type: prismatic, mimic: { joint: grip }, limits: { lower: 3 mm }",
            "name: b, type: prismatic, mimic: { joint: grip }, limits: { upper: 2 mm }",
        ],
        "mimic-empty-range",
        "links[2].joint.mimic",
        &["at least 0.003 and at most 0.002"],
    );
}

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
#[ignore = "open: a second fault before the one that counts"]
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
#[ignore = "open: two velocities may get one name"]
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
#[ignore = "open: no warning for joints with several velocities"]
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

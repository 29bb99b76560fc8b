//! Faults of joints that mimic others, and the limits that they share.

use bgdyn_codegen::mechanism::Limits;

use super::findings::*;

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
                &format!(
                    "name: j, type: {kind}, mimic: {{ joint: {name}, ratio: 2, offset: {offset} }}"
                ),
            ],
            "unit-misfit",
            "links[1].joint.mimic.offset",
            &[],
        );
    }
    // Between an angle and a length 1 would be a guess.
    for (leader, kind, name, unit) in [
        (LEADER, "revolute", "grip", "rad/m"),
        (TURN, "prismatic", "turn", "mm/turn"),
    ] {
        refused(
            &[
                leader,
                &format!("name: j, type: {kind}, mimic: {{ joint: {name} }}"),
            ],
            "ratio-needed",
            "links[1].joint.mimic",
            &[&format!("`{name}`"), unit],
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

//! Faults of constraints: each with its place, its rule and the numbers seen.

use super::findings::{found, refused_text, with_joints};

const JOINTS: [&str; 4] = [
    "name: left, type: revolute",
    "name: right, type: continuous, axis: y",
    "name: slide, type: prismatic, axis: x",
    "name: ball, type: spherical",
];

/// Asserts exactly one fault of a file with these constraints, and further keys.
fn refused(constraints: &str, more: &str, rule: &str, path: &str, words: &[&str]) {
    let text = format!("{}constraints:\n{constraints}{more}", with_joints(&JOINTS));
    refused_text(&text, rule, path, words);
}

fn one(entry: &str, rule: &str, path: &str, words: &[&str]) {
    let path = format!("constraints.c{path}");
    refused(&format!("  c: {entry}\n"), "", rule, &path, words);
}

#[test]
fn keys_and_types() {
    one(
        "{ joints: { left: 1 } }",
        "missing-key",
        "",
        &["`c` has no `type`", "`gear`", "`linear`"],
    );
    one(
        "{ type: geer }",
        "unknown-constraint-type",
        ".type",
        &["`geer`", "did you mean `gear`?"],
    );
    one(
        "{ type: gear }",
        "missing-key",
        "",
        &["`c` has no `joints`", "-1/50"],
    );
    one("{ type: linear }", "missing-key", "", &["`c` has no `row`"]);
    one(
        "{ type: linear, joints: { left: 1 } }",
        "unknown-key",
        "",
        &["`joints`", "`row`"],
    );
    one(
        "{ type: gear, joints: {} }",
        "empty-row",
        ".joints",
        &["`c` contains no joint", "at least two"],
    );
}

#[test]
fn names() {
    one(
        "{ type: gear, joints: { lift: 1, right: 1 } }",
        "unknown-name",
        ".joints.lift",
        &["`lift`", "did you mean `left`?"],
    );
    one(
        "{ type: gear, joints: { ball: 1, right: 1 } }",
        "constraint-on-joint",
        ".joints.ball",
        &["spherical"],
    );
    refused(
        "  left: { type: gear, joints: { left: 1, right: 1 } }\n",
        "",
        "repeated-name",
        "constraints.left",
        &["`left`"],
    );
    refused(
        "  Left: { type: gear, joints: { left: 1, right: 1 } }\n",
        "",
        "name",
        "constraints.Left",
        &["`Left`"],
    );
}

#[test]
fn coefficients() {
    one(
        "{ type: gear, joints: { left: 0, right: 1 } }",
        "zero-coefficient",
        ".joints.left",
        &["`left`"],
    );
    one(
        "{ type: gear, joints: { left: 1/0, right: 1 } }",
        "division-by-zero",
        ".joints.left",
        &["`1/0`", "1/50"],
    );
    one(
        "{ type: gear, joints: { left: 1, slide: 3 } }",
        "mixed-row",
        ".joints.slide",
        &["a length", "an angle", "`rad/m`"],
    );
    one(
        "{ type: gear, joints: { left: 1 m/rad, right: 1 } }",
        "mixed-row",
        ".joints.right",
        &["an angle", "a length"],
    );
    one(
        "{ type: gear, joints: { left: 1 rad/m, right: 1 } }",
        "unit-misfit",
        ".joints.left",
        &["rad/m"],
    );
    one(
        "{ type: gear, joints: { left: 1, right: 1 }, offset: 3 mm }",
        "unit-misfit",
        ".offset",
        &["3 mm"],
    );
}

#[test]
fn rows_that_determine_nothing() {
    let pair = "  a: { type: gear, joints: { left: 1, right: 2 } }\n";
    let twice = "  b: { type: gear, joints: { left: -3, right: -6 } }\n";
    let other = "  b: { type: gear, joints: { left: -3, right: -6 }, offset: 0.3 }\n";
    refused(
        &format!("{pair}{twice}"),
        "",
        "dependent-row",
        "constraints.a",
        &["`a` follows from others", "-0.333333 · `b`"],
    );
    refused(
        &format!("{pair}{other}"),
        "",
        "contradicting-rows",
        "constraints.a",
        &["`b`", "0.1"],
    );
    let rates = "  b: { type: linear, row: { left: 1/2, right: 1 } }\n";
    refused(
        &format!("{pair}{rates}"),
        "",
        "dependent-row",
        "constraints.b",
        &["`b`", "cancel"],
    );
    let both = "  b: { type: gear, joints: { left: 1, right: -2 }, offset: 0.5 }\n";
    let text = format!("{}constraints:\n{pair}{both}", with_joints(&JOINTS));
    let faults = found(&text);
    let of = |word: &str| {
        faults
            .0
            .iter()
            .any(|f| f.rule == "no-motion-left" && f.message.contains(word))
    };
    assert!(
        of("`left` no motion: it is fixed at 0.25"),
        "{}",
        faults.render("arm.yaml", &text)
    );
    assert!(
        of("`right` no motion: it is fixed at -0.125"),
        "{}",
        faults.render("arm.yaml", &text)
    );
}

#[test]
fn independent_joints() {
    let pair = "  a: { type: gear, joints: { left: 1, right: 2 } }\n";
    refused(
        pair,
        "independent: [left, right]\n",
        "too-many-independents",
        "constraints.a",
        &["`left`, `right`"],
    );
    refused(
        pair,
        "independent: [rigth]\n",
        "unknown-name",
        "independent[0]",
        &["`rigth`", "`right`"],
    );
    refused(
        pair,
        "independent: [ball]\n",
        "constraint-on-joint",
        "independent[0]",
        &["spherical"],
    );
}

/// 1 + (1/3)(−3) = 0: what cancels by a `mimic` is no coefficient, however it is rounded.
#[test]
fn coefficients_that_cancel_by_a_mimic() {
    let text = |ratio: &str, k: &str, offset: &str| {
        let joints = [
            "name: left, type: revolute".to_owned(),
            format!(
                "name: right, type: revolute, mimic: {{ joint: left, ratio: {ratio}, offset: {offset} }}"
            ),
        ];
        let joints: Vec<&str> = joints.iter().map(String::as_str).collect();
        with_joints(&joints)
            + &format!("constraints:\n  c: {{ type: gear, joints: {{ left: 1, right: {k} }} }}\n")
    };
    for (ratio, k, offset, rule) in [
        ("-3", "1/3", "0", "dependent-row"),
        ("-7/11", "11/7", "0", "dependent-row"),
        ("-1.1", "10/11", "0.25", "contradicting-rows"),
    ] {
        let text = text(ratio, k, offset);
        let faults = found(&text);
        let rules: Vec<&str> = faults.0.iter().map(|fault| fault.rule).collect();
        assert_eq!(rules, [rule], "{}", faults.render("arm.yaml", &text));
        assert!(
            faults.0[0].message.contains("cancel"),
            "{}",
            faults.0[0].message
        );
    }
}

#[test]
fn rows_on_velocities() {
    one(
        "{ type: linear, row: { left: 2 } }",
        "no-motion-left",
        "",
        &["`left` no motion", "its velocity is 0"],
    );
    // The offset of a gear is none of the velocities.
    let gear = "  a: { type: gear, joints: { left: 1, right: 2 }, offset: 0.3 }\n";
    let rates = "  b: { type: linear, row: { left: 1/2, right: 1 } }\n";
    refused(
        &format!("{gear}{rates}"),
        "",
        "dependent-row",
        "constraints.b",
        &["`b`", "cancel"],
    );
}

#[test]
fn limits_and_names_and_mimics() {
    let joints = [
        "name: left, type: revolute, limits: { lower: 0, upper: 1 }",
        "name: right, type: revolute, limits: { lower: 3, upper: 4 }",
        "name: third, type: revolute, mimic: { joint: left }",
    ];
    let frames = "frames:\n  - { name: tip, link: l0 }\n";
    for (constraints, rule, path, word) in [
        (
            "constraints:\n  c: { type: gear, joints: { left: 1, right: -1 } }\n",
            "constraint-empty-range",
            "constraints.c",
            "at least 3 and at most 1",
        ),
        (
            "constraints:\n  tip: { type: gear, joints: { left: 3, right: -1 } }\n",
            "repeated-name",
            "constraints.tip",
            "`tip`",
        ),
        (
            "independent: [third]\n",
            "independent-follower",
            "independent[0]",
            "it follows `left`",
        ),
    ] {
        let text = with_joints(&joints) + frames + constraints;
        let faults = found(&text);
        let shown = faults.render("arm.yaml", &text);
        assert_eq!(faults.0.len(), 1, "{shown}");
        let fault = &faults.0[0];
        assert_eq!((fault.rule, fault.path.as_str()), (rule, path), "{shown}");
        assert!(fault.message.contains(word), "{shown}");
    }
}

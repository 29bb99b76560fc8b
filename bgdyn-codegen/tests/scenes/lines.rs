//! Checks that effects along a line need a line whose length can change.

use bgdyn_codegen::refusal::Refusal;

use super::common::try_scene;

/// Two turning links and a turn at the hand whose axis goes through its own origin; places on all of them.
const MECHANISM: &str = "\
format: 1
name: arm
links:
  - name: stand
    joint: { type: fixed, origin: { xyz: [0, 0, 0.3], rpy: [0.2, 0, 0.7] } }
  - name: upper
    parent: stand
    joint: { name: shoulder, type: revolute, axis: y }
    mass: 2
    com: [0.2, 0, 0]
  - name: lower
    parent: upper
    joint: { name: elbow, type: revolute, axis: [1, 2, 3], origin: { xyz: [0.4, 0.1, 0], rpy: [0.3, 0.4, 0.5] } }
    mass: 1
    com: [0.2, 0, 0]
  - name: hand
    parent: lower
    joint: { name: wrist, type: revolute, axis: x, origin: { xyz: [0.3, 0, 0] } }
    mass: 0.1
  - name: rod
    parent: hand
    joint: { name: slide, type: prismatic, axis: x }
    mass: 0.1
frames:
  - { name: anchor, link: world, origin: { xyz: [1, 2, 3] } }
  - { name: rail, link: world, origin: { xyz: [1, 0, 3] } }
  - { name: foot, link: stand, origin: { xyz: [0.1, 0, 0] } }
  - { name: lug, link: upper, origin: { xyz: [0.2, 0, 0.1] } }
  - { name: ear, link: upper, origin: { xyz: [0.1, 0, 0.1] } }
  - { name: bolt, link: upper, origin: { xyz: [0, 0.3, 0] } }
  - { name: tip, link: hand, origin: { xyz: [0.3, 0, 0] } }
  - { name: side, link: hand, origin: { xyz: [0.3, 0.1, 0] } }
";

const WAYS: [&str; 3] = [
    "type: spring, stiffness: 50",
    "type: damper, damping: 3",
    "type: cylinder, area_a: 10 cm^2, offset: 0.1, dead_a: 1 cm^3, stroke: 3",
];

fn tried(way: &str, [a, b]: [&str; 2], lock: &str) -> Result<(), String> {
    let effect = format!("it: {{ {way}, between: [{a}, {b}] }}");
    let text =
        format!("scene: 1\nmechanism: arm.yaml\n{lock}effects:\n  - inertia\n  - {effect}\n");
    match try_scene(&text, MECHANISM) {
        Ok(_) => Ok(()),
        Err(Refusal::Spec(faults)) => {
            let fault = faults
                .0
                .iter()
                .find(|fault| fault.rule == "constant-distance");
            let Some(fault) = fault else { return Ok(()) };
            let line = text
                .lines()
                .nth(fault.position.line - 1)
                .unwrap_or_default();
            let rest: String = line.chars().skip(fault.position.column - 1).collect();
            assert!(rest.starts_with('['), "{rest}");
            Err(fault.message.clone())
        }
        Err(other) => panic!("{other:?}"),
    }
}

#[test]
fn a_line_that_keeps_its_length_is_refused() {
    let pairs = [
        ["anchor", "anchor"],
        ["upper", "upper"],
        ["anchor", "rail"],
        ["anchor", "stand"],
        ["foot", "rail"],
        ["lug", "ear"],
        ["upper", "lug"],
        // Through joints: on the axis, at the centre of rotation.
        ["stand", "upper"],
        ["stand", "bolt"],
        ["anchor", "bolt"],
        ["lower", "tip"],
        ["lug", "lower"],
    ];
    for way in WAYS {
        for [a, b] in pairs {
            for pair in [[a, b], [b, a]] {
                let message = tried(way, pair, "").expect_err(&format!("{way}: {pair:?}"));
                assert!(message.contains(a) && message.contains(b), "{message}");
            }
        }
    }
    let message = tried(WAYS[0], ["anchor", "rail"], "").expect_err("both stand in the world");
    assert!(message.contains("2 m apart"), "{message}");
}

#[test]
fn a_line_that_changes_its_length_is_taken() {
    let pairs = [
        ["anchor", "lug"],
        ["foot", "lug"],
        ["bolt", "tip"],
        ["side", "lug"],
        ["lower", "rod"],
        ["hand", "rod"],
        ["anchor", "tip"],
    ];
    for way in WAYS {
        for [a, b] in pairs {
            assert_eq!(tried(way, [a, b], ""), Ok(()), "{way}: {a}, {b}");
        }
    }
}

#[test]
fn a_lock_makes_two_links_one_body() {
    for way in WAYS {
        assert_eq!(tried(way, ["lug", "side"], ""), Ok(()));
        assert_eq!(
            tried(way, ["foot", "lug"], "lock: { elbow: 0.3 }\n"),
            Ok(())
        );
        tried(way, ["lug", "tip"], "lock: { elbow: 0.3 }\n").expect_err("on the wrist's axis");
        tried(way, ["foot", "lug"], "lock: { shoulder: 0.3 }\n").expect_err("one body");
        assert_eq!(
            tried(way, ["lug", "side"], "lock: { elbow: 0.3 }\n"),
            Ok(())
        );
    }
}

#[test]
fn a_mechanism_that_declares_one_is_refused_by_itself() {
    let text = MECHANISM.to_owned()
        + "effects:\n  rope: { type: spring, between: [lug, ear], stiffness: 5 }\n";
    let (mechanism, faults) = bgdyn_codegen::read(&text, Some("arm"));
    assert!(mechanism.is_none());
    let rules: Vec<_> = faults.0.iter().map(|fault| fault.rule).collect();
    assert!(rules.contains(&"constant-distance"), "{rules:?}");
}

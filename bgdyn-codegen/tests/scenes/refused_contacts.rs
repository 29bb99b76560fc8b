//! Tests what contact laws refuse: the rule, the location, the words.

use super::common::{told, try_scene};

const BALL: &str = "
format: 1
links:
  - { name: ball, mass: 2 kg, joint: { name: fall, type: prismatic, axis: z } }
  - { name: other, mass: 2 kg, joint: { name: slide, type: prismatic, axis: x } }
contacts:
  floor: { link: ball, radius: 10 mm }
  cube: { link: ball, size: [0.1, 0.1, 0.1] }
  knock: { link: ball, radius: 10 mm, with: other, with_radius: 10 mm }
";

/// Returns the message about a contact law with these keys, unless it has this rule and these words, at the law's line.
fn unlike(keys: &str, rule: &str, words: &str) -> Option<String> {
    let scene = format!(
        "scene: 1\nmechanism: m.yaml\neffects:\n  - inertia\n  - touch: {{ type: compliant_contact, {keys} }}\n"
    );
    let refusal = try_scene(&scene, BALL).expect_err(keys);
    let text = told(&refusal, &scene);
    let has = [&format!("[{rule}]"), words, ":5:"]
        .iter()
        .all(|part| text.contains(*part));
    (!has).then(|| format!("{keys}, not [{rule}] {words}: {text}"))
}

#[test]
fn what_contact_laws_refuse() {
    let sound = "contact: floor, stiffness: 1e5";
    let mut others: Vec<String> = Vec::new();
    for (keys, rule, words) in [
        ("contact: flor, stiffness: 1e5", "unknown-name", "`floor`"),
        ("stiffness: 1e5", "effect-missing", "`contact`"),
        ("contact: floor", "effect-missing", "`linear_stiffness`"),
        (
            "contact: floor, stiffness: 1e5, linear_stiffness: 1e4",
            "effect-missing",
            "one of",
        ),
        (
            "contact: floor, stiffness: 0",
            "effect-value",
            "`stiffness`",
        ),
        ("contact: floor, stiffness: 1e5 N/m", "wrong-unit", "N/m"),
        (
            "contact: floor, contacts: [cube], stiffness: 1e5",
            "effect-contacts",
            "both",
        ),
        (
            "contacts: [floor, floor], stiffness: 1e5",
            "effect-contacts",
            "twice",
        ),
        (
            "contacts: [cube, cube_3], stiffness: 1e5",
            "effect-contacts",
            "cube_3",
        ),
        (
            "contacts: floor, stiffness: 1e5",
            "effect-contacts",
            "neither",
        ),
    ] {
        others.extend(unlike(keys, rule, words));
    }
    for (more, rule, words) in [
        ("damping: -1", "effect-value", "`damping`"),
        ("restitution: 0.5", "effect-damping", "impact_speed"),
        (
            "restitution: 1.5, impact_speed: 1",
            "effect-value",
            "above 1",
        ),
        (
            "restitution: 0, impact_speed: 1",
            "effect-value",
            "`restitution`",
        ),
        (
            "restitution: 0.5, impact_speed: 1, damping: 1",
            "effect-damping",
            "`damping`",
        ),
        ("kinetic: -0.1, width: 0.01", "effect-value", "`kinetic`"),
        ("kinetic: 0.5", "effect-friction", "`bristles`"),
        (
            "kinetic: 0.5, width: 0.01, bristles: 1e3, release: 0.01",
            "effect-friction",
            "not both",
        ),
        ("kinetic: 0.5, bristles: 1e3", "effect-missing", "`release`"),
        (
            "kinetic: 0.5, static: 0.4, stribeck_speed: 0.1, width: 0.01",
            "effect-value",
            "`static`",
        ),
        (
            "kinetic: 0.5, static: 0.6, width: 0.01",
            "effect-missing",
            "`stribeck_speed`",
        ),
        ("width: 0.01", "effect-missing", "`kinetic`"),
        (
            "kinetic: 0.5, width: 0.01, bristle_damping: 2",
            "effect-missing",
            "`bristles`",
        ),
    ] {
        others.extend(unlike(&format!("{sound}, {more}"), rule, words));
    }
    let bristles = "contact: knock, stiffness: 1e5, kinetic: 0.4, bristles: 1e3, release: 1 ms";
    others.extend(unlike(bristles, "effect-friction", "two spheres"));
    assert!(others.is_empty(), "{}", others.join("\n"));
}

/// A second law at one contact, also through the corners of a box.
#[test]
fn a_contact_has_one_law() {
    let law = |name: &str, at: &str| {
        format!("  - {name}: {{ type: compliant_contact, {at}, stiffness: 1e5 }}\n")
    };
    for (first, second) in [
        ("contact: floor", "contacts: all"),
        ("contact: cube_2", "contact: cube"),
    ] {
        let scene = format!(
            "scene: 1\nmechanism: m.yaml\neffects:\n  - inertia\n{}{}",
            law("one", first),
            law("two", second)
        );
        let refusal = try_scene(&scene, BALL).expect_err("two laws");
        let text = told(&refusal, &scene);
        assert!(text.contains("has a law already: `one`"), "{text}");
    }
}

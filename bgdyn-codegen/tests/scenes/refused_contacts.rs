//! Tests what contact laws refuse: the rule, the location, the words.

use bgdyn_codegen::fault::Fault;

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
        (
            "contacts: [], stiffness: 1e5",
            "effect-contacts",
            "names none",
        ),
        ("contact: flor, stiffness: 1e5", "unknown-name", "`floor`"),
        ("stiffness: 1e5", "missing-key", "`contact`"),
        ("contact: floor", "effect-missing", "no stiffness"),
        (
            "contact: floor, stiffness: 1e5, linear_stiffness: 1e4",
            "effect-missing",
            "has both",
        ),
        ("contact: floor, stiffness: 0", "effect-sign", "`stiffness`"),
        ("contact: floor, stiffness: 1e5 N/m", "unit-misfit", "N/m"),
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
        (
            "kinetic: 0, bristles: 1e3, release: 0.01",
            "effect-sign",
            "`kinetic`",
        ),
        ("damping: -1", "effect-sign", "`damping`"),
        ("restitution: 0.5", "effect-damping", "impact_speed"),
        (
            "restitution: 1.5, impact_speed: 1",
            "effect-sign",
            "at most 1",
        ),
        (
            "restitution: 0, impact_speed: 1",
            "effect-sign",
            "`restitution`",
        ),
        (
            "restitution: 0.5, impact_speed: 1, damping: 1",
            "effect-damping",
            "`damping`",
        ),
        ("kinetic: -0.1, width: 0.01", "effect-sign", "`kinetic`"),
        ("kinetic: 0.5", "effect-friction", "`bristles`"),
        (
            "kinetic: 0.5, width: 0.01, bristles: 1e3, release: 0.01",
            "effect-friction",
            "both",
        ),
        ("kinetic: 0.5, bristles: 1e3", "effect-missing", "`release`"),
        (
            "kinetic: 0.5, static: 0.4, stribeck_speed: 0.1, width: 0.01",
            "effect-order",
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

/// Contacts of a mechanism, each with the rule that it breaks.
const CONTACTS: [(&str, &str, &str); 16] = [
    (
        "itself",
        "{ link: hand, radius: 10 mm, with: arm, with_radius: 10 mm }",
        "contact-moves-nothing",
    ),
    (
        "carrier",
        "{ link: hand, radius: 10 mm, on: palm }",
        "contact-moves-nothing",
    ),
    (
        "height",
        "{ link: hand, radius: 10 mm }",
        "contact-moves-nothing",
    ),
    (
        "hole",
        "{ link: hand, radius: -10 mm, on: wall }",
        "radius-not-positive",
    ),
    (
        "other_hole",
        "{ link: hand, radius: 1 cm, with: hub, with_radius: -1 cm }",
        "radius-not-positive",
    ),
    ("points", "{ link: hand, with: hub }", "contact-of-points"),
    (
        "both",
        "{ link: hand, on: wall, with: hub, with_radius: 1 cm }",
        "unused-key",
    ),
    (
        "alone",
        "{ link: hand, on: wall, with_radius: 1 cm }",
        "unused-key",
    ),
    (
        "mixed",
        "{ link: hand, size: [0.1, 0.1, 0.1], to: [0.1, 0, 0], on: wall }",
        "unused-key",
    ),
    (
        "flat",
        "{ link: hand, size: [0.1, 0, 0.1], on: wall }",
        "value-not-positive",
    ),
    (
        "short",
        "{ link: hand, at: [0.1, 0, 0], to: [0.1, 0, 0], on: wall }",
        "value-not-positive",
    ),
    (
        "varying",
        "{ link: hand, radius: { parameter: ball, value: 10 mm }, on: wall }",
        "parameter-not-possible",
    ),
    ("stranger", "{ link: hant, on: wall }", "unknown-place"),
    ("nowhere", "{ link: hand, on: walt }", "unknown-plane"),
    ("nothing", "{ radius: 1 cm, on: wall }", "missing-key"),
    (
        "heavy",
        "{ link: hand, radius: 1 kg, on: wall }",
        "unit-misfit",
    ),
];

/// Returns the faults of a mechanism with a contact.
fn faults(name: &str, contact: &str) -> Vec<Fault> {
    let text = format!(
        "
format: 1
links:
  - {{ name: arm, mass: 1, com: [0.2, 0, 0], joint: {{ name: turn, type: revolute, axis: z }} }}
  - {{ name: hand, parent: arm, joint: {{ name: wrist, type: fixed, origin: {{ xyz: [0.4, 0, 0] }} }} }}
frames:
  - {{ name: hub, link: world, origin: {{ xyz: [1, 0, 0] }} }}
planes:
  wall: {{ normal: x, offset: -1 m }}
  palm: {{ link: arm, normal: x }}
contacts:
  {name}: {contact}
"
    );
    bgdyn_codegen::read(&text, Some("m")).1.0
}

#[test]
fn what_contacts_of_mechanisms_refuse() {
    for (name, contact, rule) in CONTACTS {
        let found = faults(name, contact);
        let rules: Vec<&str> = found.iter().map(|fault| fault.rule).collect();
        assert_eq!(rules, [rule], "{name}: {found:?}");
        assert!(found[0].path.contains(name), "{found:?}");
    }
    assert!(faults("sound", "{ link: hand, on: wall }").is_empty());
}

/// The ends of a capsule have the name of its entry and a number.
#[test]
fn two_contacts_of_one_name_are_refused() {
    let both = "{ link: hand, to: [0.1, 0, 0], on: wall }\n  rod_2: { link: hand, on: wall }";
    let found = faults("rod", both);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].rule, "repeated-name");
}

/// With loops, locking closes them anew; a contact that then cannot move stays without effect, as in a tree.
#[test]
fn locked_joints_may_leave_a_contact_without_motion() {
    let four_bar = "
format: 1
links:
  - { name: crank, mass: 1, com: [0.05, 0, 0], joint: { name: crank, type: revolute, axis: z } }
  - { name: coupler, parent: crank, mass: 1, com: [0.2, 0, 0], joint: { name: knee, type: revolute, axis: z, origin: { xyz: [0.1, 0, 0] } } }
  - { name: rocker, mass: 1, com: [0.15, 0, 0], joint: { name: rocker, type: revolute, axis: z, origin: { xyz: [0.4, 0, 0] } } }
  - { name: hand, parent: rocker, mass: 1, com: [0.1, 0, 0.1], joint: { name: wrist, type: revolute, axis: z, origin: { xyz: [0.3, 0, 0] } } }
loops:
  - { name: pin, type: hinge, a: { link: coupler, origin: { xyz: [0.4, 0, 0] } }, b: { link: rocker, origin: { xyz: [0.3, 0, 0] } }, branch: left }
planes:
  wall: { normal: x, offset: -1 m }
contacts:
  knuckle: { link: crank, at: [0.1, 0, 0], on: wall }
  nail: { link: hand, at: [0.2, 0, 0], on: wall }
";
    let scene = "scene: 1\nmechanism: m.yaml\neffects:\n  - inertia\n  - touch: { type: compliant_contact, contact: nail, stiffness: 1e5 }\nlock: { crank: 1 rad }\n";
    let (system, _) = try_scene(scene, four_bar).unwrap_or_else(|refusal| {
        panic!("{}", told(&refusal, scene));
    });
    assert_eq!(system.scene.layout.nv(), 1, "the wrist moves");
    assert!(system.idle().is_empty());
}

/// Returns the message about a scene with a rigid contact, with these keys and these other lines.
fn rigid(keys: &str, more: &str) -> String {
    let scene = format!(
        "scene: 1\nmechanism: m.yaml\neffects:\n  - inertia\n  - touch: {{ type: rigid_contact, {keys} }}\n{more}"
    );
    match try_scene(&scene, BALL) {
        Ok(_) => "sound".into(),
        Err(refusal) => told(&refusal, &scene),
    }
}

#[test]
fn what_rigid_contacts_refuse() {
    let floor = "contact: floor";
    for more in [
        "",
        "integration: { method: rk4 }\n",
        "integration: { method: dopri5 }\n",
        "integration: { method: dop853, impacts: poisson }\n",
        "integration: { impacts: newton }\n",
    ] {
        let more = format!("initial: {{ fall: 10 mm }}\n{more}");
        assert_eq!(rigid(floor, &more), "sound", "{more}");
    }
    for (keys, more, rule, words) in [
        (
            "contact: floor",
            "initial: { fall: 10 mm }\nintegration: { method: canonical_midpoint }\n",
            "integration",
            "`canonical_midpoint` integrates momenta",
        ),
        (
            "contact: floor",
            "initial: { fall: 10 mm }\nintegration: { impacts: poisson }\n",
            "integration",
            "`moreau` has Newton's law",
        ),
        (
            "contact: floor",
            "initial: { fall: 10 mm }\nintegration: { method: rk4, impacts: poison }\n",
            "unknown-name",
            "`poisson`",
        ),
        (
            "contact: floor",
            "initial: { fall: 9 mm }\n",
            "start-overlaps",
            "`floor` overlap by 0.001 m",
        ),
        (
            "contact: floor",
            "  - rub: { type: coulomb, joint: slide, kinetic: 1 N }\ninitial: { fall: 1 m }\n",
            "effect-contacts",
            "`rub`",
        ),
        (
            "contact: floor, friction: -0.1",
            "",
            "effect-sign",
            "`friction`",
        ),
        (
            "contact: floor, restitution: -0.1",
            "",
            "effect-sign",
            "`restitution`",
        ),
        (
            "contact: floor, restitution: 1.1",
            "",
            "effect-sign",
            "`restitution`",
        ),
        (
            "contact: floor, stiffness: 1e5",
            "",
            "unknown-key",
            "`stiffness`",
        ),
        ("contact: flor", "", "unknown-name", "`floor`"),
    ] {
        let text = rigid(keys, more);
        assert!(
            text.contains(&format!("[{rule}]")) && text.contains(words),
            "{keys} {more}: {text}"
        );
    }
}

#[test]
fn a_law_of_impacts_without_contacts_is_refused() {
    let text =
        "scene: 1\nmechanism: m.yaml\neffects: [inertia]\nintegration: { impacts: newton }\n";
    let refusal = try_scene(text, BALL).expect_err("no rigid contact");
    let text = told(&refusal, text);
    assert!(
        text.contains("[integration]") && text.contains("the scene has none"),
        "{text}"
    );
}

/// Returns the message about a scene with rigid contacts at these cubes, of eight corners each, with these other contacts
/// and these lines.
fn cubes(number: usize, others: &str, more: &str) -> String {
    let all = || (0..number).map(|k| format!("cube{k}"));
    let declared: String = all()
        .map(|cube| format!("  {cube}: {{ link: ball, size: [0.1, 0.1, 0.1] }}\n"))
        .collect();
    let mechanism = BALL.replace("contacts:\n", &format!("contacts:\n{declared}"));
    let names: Vec<String> = all().collect();
    let names = names.join(", ");
    let scene = format!(
        "scene: 1\nmechanism: m.yaml\neffects:\n  - inertia\n  - touch: {{ type: rigid_contact, contacts: [{names}{others}] }}\ninitial: {{ fall: 1 m }}\n{more}"
    );
    match try_scene(&scene, &mechanism) {
        Ok(_) => "sound".into(),
        Err(refusal) => told(&refusal, &scene),
    }
}

#[test]
fn a_scene_has_at_most_32_rigid_contacts() {
    assert_eq!(cubes(4, "", ""), "sound");
    for method in ["moreau", "rk4"] {
        let text = cubes(5, "", &format!("integration: {{ method: {method} }}\n"));
        let words = "40 rigid contacts; the solver takes 32";
        assert!(
            text.contains(words) && !text.contains("[integration]"),
            "{text}"
        );
    }
}

#[test]
fn integrators_of_the_rates_take_at_most_8_rigid_contacts() {
    for method in ["rk4", "dopri5", "rodas4", "gauss2"] {
        let more = format!("integration: {{ method: {method} }}\n");
        assert_eq!(cubes(1, "", &more), "sound");
        let text = cubes(1, ", floor", &more);
        let words = format!(
            "9 rigid contacts, and `{method}` goes from event to event with at most 8; `moreau` takes 32"
        );
        assert!(
            text.contains("[integration]") && text.contains(&words),
            "{text}"
        );
    }
    assert_eq!(cubes(1, ", floor", ""), "sound");
}

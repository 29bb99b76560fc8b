//! Tests the refusals of hydraulics, wrenches, drag and payloads: the rule, the location, the words.

use super::common::{told, try_scene};

const ARM: &str = "
format: 1
links:
  - { name: block, mass: 2 kg, joint: { name: slide, type: prismatic, axis: x, limits: { lower: -0.2, upper: 0.2 } } }
  - { name: arm, parent: block, mass: 1 kg, com: [0.1, 0, 0], joint: { name: swing, type: revolute, axis: y, limits: { lower: -90 deg, upper: 90 deg } } }
frames:
  - { name: anchor, link: world, origin: { xyz: [0, 0, -0.3] } }
  - { name: lug, link: arm, origin: { xyz: [0.1, 0, 0] } }
  - { name: jack_b, link: arm }
";

/// A supply and a line of oil, with additions by a test.
const OIL: &str = "
oil: { type: fluid, bulk_modulus: 1 GPa }
pump: { type: supply, pressure: 10 MPa }
hose: { type: line, volume: 2 cm^3 }";

pub(super) struct Case {
    effects: String,
    rest: &'static str,
}

pub(super) fn plain(effects: &str) -> Case {
    Case {
        effects: effects.into(),
        rest: "",
    }
}

pub(super) fn oil(effects: &str) -> Case {
    plain(&format!("{OIL}\n{effects}"))
}

impl Case {
    /// Every node except the tested one names its fluid.
    pub(super) fn named(mut self) -> Self {
        self.effects = self
            .effects
            .replace("pressure: 10 MPa", "pressure: 10 MPa, fluid: oil")
            .replace("volume: 2 cm^3", "volume: 2 cm^3, fluid: oil");
        self
    }
}

/// Checks that the scene has only this fault, on the line that contains `line_has`.
pub(super) fn refused(case: &Case, rule: &str, line_has: &str, words: &[&str]) {
    let lines = case
        .effects
        .lines()
        .map(str::trim)
        .filter(|l| !l.is_empty());
    let effects: Vec<String> = lines.map(|l| format!("  - {l}\n")).collect();
    let text = format!(
        "scene: 1\nmechanism: arm.yaml\neffects:\n{}{}",
        effects.concat(),
        case.rest
    );
    let Err(refusal) = try_scene(&text, ARM) else {
        panic!("accepted:\n{text}");
    };
    let told = told(&refusal, &text);
    let found: Vec<&str> = told
        .lines()
        .filter(|l| l.starts_with("scene.yaml:"))
        .collect();
    assert_eq!(found.len(), 1, "{told}");
    assert!(found[0].ends_with(&format!("[{rule}]")), "{told}");
    let line = found[0]
        .split(':')
        .nth(1)
        .and_then(|n| n.parse::<usize>().ok());
    let source = text
        .lines()
        .nth(line.expect("a line") - 1)
        .expect("the line");
    assert!(source.contains(line_has), "at `{source}`:\n{told}");
    for word in words {
        assert!(told.contains(word), "no `{word}` in:\n{told}");
    }
}

#[test]
fn numbers_out_of_their_range() {
    let cases: [(Case, &str, &str, &[&str]); 19] = [
        (
            plain("oil: { type: fluid, bulk_modulus: 0 }"),
            "effect-sign",
            "bulk_modulus",
            &["greater than 0"],
        ),
        (
            plain("oil: { type: fluid, bulk_modulus: -1 GPa }"),
            "effect-sign",
            "bulk_modulus",
            &["-1 GPa"],
        ),
        (
            oil("pipe: { type: line, volume: -1 cm^3 }"),
            "effect-sign",
            "pipe",
            &["-1 cm^3", "junction"],
        ),
        (
            oil("pipe: { type: line, volume: 0 }"),
            "effect-sign",
            "pipe",
            &["junction"],
        ),
        (
            oil("well: { type: supply, pressure: -2 bar }"),
            "effect-pressure",
            "well",
            &["-2 bar", "vacuum"],
        ),
        (
            oil("sump: { type: tank, pressure: -2 bar }"),
            "effect-pressure",
            "sump",
            &["vacuum"],
        ),
        (
            oil("cut: { type: orifice, from: pump, to: hose, flow: 0 }"),
            "effect-sign",
            "cut",
            &["`flow`"],
        ),
        (
            oil("cut: { type: orifice, from: pump, to: hose, flow: 1e-7, resistance: -1 }"),
            "effect-sign",
            "cut",
            &["`resistance`"],
        ),
        (
            oil("gap: { type: leakage, from: pump, to: hose, conductance: 0 }"),
            "effect-sign",
            "gap",
            &["`conductance`"],
        ),
        (
            oil("ram: { type: cylinder, joint: slide, area_a: 0, dead_a: 1e-3 }"),
            "effect-sign",
            "ram",
            &["`area_a`"],
        ),
        (
            oil("ram: { type: cylinder, joint: slide, area_a: 1 cm^2, dead_a: -1 cm^3 }"),
            "effect-sign",
            "ram",
            &["`dead_a`"],
        ),
        (
            oil(
                "ram: { type: cylinder, joint: slide, area_a: 1 cm^2, area_b: 1 cm^2, stroke: -1 m, dead_a: 1e-3 }",
            ),
            "effect-sign",
            "ram",
            &["`stroke`"],
        ),
        (
            oil(
                "ram: { type: cylinder, joint: slide, area_a: 1 cm^2, dead_a: 1e-3, dead_b: 1e-3 }",
            ),
            "effect-missing",
            "ram",
            &["`dead_b`", "area_b"],
        ),
        (
            plain("water: { type: drag, at: arm, linear: -1 }"),
            "effect-sign",
            "water",
            &["would drive"],
        ),
        (
            plain("water: { type: drag, at: arm }"),
            "effect-missing",
            "water",
            &["`angular`"],
        ),
        (
            plain("part: { type: payload, at: lug, mass: -1 kg }"),
            "effect-sign",
            "part",
            &["-1 kg"],
        ),
        (
            plain("part: { type: payload, at: lug, mass: 1 kg, inertia: { xx: -1 } }"),
            "not-semidefinite",
            "part",
            &[],
        ),
        (
            plain(
                "part: { type: payload, at: lug, mass: 1 kg, inertia: { xx: 1, yy: 0.1, zz: 0.1 } }",
            ),
            "triangle-inequality",
            "part",
            &[],
        ),
        (
            Case {
                effects: OIL.into(),
                rest: "initial: { hose: -1.2 bar }",
            },
            "initial",
            "initial",
            &["-1.2 bar", "vacuum"],
        ),
    ];
    for (case, rule, place, words) in &cases {
        refused(case, rule, place, words);
    }
}

#[test]
fn dimensions_that_do_not_fit() {
    let cases = [
        (
            oil("ram: { type: cylinder, joint: slide, area_a: 3 cm^3, dead_a: 1 l }"),
            "ram",
        ),
        (
            oil("ram: { type: cylinder, joint: swing, area_a: 3 cm^2, dead_a: 1 l }"),
            "ram",
        ),
        (
            oil("gap: { type: leakage, from: pump, to: hose, conductance: 3 Pa }"),
            "gap",
        ),
        (
            plain("water: { type: drag, at: arm, quadratic: 3 N*s/m }"),
            "water",
        ),
        (
            plain("part: { type: payload, at: lug, mass: 1 kg, com: [1 kg, 0, 0] }"),
            "part",
        ),
        (
            Case {
                effects: OIL.into(),
                rest: "initial: { hose: 2 cm^3 }",
            },
            "initial",
        ),
    ];
    for (case, place) in &cases {
        refused(case, "unit-misfit", place, &[]);
    }
}

/// The parts of a family are located at the scene's entry, not in the mechanism's file.
#[test]
fn faults_of_a_family_stand_in_the_scene() {
    let mechanism = format!("{ARM}effects:\n  hose: {{ type: line, volume: 1 cm^3 }}\n");
    let text = "scene: 1\nmechanism: arm.yaml\neffects:\n  - gravity\n  - hydraulics\n";
    let Err(refusal) = try_scene(text, &mechanism) else {
        panic!("accepted");
    };
    let told = told(&refusal, text);
    assert!(told.starts_with("scene.yaml:5:5: "), "{told}");
    assert!(told.contains("[no-fluid]"), "{told}");
}

/// An effect at a site that no joint moves in its directions has no influence: a warning names it.
#[test]
fn what_no_joint_moves_is_warned_of() {
    let mechanism = ARM.replace(
        "frames:",
        "  - { name: wall, joint: { type: fixed } }\nframes:",
    );
    let text = "\
scene: 1
mechanism: arm.yaml
effects:
  - inertia
  - push: { type: wrench, at: wall }
  - aside: { type: wrench, at: block, components: [fy, mx] }
  - along: { type: wrench, at: block, components: [fx, fy] }
  - swirl: { type: drag, at: block, angular: 0.1 N*m*s/rad }
  - still: { type: drag, at: block, linear: 0 N*s/m }
  - water: { type: drag, at: block, linear: 1 N*s/m }
";
    let (_, findings) = try_scene(text, &mechanism).expect("a sound scene");
    let found: Vec<String> = findings
        .0
        .iter()
        .map(|f| format!("{}: {}", f.rule, f.message))
        .collect();
    let nothing = |effect: &str, at: &str| {
        format!(
            "no-motion: `{effect}` does nothing: no joint moves `{at}` in a direction in which it acts"
        )
    };
    let expected = [("push", "wall"), ("aside", "block"), ("swirl", "block")];
    assert_eq!(found, expected.map(|(effect, at)| nothing(effect, at)));
}

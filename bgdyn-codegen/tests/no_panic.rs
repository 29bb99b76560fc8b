//! The reader and the check never panic, whatever the text.

use bgdyn_codegen::read;
use proptest::prelude::*;

const SPEC: &str = "\
format: 1
name: arm
description: >
  Two links
gravity: [0, 0, -9.81 m/s^2]
snap: 1e-4
links:
  - &upper
    name: upper_arm
    joint: { name: shoulder, type: revolute, axis: [0, 1, 1e-5] }
    mass: 2.4
    com: [0.15, 0, 0]
    inertia: { xx: 0.002, yy: 0.018, zz: 0.018, xy: 1 kg*mm^2, rpy: [0, 90 deg, 1.5708] }
  - name: \"forearm\"
    parent: upper_arm
    joint:
      name: elbow
      type: prismatic
      axis: -y
      origin: { xyz: [300 mm, 0, 0], rpy: [0, 90 deg, 0] }
      limits: { lower: -15 cm, upper: 150 mm, velocity: 3, effort: 40 }
    nonphysical: allow
frames:
  - { name: tool, link: forearm, origin: { xyz: [0.25, 0, 0] } }
";

/// Runs everything on `text`: a mechanism exactly where no fault is, and renderings of all faults.
fn run(text: &str) {
    let (mechanism, faults) = read(text, Some("arm"));
    assert_eq!(mechanism.is_none(), faults.any_fault(), "{text}");
    for fault in &faults.0 {
        assert!(
            !fault.headline("arm.yaml").contains(['\n', '\r']),
            "{fault:?}"
        );
    }
    let _ = faults.render("arm.yaml", text);
}

#[test]
fn the_unchanged_spec_is_sound() {
    assert!(
        read(SPEC, Some("arm")).0.is_some(),
        "{:?}",
        read(SPEC, Some("arm")).1
    );
}

/// A piece of YAML that may do harm.
fn piece() -> impl Strategy<Value = String> {
    let pieces = [
        "&a",
        "*a",
        "<<: ",
        "!!str ",
        "!x ",
        "---\n",
        "...\n",
        "? ",
        ": ",
        "- ",
        "[",
        "]",
        "{",
        "}",
        "\"",
        "'",
        "|",
        ">",
        "#",
        "%YAML 1.2\n",
        "\t",
        "\r",
        "\u{feff}",
        "\0",
        "~",
        ".nan",
        "-.inf",
        "1e999",
        "0x1F",
        "90 deg",
        "é",
        "\u{85}",
        "\u{2028}",
        ",",
        "\n",
        "  ",
        "- - - ",
        "world",
        "name: a",
        "parent: a",
        "inertia: { xx: -1 }",
        "type: fixed",
        "mass: &m [*m]",
    ];
    prop_oneof![
        prop::sample::select(pieces.to_vec()).prop_map(str::to_owned),
        "[ -~\n]{0,6}",
        ".{0,3}"
    ]
}

/// The spec with some pieces cut out and others put in.
fn mutated() -> impl Strategy<Value = String> {
    let change = (any::<prop::sample::Index>(), 0..12usize, piece());
    prop::collection::vec(change, 1..6).prop_map(|changes| {
        let mut text: Vec<char> = SPEC.chars().collect();
        for (place, cut, put) in changes {
            let start = place.index(text.len() + 1);
            let end = (start + cut).min(text.len());
            text.splice(start..end, put.chars());
        }
        text.into_iter().collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn arbitrary_text(text in any::<String>()) {
        run(&text);
    }

    #[test]
    fn pieces_of_yaml(pieces in prop::collection::vec(piece(), 0..30)) {
        run(&pieces.concat());
    }

    #[test]
    fn mutated_specs(text in mutated()) {
        run(&text);
    }
}

//! Checks that `bgdyn schema` has the same rules as the parser.

use std::collections::BTreeSet;
use std::fs;

use jsonschema::Validator;
use serde_json::Value;

use crate::{bgdyn, root};

fn schema() -> Value {
    let printed = bgdyn(&["schema"]).good();
    serde_json::from_str(&printed).expect("JSON")
}

fn validator() -> Validator {
    jsonschema::validator_for(&schema()).expect("a schema")
}

fn yaml(text: &str) -> Value {
    serde_yaml::from_str(text).expect("YAML")
}

/// Mechanisms in a folder.
fn files(folder: &str) -> Vec<(String, String)> {
    let entries = fs::read_dir(root().join(folder)).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let specs = paths.filter(|path| {
        let name = path.to_string_lossy();
        name.ends_with(".yaml") && !name.ends_with(".scene.yaml")
    });
    let read = |path: std::path::PathBuf| {
        let text = fs::read_to_string(&path).expect("a text");
        (path.display().to_string(), text)
    };
    let mut files: Vec<_> = specs.map(read).collect();
    files.sort();
    files
}

#[test]
fn every_spec_fits() {
    let validator = validator();
    let all = [
        "specs",
        "specs/constraints",
        "specs/contact",
        "specs/loops",
        "tests/golden/specs",
        "bgdyn-codegen/tests/outside",
    ]
    .map(files)
    .concat();
    assert!(all.len() > 30);
    for (name, text) in all {
        let instance = yaml(&text);
        let faults: Vec<String> = validator
            .iter_errors(&instance)
            .map(|e| format!("{}: {e}", e.instance_path()))
            .collect();
        assert!(faults.is_empty(), "{name}: {faults:#?}");
    }
}

/// The rules about keys, words, types and units that one value alone can violate.
const RULES_OF_VALUES: [&str; 10] = [
    "unknown-key",
    "missing-key",
    "unknown-joint-type",
    "unknown-axis",
    "unknown-unit",
    "unit-misfit",
    "nonphysical-word",
    "unknown-solid",
    "about-word",
    "misplaced-parameter",
];

#[test]
fn what_is_no_spec_does_not_fit() {
    let validator = validator();
    let mut seen = BTreeSet::new();
    for (name, text) in files("specs/invalid") {
        let stem = name
            .rsplit('/')
            .next()
            .and_then(|n| n.strip_suffix(".yaml"));
        let faults = bgdyn_codegen::read(&text, stem).1;
        let Some(rule) = RULES_OF_VALUES
            .iter()
            .find(|rule| faults.0.iter().any(|f| f.rule == **rule))
        else {
            continue;
        };
        let Ok(instance) = serde_yaml::from_str::<Value>(&text) else {
            continue;
        };
        // The keys of a fixed joint and the units of its joint are checked later.
        if stem == Some("unit_misfit_limit") || stem == Some("missing_key_joint_name") {
            continue;
        }
        assert!(!validator.is_valid(&instance), "{name} breaks `{rule}`");
        seen.insert(*rule);
    }
    assert_eq!(seen, BTreeSet::from(RULES_OF_VALUES));
}

/// A spec with an unknown key in each mapping of the format; the parser lists the known keys.
const EVERY_MAPPING: &str = "\
format: 1
zzzzzzzzzz: 1
links:
  - name: a
    zzzzzzzzzz: 1
    joint:
      name: j
      type: revolute
      zzzzzzzzzz: 1
      origin: { zzzzzzzzzz: 1 }
      limits: { zzzzzzzzzz: 1, turn: { zzzzzzzzzz: 1 } }
      mimic: { joint: k, zzzzzzzzzz: 1 }
    inertia: { zzzzzzzzzz: 1, products: { zzzzzzzzzz: 1 } }
frames:
  - { name: f, link: a, zzzzzzzzzz: 1 }
";

/// Returns the keys in the schema for the mapping at a path.
fn keys(schema: &Value, path: &str) -> BTreeSet<String> {
    let pointer = match path {
        "" => "/properties",
        "links[0]" => "/$defs/link/properties",
        "links[0].joint" => "/$defs/joint/properties",
        "links[0].joint.origin" => "/$defs/origin/properties",
        "links[0].joint.limits" => "/$defs/limits/properties",
        "links[0].joint.limits.turn" => "/$defs/part_limits/properties",
        "links[0].joint.mimic" => "/$defs/mimic/properties",
        "links[0].inertia" => "/$defs/inertia/properties",
        "links[0].inertia.products" => "/$defs/inertia/properties/products/properties",
        "frames[0]" => "/$defs/frame/properties",
        other => panic!("no such mapping: {other}"),
    };
    let properties = schema
        .pointer(pointer)
        .and_then(Value::as_object)
        .expect("properties");
    properties.keys().cloned().collect()
}

#[test]
fn keys_are_those_of_the_reader_and_of_the_page() {
    let schema = schema();
    let page = fs::read_to_string(root().join("docs/spec.md")).expect("docs/spec.md");
    let faults = bgdyn_codegen::read(EVERY_MAPPING, Some("a")).1;
    let mut mappings = 0;
    for fault in faults.0.iter().filter(|f| f.rule == "unknown-key") {
        let help = fault.help.as_deref().expect("the keys that it knows");
        let known: BTreeSet<String> = help
            .split('`')
            .skip(1)
            .step_by(2)
            .map(String::from)
            .collect();
        assert_eq!(keys(&schema, &fault.path), known, "{}", fault.path);
        for key in known {
            assert!(page.contains(&key), "docs/spec.md does not know `{key}`");
        }
        mappings += 1;
    }
    assert_eq!(mappings, 10);
}

/// Texts with units, as the parser accepts them.
#[test]
fn quantities_are_those_of_the_reader() {
    let validator = validator();
    let texts = [
        "3",
        "3 kg",
        "3kg",
        "250 g",
        "2.5e-3 kg",
        "-1 g",
        ".5 kg",
        "5. kg",
        "3 m",
        "3 kgs",
        "kg",
        "1e kg",
        "+2 kg",
        "\"3\"",
    ];
    for text in texts {
        let spec = format!("format: 1\nlinks: [{{ name: a, mass: {text} }}]\n");
        let faults = bgdyn_codegen::read(&spec, Some("a")).1;
        let of_values = ["negative-mass", "no-coordinates"];
        let mut rules = faults.0.iter().map(|fault| fault.rule);
        let read = rules.all(|rule| of_values.contains(&rule));
        assert_eq!(
            validator.is_valid(&yaml(&spec)),
            read,
            "{text}: {:?}",
            faults.0
        );
    }
    for (text, fits) in [
        ("90 deg", true),
        ("90 °", true),
        ("1 m", true),
        ("1 m/s", false),
        ("1 kg", false),
    ] {
        let spec = format!(
            "format: 1\nlinks: [{{ name: a, joint: {{ name: j, type: revolute, limits: {{ upper: {text} }} }} }}]\n"
        );
        assert_eq!(validator.is_valid(&yaml(&spec)), fits, "{text}");
    }
}

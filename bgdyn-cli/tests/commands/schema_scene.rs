//! Checks that `bgdyn schema --scene` has the same rules as the parser of scenes.

use std::collections::BTreeSet;
use std::fs;

use bgdyn_codegen::fault::Faults;
use bgdyn_codegen::read_scene;
use bgdyn_codegen::refusal::Refusal;
use jsonschema::Validator;
use serde_json::Value;

use crate::{bgdyn, root};

fn schema() -> Value {
    let printed = bgdyn(&["schema", "--scene"]).good();
    serde_json::from_str(&printed).expect("JSON")
}

fn validator() -> Validator {
    jsonschema::validator_for(&schema()).expect("a schema")
}

const MECHANISM: &str = "\
format: 1
links:
  - { name: arm, joint: { name: shoulder, type: revolute, axis: y }, mass: 1, com: [1, 0, 0] }
  - { name: hand, parent: arm, joint: { name: wrist, type: revolute, axis: y }, mass: 1, com: [1, 0, 0] }
  - { name: body, joint: { name: free, type: floating }, mass: 1, inertia: { xx: 1, yy: 1, zz: 1 } }
effects:
  grease: { type: viscous, joint: shoulder, damping: 0.1 }
";

/// Returns the faults of a scene with the mechanism above.
fn faults(scene: &str) -> Faults {
    let text = format!("scene: 1\nmechanism: arm.yaml\n{scene}");
    match read_scene(&text, "run", |_| Ok(MECHANISM.to_owned())) {
        Ok((_, faults)) => faults,
        Err(Refusal::Spec(faults)) => faults,
        Err(other) => panic!("{text}: {other:?}"),
    }
}

fn fits(validator: &Validator, scene: &str) -> bool {
    let text = format!("scene: 1\nmechanism: arm.yaml\n{scene}");
    validator.is_valid(&serde_yaml::from_str(&text).expect("YAML"))
}

#[test]
fn every_scene_fits() {
    let validator = validator();
    let mut seen = 0;
    let folders = ["specs/scenes", "specs/contact", "tests/hard_cases/scenes"]
        .map(|folder| root().join(folder));
    let entries = folders
        .iter()
        .flat_map(|folder| fs::read_dir(folder).expect("a folder"));
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let is_scene = |path: &std::path::PathBuf| path.to_string_lossy().ends_with(".scene.yaml");
    for path in paths.filter(is_scene) {
        let text = fs::read_to_string(&path).expect("a text");
        let instance: Value = serde_yaml::from_str(&text).expect("YAML");
        let faults: Vec<String> = validator
            .iter_errors(&instance)
            .map(|e| format!("{}: {e}", e.instance_path()))
            .collect();
        assert!(faults.is_empty(), "{}: {faults:#?}", path.display());
        seen += 1;
    }
    assert!(seen > 25);
}

#[test]
fn both_take_the_same() {
    let validator = validator();
    for scene in [
        "effects: [gravity, grease]",
        "effects: [friction]",
        "effects: [viscous]",
        "effects: [gravity: [0, 0, -1.62], inertia: lumped]",
        "effects: [inertia: { stage: lumped }]",
        "effects: [grease: { damping: 2 }]",
        "effects: [lock_wire: { type: spring, joint: wrist, stiffness: 40 }]",
        "lock: { wrist: 30 deg }",
        "inputs: { shoulder: 2 N*m, wrist: given }",
        "inputs: { shoulder: { ramp: { from: 0, rate: 1 } } }",
        "inputs: { shoulder: { harmonic: { amplitude: 1, frequency: 2 Hz, phase: 90 deg, offset: 1 } } }",
        "inputs: { shoulder: { table: [[0 s, 0], [1 s, 2 N*m]] } }",
        "inputs: { shoulder: { step: { before: 0, after: 2 N*m, time: 0.5 s } } }",
        "inputs: { shoulder: { quintic: { from: 0, to: 2 N*m, start: 0.5 s, duration: 2 s } } }",
        "inputs: { shoulder: { pd: { target: { trapezoidal: { to: 45 deg, velocity: 1 rad/s, acceleration: 4 } } } } }",
        "inputs: { shoulder: { pid: { target: 45 deg, stiffness: 8, integral: 1, anti_windup: 200 ms }, limit: [-2, 4 N*m] } }",
        "inputs: { shoulder: { limit: 5 N*m } }",
        "effort_limits: false",
        "inputs: { shoulder: { pd: { target: 1 } } }\ncontrol: { period: 1 ms, delay: 0.5 ms, hold: zero_order, quantisation: { position: { shoulder: 0.1 deg } }, noise: { velocity: { shoulder: 0.01 } }, seed: 3 }",
        "inputs: { shoulder: { pd: { target: 45 deg, stiffness: 8, damping: 1 } } }",
        "inputs: { shoulder: { computed_torque: { target: { constant: 1 }, stiffness: 8 } } }",
        "inputs: { free: { hold: { attitude: { target: { rpy: [0, 0, 90 deg] }, stiffness: 8 } } } }",
        "inputs: { free: { hold: { attitude: { target: { quaternion: [0, 0, 0.6, 0.8] }, stiffness: [8, 8, 4], damping: 1 N*m*s/rad } } } }",
        "inputs: { free: { hold: { position: { target: [0, 1, { ramp: { rate: 1 } }], stiffness: 8 N/m } } } }",
        "inputs: { shoulder: { computed_torque: { target: 1 } } }\ncontroller_model: { effects: [gravity, inertia] }",
        "inputs: { shoulder: { computed_torque: { target: 1 } } }\ncontroller_model: { mechanism: nominal.yaml }",
        "initial: { shoulder: 10 deg, wrist_rate: 1 }",
        "outputs: [shoulder, hand]",
        "integration: { method: dopri5, tolerance: 1e-9, end: 500 ms }",
    ] {
        let found = faults(scene);
        assert!(!found.any_fault(), "{scene}: {:?}", found.0);
        assert!(fits(&validator, scene), "{scene}");
    }
}

#[test]
fn both_refuse_the_same() {
    let validator = validator();
    for scene in [
        "effect: [gravity]",
        "effects: gravity",
        "effects: [inertia: heavy]",
        "effects: [gravity: [0, 0]]",
        "effects: [grease: { dampin: 2 }]",
        "effects: [wire: { type: sprung, joint: wrist }]",
        "effects: [wire: { type: spring, joint: wrist, stiffness: 40 m }]",
        "effects: [wire: { type: spring, joint: wrist }]",
        "inputs: { shoulder: { ramps: 1 } }",
        "inputs: { shoulder: { ramp: { to: 0 } } }",
        "inputs: { shoulder: { constant: 1, ramp: { from: 0 } } }",
        "inputs: { shoulder: { harmonic: { amplitude: 1, frequency: 2 m } } }",
        "inputs: { shoulder: { step: { at: 1 s } } }",
        "inputs: { shoulder: { pid: { target: 1, stiffness: 8 } } }",
        "inputs: { shoulder: { constant: 1, limit: [1, 2, 3] } }",
        "effort_limits: 3",
        "inputs: { shoulder: { computed_torque: { target: 1 } } }\ncontroller_model: nominal.yaml",
        "inputs: { shoulder: { computed_torque: { target: 1 } } }\ncontroller_model: { effects: gravity }",
        "inputs: { shoulder: { computed_torque: { target: 1 } } }\ncontroller_model: { file: nominal.yaml }",
        "inputs: { shoulder: { computed_torque: { target: 1 } } }\ncontroller_model: { parameters: [load] }",
        "inputs: { shoulder: { pd: { target: 1 } } }\ncontrol: { delay: 1 ms }",
        "inputs: { shoulder: { pd: { target: 1 } } }\ncontrol: { period: 1 ms, hold: linear }",
        "inputs: { shoulder: { pd: { target: 1 } } }\ncontrol: { period: 1 ms, noise: { effort: 1 } }",
        "inputs: { shoulder: { quintic: { to: 1, duration: 2 m } } }",
        "inputs: { shoulder: { pd: { stiffness: 8 } } }",
        "inputs: { shoulder: { pd: { target: 1, stiff: 8 } } }",
        "inputs: { free: { hold: {} } }",
        "inputs: { free: { hold: { attitude: { stiffness: 8 } } } }",
        "inputs: { free: { hold: { attitude: { target: { rpy: [0, 0] }, stiffness: 8 } } } }",
        "inputs: { free: { hold: { attitude: { target: { rpy: [0, 0, 0] }, stiffness: 8 m } } } }",
        "inputs: { free: { hold: { place: { target: [0, 0, 0], stiffness: 8 } } } }",
        "integration: { method: euler }",
        "integration: { step: 1 m }",
        "integration: { steps: 1 }",
    ] {
        assert!(faults(scene).any_fault(), "{scene}");
        assert!(!fits(&validator, scene), "{scene}");
    }
}

#[test]
fn keys_are_those_of_the_reader_and_of_the_page() {
    let schema = schema();
    let page = fs::read_to_string(root().join("docs/scenes.md")).expect("docs/scenes.md");
    let told = |scene: &str| -> BTreeSet<String> {
        let all = faults(scene).0;
        let unknown = all.iter().find(|fault| fault.rule == "unknown-key");
        let help = unknown.and_then(|fault| fault.help.as_deref());
        let words = help.expect("the keys that it knows").split('`');
        words.skip(1).step_by(2).map(String::from).collect()
    };
    for (scene, pointer) in [
        ("zzzzzzzzzz: 1", "/properties"),
        (
            "integration: { zzzzzzzzzz: 1 }",
            "/$defs/integration/properties",
        ),
    ] {
        let known = told(scene);
        let keys = schema.pointer(pointer).and_then(Value::as_object);
        let keys: BTreeSet<String> = keys.expect("properties").keys().cloned().collect();
        assert_eq!(keys, known);
        for key in known {
            assert!(
                page.contains(&format!("`{key}`")) || page.contains(&format!("{key}:")),
                "{key}"
            );
        }
    }
}

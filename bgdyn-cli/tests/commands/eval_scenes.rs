//! `bgdyn eval` of scenes.

use serde_json::{Value, json};

use crate::{Run, bgdyn, scratch};

const BLOCK: &str = "\
format: 1
links:
  - name: block
    joint: { name: slide, type: prismatic, axis: x }
    mass: 2 kg
effects:
  rubber: { type: spring, joint: slide, stiffness: { parameter: stiffness, value: 50 N/m } }
  oil: { type: viscous, joint: slide, damping: 3 N*s/m }
";

const SCENE: &str = "\
scene: 1
mechanism: block.yaml
effects: [rubber, oil]
inputs: { slide: { ramp: { from: 4, rate: 10 } } }
initial: { slide: 0.1 m }
outputs: [slide]
";

/// Runs a function of the block's scene at the given states.
fn at(test: &str, function: &str, states: &str, more: &[&str]) -> Run {
    scratch(test, "block.yaml", BLOCK);
    let scene = scratch(test, "pull.scene.yaml", SCENE);
    let states = scratch(test, "states.json", format!("{{\"states\": [{states}]}}"));
    let mut arguments = vec!["eval", scene.as_str(), function, "--states", &states];
    arguments.extend(more);
    bgdyn(&arguments)
}

fn told(run: &Run) -> Value {
    serde_json::from_str(&run.stdout).expect("JSON")
}

/// 2 v̇ = u − 50 x − 3 v, with u = 4 + 10 t by default.
#[test]
fn states_by_name_and_as_arrays() {
    let states =
        r#"{}, {"y": {"slide_rate": 2}, "t": 0.5}, {"y": [0.2, 1], "input": {"slide": 1}}"#;
    let run = at("scene_states", "derivative", states, &[]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let wanted = json!({
        "function": "derivative",
        "names": ["slide", "slide_rate"],
        "results": [[0.0, -0.5], [2.0, -1.0], [1.0, -6.0]],
    });
    assert_eq!(told(&run), wanted);
    let stiffer = ["--parameter", "stiffness=60"];
    let run = at("scene_parameter", "derivative", "{}", &stiffer);
    assert_eq!(told(&run)["results"], json!([[0.0, -1.0]]));
}

#[test]
fn every_kind_of_function() {
    let state = r#"{"y": [0.2, 1], "t": 0.1}"#;
    let results = |function: &str, state: &str| {
        let run = at(&format!("scene_{function}"), function, state, &[]);
        assert_eq!(run.code, Some(0), "{function}: {}", run.stderr);
        told(&run)["results"][0].clone()
    };
    assert_eq!(results("input", state), json!([5.0]));
    assert_eq!(results("output", state), json!([0.2]));
    let energy = told(&at("scene_names", "energy", state, &[]));
    assert_eq!(energy["names"], json!(["rubber", "oil", "links", "drives"]));
    assert_eq!(results("energy", state), json!([1.0, 0.0, 1.0, 0.0]));
    // v̇ = −4: supplied, stored per second, dissipated.
    let power = json!([
        [0.0, 10.0, 0.0],
        [0.0, 0.0, 3.0],
        [0.0, -8.0, 0.0],
        [5.0, 0.0, 0.0]
    ]);
    assert_eq!(results("power", state), power);
    let accelerated = r#"{"y": [0.2, 1], "acceleration": {"slide": 3}}"#;
    assert_eq!(results("inverse", accelerated), json!([19.0]));
    let slopes = json!({
        "along_state": [[0.0, 1.0], [-25.0, -1.5]],
        "along_time": [0.0, 5.0],
    });
    assert_eq!(results("jacobian", state), slopes);
    // 1 N on 2 kg.
    assert_eq!(results("input_jacobian", state), json!([[0.0], [0.5]]));
    assert_eq!(results("to_canonical", state), json!([0.2, 2.0]));
    assert_eq!(
        results("from_canonical", r#"{"z": [0.2, 2]}"#),
        json!([0.2, 1.0])
    );
    let rates = results("canonical_rates", r#"{"z": [0.2, 2], "t": 0.1}"#);
    assert_eq!(rates, json!([1.0, -8.0]));
}

/// The ends of a rod that turns at 2 rad/s about its middle, which rests: r ω² towards the middle.
#[test]
fn biases_of_rigid_contacts() {
    let states = r#"{"states": [{"y": {"rod_y": 0.7, "rod_turn_rate": 2}}]}"#;
    let states = scratch("scene_biases", "states.json", states);
    let scene = "tests/rigid_contact/jams.scene.yaml";
    let run = bgdyn(&["eval", scene, "rigid_contact_biases", "--states", &states]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let report = told(&run);
    assert_eq!(report["names"], json!(["ends_tail", "ends_head"]));
    // Zeros of either sign.
    let results: Vec<Vec<[f64; 3]>> =
        serde_json::from_value(report["results"].clone()).expect("rows of three");
    assert_eq!(results, [vec![[2.0, 0.0, 0.0], [-2.0, 0.0, 0.0]]]);
}

#[test]
fn what_is_wrong_is_said_state_by_state() {
    let states = r#"{}, {"y": {"slid": 1}}, {"y": [1]}, {"y": [1e400, 0]}, {"t": "now"}, {"y": 3}"#;
    let run = at("scene_wrong", "derivative", states, &[]);
    assert_ne!(run.code, Some(0));
    let report = told(&run);
    let messages: Vec<&str> = report["errors"]
        .as_array()
        .expect("errors")
        .iter()
        .map(|e| e["message"].as_str().expect("a message"))
        .collect();
    assert_eq!(
        messages,
        [
            "`y` has no part `slid`; there are slide, slide_rate",
            "`y` has 1 components instead of 2: slide, slide_rate",
            "`y`: `slide` is not a finite number",
            "`t` is not a finite number",
            "`y` is neither an array nor an object",
        ]
    );
    assert_eq!(report["results"][1], Value::Null);
    assert_ne!(report["results"][0], Value::Null);
}

#[test]
fn a_function_that_the_scene_lacks() {
    let run = at("scene_lacks", "contacts", "{}", &[]);
    assert_ne!(run.code, Some(0));
    let wanted = "this scene has no function `contacts`; it has derivative, inverse, input, power";
    assert!(run.stderr.contains(wanted), "{}", run.stderr);
    let run = at(
        "scene_choice",
        "derivative",
        "{}",
        &["--formulation", "literal"],
    );
    assert!(run.stderr.contains("are of mechanisms"), "{}", run.stderr);
}

/// A sum has the values of its terms, added up; its faults have the places of the terms.
#[test]
fn signals_add_up() {
    let input = |name: &str, signal: &str| {
        scratch(name, "block.yaml", BLOCK);
        let scene = SCENE.replace("{ ramp: { from: 4, rate: 10 } }", signal);
        let scene = scratch(name, "pull.scene.yaml", scene);
        let states = scratch(name, "states.json", r#"{"states": [{"t": 0.25}]}"#);
        bgdyn(&["eval", &scene, "input", "--states", &states])
    };
    let terms =
        "[1, { ramp: { from: 4, rate: 10 } }, { harmonic: { amplitude: 3, frequency: 1 Hz } }]";
    let run = input("scene_sum", &format!("{{ sum: {terms} }}"));
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let sum = told(&run)["results"][0][0].as_f64().expect("a number");
    assert!((sum - (1.0 + 6.5 + 3.0)).abs() < 1e-14, "{sum}");
    let empty = input("scene_empty_sum", "{ sum: [] }").bad_input();
    assert!(empty.contains("the sum has no terms"), "{empty}");
    let wrong = input("scene_wrong_sum", "{ sum: [1 m, { wave: 2 }] }").bad_input();
    assert!(wrong.contains("1 m") && wrong.contains("wave"), "{wrong}");
}

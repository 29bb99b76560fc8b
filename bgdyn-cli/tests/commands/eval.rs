//! `bgdyn eval`.

use std::fs;

use serde_json::{Value, json};

use crate::{Run, bgdyn, root, scratch};

const SCARA: &str = "tests/golden/specs/scara4.yaml";
const VALUES: &str = "tests/golden/values/scara4.json";

const SLIDE: &str = "\
format: 1
links:
  - name: platform
    joint: { name: slide, type: prismatic }
    mass: 2
";

fn parsed(text: &str) -> Value {
    serde_json::from_str(text).expect("JSON")
}

/// Runs a method at the given states.
fn at(test: &str, spec: &str, method: &str, states: &str) -> Run {
    let spec = scratch(test, "model.yaml", spec);
    let states = scratch(test, "states.json", format!("{{\"states\": [{states}]}}"));
    bgdyn(&["eval", &spec, method, "--states", &states])
}

/// Returns the largest difference of two values of one shape, relative to the larger of 1 and the largest
/// expected number.
fn difference(found: &Value, expected: &Value) -> f64 {
    fn numbers(value: &Value, out: &mut Vec<f64>) {
        match value {
            Value::Array(values) => values.iter().for_each(|v| numbers(v, out)),
            number => out.push(number.as_f64().expect("a number")),
        }
    }
    let (mut a, mut b) = (vec![], vec![]);
    numbers(found, &mut a);
    numbers(expected, &mut b);
    assert_eq!(a.len(), b.len());
    let scale = b.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
    a.iter()
        .zip(&b)
        .fold(0.0, |m: f64, (x, y)| m.max((x - y).abs() / scale))
}

#[test]
fn a_golden_file_as_it_is() {
    let golden = parsed(&fs::read_to_string(root().join(VALUES)).expect("the values"));
    let states = golden["states"].as_array().expect("states");
    for (method, quantity) in [
        ("inverse_dynamics", "tau"),
        ("mass_matrix", "M"),
        ("bias", "nle"),
        ("gravity", "g"),
        ("forward_dynamics", "qdd"),
        ("kinetic_energy", "T"),
    ] {
        let text = bgdyn(&["eval", SCARA, method, "--states", VALUES]).good();
        assert!(text.starts_with(&format!("{{\"function\":\"{method}\",\"results\":[")));
        assert!(text.ends_with("]}\n") && text.lines().count() == 1);
        let report = parsed(&text);
        let results = report["results"].as_array().expect("results");
        assert_eq!(results.len(), states.len());
        assert!(report.get("errors").is_none());
        for (result, state) in results.iter().zip(states) {
            let Some(expected) = state.get(quantity).filter(|e| !e.is_null()) else {
                continue; // large quantities stand in the first states only
            };
            let worst = difference(result, expected);
            assert!(worst < 1e-11, "{method}: {worst:e}");
        }
    }
}

#[test]
fn numbers_are_as_short_as_they_can_be() {
    let states = r#"{"q": [0], "v": [0], "a": [0.1]}, {"q": [0], "v": [0], "a": [1e22]}"#;
    let spec = format!("gravity: [0, 0, 0]\n{SLIDE}");
    let text = at("eval_short", &spec, "inverse_dynamics", states).good();
    let results = text.split("\"results\":").nth(1);
    assert_eq!(results, Some("[[0.2],[2e+22]]}\n"));
}

#[test]
fn shapes_of_the_results() {
    let spec = format!(
        "{SLIDE}  - {{ name: top, parent: platform, joint: {{ name: turn, type: revolute }}, mass: 1, inertia: {{ xx: 0.5, yy: 0.5, zz: 0.5 }} }}\n"
    );
    let states = r#"{"q": [0.5, 1], "v": [1, 2]}"#;
    let result = |method: &str| {
        let text = at("eval_shapes", &spec, method, states).good();
        parsed(&text)["results"][0].clone()
    };
    let mass = json!([[3.0, 0.0], [0.0, 0.5]]);
    assert!(difference(&result("mass_matrix"), &mass) < 1e-15);
    assert!(result("mass_matrix")[1].is_array());
    assert!(difference(&result("kinetic_energy"), &json!(2.5)) < 1e-15);
    assert!(result("potential_energy").is_number());
}

/// A sphere above the ground, on a platform of 2 kg that moves up and down.
#[test]
fn contacts_are_poses_and_matrices() {
    let spec = format!(
        "{SLIDE}contacts:\n  foot: {{ link: platform, at: [0.3, 0, 0], radius: 100 mm, on: ground }}\nplanes:\n  ground: {{ normal: z }}\n"
    );
    let result = |method: &str| {
        let text = at("eval_contacts", &spec, method, r#"{"q": [0.5], "v": [2]}"#).good();
        parsed(&text)["results"][0].clone()
    };
    let zeros = [0.0; 3];
    let expected = [
        ("contact_gaps", json!([0.4])),
        ("contact_velocity", json!([0.0, 0.0, 2.0])),
        ("contact_jacobian", json!([[0.0], [0.0], [1.0]])),
        ("contact_bias", json!(zeros)),
        ("contact_delassus", json!([zeros, zeros, [0.0, 0.0, 0.5]])),
        ("contact_response", json!([[0.0, 0.0, 0.5]])),
    ];
    for (method, expected) in expected {
        assert!(difference(&result(method), &expected) < 1e-15, "{method}");
    }
    let frames = result("contact_frames");
    assert_eq!(frames.as_array().map(Vec::len), Some(1));
    let at = json!([0.3, 0.0, 0.4]);
    assert!(difference(&frames[0]["translation"], &at) < 1e-15);
    assert!(frames[0]["rotation"][0].is_array());
}

/// Four lists of matrices, one for each effort.
#[test]
fn second_derivatives_are_nested_lists() {
    let golden = "tests/golden/second/scara4.json";
    let states = parsed(&fs::read_to_string(root().join(golden)).expect("the values"));
    let arguments = ["eval", SCARA, "inverse_dynamics_second", "--states", golden];
    let results = parsed(&bgdyn(&arguments).good())["results"].clone();
    let wanted = &states["states"][0]["second"];
    for (list, key) in ["qq", "qv", "vv", "aq"].iter().enumerate() {
        let found = &results[0][list];
        assert!(difference(found, &wanted[key]) < 1e-12, "{key}");
        let lengths = [found, &found[0], &found[0][0]].map(|x| x.as_array().map(Vec::len));
        assert_eq!(lengths, [Some(4); 3]);
    }
}

#[test]
fn states_that_fail_do_not_spoil_the_others() {
    let states = r#"
        {"q": [0], "v": [0], "a": [1]},
        {"q": [0, 1], "v": [0], "a": [1]},
        {"q": [0], "v": [0]},
        {"q": [0], "v": [1e999], "a": [1]},
        {"q": [0], "v": [0], "a": [NaN]},
        {"q": [-Infinity], "v": [0], "a": [1]},
        {"q": [null], "v": [0], "a": [1]},
        {"q": ["0"], "v": [0], "a": [1]},
        {"q": 0, "v": [0], "a": [1]},
        null,
        {"q": [0], "v": [0], "a": [1e308]},
        {"q": [0], "v": [0], "a": [2], "note": "NaN \" NaN"}"#;
    let spec = format!(
        "gravity: [0, 0, 0]\n{}",
        SLIDE.replace("mass: 2", "mass: 4")
    );
    let run = at("eval_failures", &spec, "inverse_dynamics", states);
    let report = parsed(&run.stdout);
    let stderr = run.bad_input();
    assert_eq!(stderr, "bgdyn: 10 of 12 states failed\n");
    let results = report["results"].as_array().expect("results");
    assert_eq!(results.len(), 12);
    assert_eq!(difference(&results[0], &json!([4])), 0.0);
    assert_eq!(difference(&results[11], &json!([8])), 0.0);
    assert!(results[1..11].iter().all(Value::is_null));
    let errors = report["errors"].as_array().expect("errors");
    let expected = [
        (1, json!(null), "`q` has 2 components instead of 1"),
        (2, json!(null), "no array `a`"),
        (3, json!("slide"), "`v[0]` is not a finite number"),
        (4, json!("slide"), "`a[0]` is not a finite number"),
        (5, json!("slide"), "`q[0]` is not a finite number"),
        (6, json!("slide"), "`q[0]` is not a finite number"),
        (7, json!("slide"), "`q[0]` is not a finite number"),
        (8, json!(null), "no array `q`"),
        (9, json!(null), "no array `q`"),
        (
            10,
            json!(null),
            "the result is not finite: the input is too large",
        ),
    ];
    assert_eq!(errors.len(), expected.len());
    for (error, (state, joint, message)) in errors.iter().zip(expected) {
        let entry = json!({ "state": state, "joint": joint, "message": message });
        assert_eq!(*error, entry);
    }
}

#[test]
fn a_singular_mass_matrix_names_the_joint() {
    let spec = format!(
        "{SLIDE}  - {{ name: tip, parent: platform, joint: {{ name: wrist, type: revolute }} }}\n"
    );
    let states = r#"{"q": [0, 0], "v": [0, 0], "tau_in": [0, 0]}"#;
    let run = at("eval_singular", &spec, "forward_dynamics", states);
    let report = parsed(&run.stdout);
    run.bad_input();
    assert_eq!(report["results"], json!([null]));
    assert_eq!(report["errors"][0]["state"], 0);
    assert_eq!(report["errors"][0]["joint"], "wrist");
    let message = report["errors"][0]["message"].as_str().expect("text");
    assert!(message.starts_with("singular mass matrix: joint `wrist` "));
    // Methods without an inverse work.
    at("eval_singular", &spec, "gravity", states).good();
}

#[test]
fn one_formulation_gives_the_same_values() {
    let eval = |more: &[&str]| {
        let base = ["eval", SCARA, "inverse_dynamics", "--states", VALUES];
        parsed(&bgdyn(&[&base, more].concat()).good())["results"].clone()
    };
    let worst = difference(&eval(&["--formulation", "literal"]), &eval(&[]));
    assert!(worst < 1e-12, "{worst:e}");
}

#[test]
fn files_that_hold_no_states() {
    for text in ["{}", "[]", "{\"states\": 1}", "{\"states\": [}"] {
        let spec = scratch("eval_no_states", "model.yaml", SLIDE);
        let states = scratch("eval_no_states", "states.json", text);
        let run = bgdyn(&["eval", &spec, "gravity", "--states", &states]);
        assert_eq!(run.stdout, "");
        assert!(run.bad_input().starts_with("bgdyn: "), "{text}");
    }
}

const LIFT: &str = "\
format: 1
links:
  - name: platform
    joint: { name: slide, type: prismatic }
    mass: { parameter: load, value: 2 kg }
    com: [{ parameter: reach, value: 0 }, 0, 0]
";

#[test]
fn parameters_have_the_specs_values_or_those_given() {
    let spec = scratch("eval_parameters", "model.yaml", LIFT);
    let states = scratch(
        "eval_parameters",
        "states.json",
        "{\"states\": [{\"q\": [0]}]}",
    );
    let call = |more: &[&str]| {
        let mut arguments = vec!["eval", &spec, "mass_matrix", "--states", &states];
        arguments.extend(more);
        bgdyn(&arguments)
    };
    let mass = |more: &[&str]| parsed(&call(more).good())["results"][0][0][0].clone();
    assert_eq!(mass(&[]), json!(2.0));
    assert_eq!(mass(&["--parameter", "load=2.5"]), json!(2.5));
    assert_eq!(
        mass(&["--parameter", "load=5e-1", "--parameter", "reach=-3"]),
        json!(0.5)
    );

    let usage = |value: &str| call(&["--parameter", value]).bad_usage();
    assert_eq!(
        usage("lod=1"),
        "bgdyn: no parameter `lod`; there are load, reach\n"
    );
    assert_eq!(
        usage("load"),
        "bgdyn: `--parameter load`: write NAME=VALUE\n"
    );
    for value in ["load=", "load=2 m", "load=nan", "load=1e999"] {
        let told = usage(value);
        let place = format!("bgdyn: `--parameter {value}`: ");
        assert!(told.starts_with(&place), "{told}");
    }
    let twice = call(&["--parameter", "load=1", "--parameter", "load=2"]).bad_usage();
    assert_eq!(twice, "bgdyn: the parameter `load` is set twice\n");
    let none = bgdyn(&[
        "eval",
        SCARA,
        "gravity",
        "--states",
        VALUES,
        "--parameter",
        "load=1",
    ]);
    assert_eq!(
        none.bad_usage(),
        "bgdyn: no parameter `load`: the spec has none\n"
    );
}

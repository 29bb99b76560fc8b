//! `bgdyn eval` of mechanisms with joints of several degrees of freedom.

use std::fs;

use serde_json::{Value, json};

use crate::{bgdyn, root, scratch};

const SPEC: &str = "tests/golden/joints/quadrotor_arm.yaml";
const VALUES: &str = "tests/golden/joints/quadrotor_arm.json";

/// A run of `bgdyn eval`.
struct Evaluated {
    code: Option<i32>,
    report: Value,
    stderr: String,
}

fn eval(spec: &str, method: &str, states: &str) -> Evaluated {
    let run = bgdyn(&["eval", spec, method, "--states", states]);
    let report = serde_json::from_str(&run.stdout);
    Evaluated {
        code: run.code,
        report: report.unwrap_or_else(|e| panic!("{method}: {e}: {}", run.stderr)),
        stderr: run.stderr,
    }
}

/// Evaluates a method at states that are written for one test.
fn at(test: &str, spec: &str, method: &str, states: &Value) -> Evaluated {
    let states = json!({ "states": states }).to_string();
    eval(spec, method, &scratch(test, "states.json", states))
}

/// Writes a spec for one test.
fn written(test: &str, spec: &str) -> String {
    scratch(test, "model.yaml", spec)
}

impl Evaluated {
    /// Returns the results of a run without failures.
    fn good(self) -> Vec<Value> {
        assert_eq!(self.code, Some(0), "{}{}", self.report, self.stderr);
        assert_eq!(self.report.get("errors"), None);
        self.report["results"].as_array().expect("results").clone()
    }

    /// Returns joint and message of the error of the one state that failed.
    fn refused(&self) -> (Value, String) {
        assert_eq!(self.code, Some(1), "{}", self.report);
        assert_eq!(self.report["results"], json!([null]));
        let errors = self.report["errors"].as_array().expect("errors");
        assert_eq!(errors.len(), 1);
        assert_eq!(errors[0]["state"], 0);
        let message = errors[0]["message"].as_str().expect("a message");
        (errors[0]["joint"].clone(), message.to_owned())
    }
}

fn golden() -> Value {
    let text = fs::read_to_string(root().join(VALUES)).expect("the values");
    serde_json::from_str(&text).expect("JSON")
}

fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(values) => values.iter().flat_map(numbers).collect(),
        number => vec![number.as_f64().expect("a number")],
    }
}

/// Asserts that all numbers agree, relative to the largest.
fn close(found: &Value, expected: &Value, what: &str) {
    let (found, expected) = (numbers(found), numbers(expected));
    assert_eq!(found.len(), expected.len(), "{what}");
    let size = expected.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    for (x, y) in found.iter().zip(&expected) {
        assert!((x - y).abs() <= 1e-12 * size, "{what}: {x} against {y}");
    }
}

#[test]
fn a_golden_file_as_it_is() {
    let golden = golden();
    let states = golden["states"].as_array().expect("states");
    for (method, quantity) in [
        ("inverse_dynamics", "tau"),
        ("mass_matrix", "M"),
        ("bias", "nle"),
        ("gravity", "g"),
        ("forward_dynamics", "qdd"),
        ("kinetic_energy", "T"),
        ("potential_energy", "V"),
    ] {
        let results = eval(SPEC, method, VALUES).good();
        assert_eq!(results.len(), states.len());
        let mut compared = 0;
        for (k, (result, state)) in results.iter().zip(states).enumerate() {
            let Some(expected) = state.get(quantity) else {
                continue; // large quantities stand in the first states only
            };
            close(result, expected, &format!("{method}, state {k}"));
            compared += 1;
        }
        assert!(compared >= 3, "{method}");
    }
}

#[test]
fn frames_and_derivatives_of_a_golden_file() {
    let golden = golden();
    let states = golden["states"].as_array().expect("states");
    let pose = eval(SPEC, "pose_tool", VALUES).good();
    let jacobian = eval(SPEC, "jacobian_world_tool", VALUES).good();
    let rate = eval(SPEC, "jacobian_dot_v_world_tool", VALUES).good();
    for (k, state) in states.iter().enumerate() {
        let tool = &state["frames"]["tool"];
        let what = format!("tool, state {k}");
        close(&pose[k]["rotation"], &tool["R"], &what);
        close(&pose[k]["translation"], &tool["p"], &what);
        close(&jacobian[k], &tool["jacobian_world"], &what);
        assert_eq!(jacobian[k].as_array().map(Vec::len), Some(6));
        assert_eq!(jacobian[k][0].as_array().map(Vec::len), Some(8));
        close(&rate[k], &tool["jacobian_dot_v_world"], &what);
    }
    let inverse = eval(SPEC, "inverse_dynamics_derivatives", VALUES).good();
    let forward = eval(SPEC, "forward_dynamics_derivatives", VALUES).good();
    for (k, state) in states.iter().take(3).enumerate() {
        let what = format!("derivatives, state {k}");
        close(&inverse[k][0], &state["dtau_dq"], &what);
        close(&inverse[k][1], &state["dtau_dv"], &what);
        close(&forward[k][0], &state["dqdd_dq"], &what);
        close(&forward[k][1], &state["dqdd_dv"], &what);
    }
}

/// q of the golden file's state 3 with its quaternion scaled.
fn scaled(factor: f64) -> Value {
    let mut q = numbers(&golden()["states"][3]["q"]);
    q[3..7].iter_mut().for_each(|x| *x *= factor);
    json!([{ "q": q, "v": vec![0.0; 8] }])
}

#[test]
fn a_quaternion_of_another_length_is_refused_with_its_length() {
    for factor in [1.1, 0.9, 1.0 + 1e-5, 0.0] {
        let run = at("joints_length", SPEC, "gravity", &scaled(factor));
        let (joint, message) = run.refused();
        assert_eq!(joint, "free");
        assert!(message.contains("`free`"), "{message}");
        assert!(message.contains("q[3..7]"), "{message}");
        let length = message.split("has length ").nth(1).expect("a length");
        let length: f64 = length
            .split(',')
            .next()
            .expect("it")
            .parse()
            .expect("a number");
        assert!((length - factor).abs() < 1e-12, "{message}");
    }
}

#[test]
fn a_quaternion_of_almost_length_one_is_scaled_to_it() {
    let exact = at("joints_scaled", SPEC, "gravity", &scaled(1.0)).good();
    for factor in [1.0 + 1e-9, 1.0 - 1e-9, 1.0 + 0.9e-6, -1.0] {
        let found = at("joints_scaled", SPEC, "gravity", &scaled(factor)).good();
        let (found, exact) = (numbers(&found[0]), numbers(&exact[0]));
        for (x, y) in found.iter().zip(&exact) {
            // 1e-9 in the length would be 1e-9 in the result.
            assert!((x - y).abs() < 1e-13, "{factor}: {x} against {y}");
        }
    }
}

/// With `quaternion: any` no length is refused, and none changes the result.
#[test]
fn a_quaternion_of_any_length_is_taken_as_it_is() {
    let text = fs::read_to_string(root().join(SPEC)).expect("the spec");
    let any = text
        .replace("name: quadrotor_arm\n", "")
        .replace("type: floating", "type: floating, quaternion: any");
    let spec = written("joints_any", &any);
    let exact = at("joints_any", SPEC, "gravity", &scaled(1.0)).good();
    for factor in [1.1, 0.5, 30.0] {
        let found = at("joints_any", &spec, "gravity", &scaled(factor)).good();
        close(&found[0], &exact[0], &format!("{factor}"));
    }
    // No rotation at all: refused, not a number.
    let run = at("joints_any", &spec, "gravity", &scaled(0.0));
    assert_eq!(run.code, Some(1), "{}", run.report);
}

#[test]
fn q_has_nq_components_and_v_has_nv() {
    let state = |q: usize, v: usize| {
        let mut q = vec![0.0; q];
        q[6] = 1.0;
        json!([{ "q": q, "v": vec![0.0; v] }])
    };
    let said = |states: &Value| at("joints_number", SPEC, "bias", states).refused().1;
    assert_eq!(said(&state(8, 8)), "`q` has 8 components instead of 9");
    assert_eq!(said(&state(10, 8)), "`q` has 10 components instead of 9");
    assert_eq!(said(&state(9, 9)), "`v` has 9 components instead of 8");
    at("joints_number", SPEC, "bias", &state(9, 8)).good();
}

/// A number that is none is named by its position, not by a velocity.
#[test]
fn a_broken_number_is_named() {
    let run = at(
        "joints_broken",
        SPEC,
        "gravity",
        &json!([{ "q": [0, 0, 0, 0, 0, 0, 1, null, 0] }]),
    );
    let (joint, message) = run.refused();
    assert_eq!(
        (joint, message.as_str()),
        (json!("shoulder"), "`q[7]` is not a finite number")
    );
    let run = at(
        "joints_broken",
        SPEC,
        "gravity",
        &json!([{ "q": [0, 0, 0, 0, 0, "x", 1, 0, 0] }]),
    );
    let (joint, message) = run.refused();
    assert_eq!(
        (joint, message.as_str()),
        (json!("free_qz"), "`q[5]` is not a finite number")
    );
}

/// A rod on a ball: the rotation about its own axis has no inertia.
#[test]
fn a_vanished_pivot_names_its_velocity() {
    let spec = written(
        "joints_rod",
        "format: 1\nname: model\nlinks:\n  - name: rod\n    joint: { name: ball, type: spherical }\n    mass: 1\n    \
         com: [0, 0, -0.5]\n    inertia: { xx: 0.1, yy: 0.1, zz: 0 }\n    nonphysical: allow\n",
    );
    let states = json!([{ "q": [0, 0, 0, 1], "v": [0, 0, 0], "tau_in": [0, 0, 1] }]);
    let run = at("joints_rod", &spec, "forward_dynamics", &states);
    let (joint, message) = run.refused();
    assert_eq!(joint, "ball_rz");
    assert!(message.contains("`ball_rz`"), "{message}");
}

/// Equations are not printed for such joints; more terms would not help.
#[test]
fn equations_name_the_joint() {
    let said = bgdyn(&["equations", SPEC]).bad_input();
    assert!(said.contains("no closed form: the joint `free`"), "{said}");
    assert!(!said.contains("--limit"), "{said}");
}

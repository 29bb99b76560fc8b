//! Loops against reference solutions (`tests/golden/loops`): accelerations of all joints at every sample, by every
//! formulation; each solution was computed with multipliers and in closed form.

use std::fs;
use std::path::PathBuf;

use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;
use serde_json::Value;

use super::robot::{Robot, State, Way};

/// The formulations of the open tree.
const WAYS: [Way; 3] = [None, Some("recursion"), Some("subspaces")];

pub fn file(parts: [&str; 2]) -> String {
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "..", parts[0], parts[1]]
        .iter()
        .collect();
    fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Returns a spec of `specs/loops` with its name.
pub fn spec(name: &str) -> String {
    let text = file(["specs/loops", &format!("{name}.yaml")]);
    text.replacen("format: 1", &format!("format: 1\nname: {name}"), 1)
}

pub fn reference(name: &str) -> Value {
    let json = file(["tests/golden/loops", &format!("{name}.json")]);
    serde_json::from_str(&json).expect("JSON")
}

pub fn numbers(value: &Value) -> Vec<f64> {
    let all = value.as_array().expect("a list").iter();
    all.map(|x| x.as_f64().expect("a number")).collect()
}

pub fn names(value: &Value) -> Vec<String> {
    let all = value.as_array().expect("a list").iter();
    all.map(|x| x.as_str().expect("a name").to_owned())
        .collect()
}

/// Returns the joints of the reference, and the index of each independent joint among them: a joint is called like
/// its link, with an ending.
pub fn joints(robot: &Robot, file: &Value) -> (Vec<String>, Vec<usize>) {
    let links = file["mechanism"].as_array().expect("links").iter();
    let all: Vec<String> = links
        .map(|l| l["name"].as_str().expect("a name").to_owned())
        .collect();
    let own = |name: String| {
        let link = name
            .trim_end_matches("_angle")
            .trim_end_matches("_position")
            .to_owned();
        all.iter()
            .position(|known| *known == link)
            .expect("a joint of the reference")
    };
    let independent = robot.mechanism.joint_names().into_iter().map(own).collect();
    (all, independent)
}

fn largest(of: &[f64]) -> f64 {
    of.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}

fn chosen(from: &[f64], indices: &[usize]) -> Vec<f64> {
    indices.iter().map(|&i| from[i]).collect()
}

/// Compares accelerations, and the efforts that produce them. `efforts` are those on the joints of the tree.
fn compare(
    robot: &Robot,
    what: &str,
    (q, v, a, efforts): (&[f64], &[f64], &[f64], &[f64]),
    independent: &[usize],
    tolerance: f64,
) {
    let closed = robot.graph.closed.as_deref().expect("loops");
    let q_exact: Vec<Dd> = q.iter().map(|&x| Dd::from_f64(x)).collect();
    let map = closed
        .closure
        .velocity_map(&q_exact)
        .expect("a regular position");
    // Sᵀ P
    let drive = |k: usize| -> f64 {
        let terms = map.iter().zip(efforts).map(|(row, p)| row[k].to_f64() * p);
        terms.sum()
    };
    // q̇ = S u
    let u = chosen(v, independent);
    let size = largest(v);
    for (row, rate) in map.iter().zip(v) {
        let sum: f64 = row.iter().zip(&u).map(|(s, u)| s.to_f64() * u).sum();
        let off = (sum - rate).abs();
        assert!(
            off <= tolerance * size,
            "{what}: velocity off by {off:e} of {size}"
        );
    }
    let state = State {
        q: q.to_vec(),
        v: u,
        a: chosen(a, independent),
        u: (0..independent.len()).map(drive).collect(),
    };
    for way in WAYS {
        let found: Vec<f64> = state.value(&robot.function(way, Method::ForwardDynamics));
        let size = largest(a);
        for (k, (a, expected)) in found.iter().zip(&state.a).enumerate() {
            let off = (a - expected).abs();
            assert!(
                off <= tolerance * size,
                "{what}, {way:?}, {k}: {off:e} of {size}"
            );
        }
        let found: Vec<f64> = state.value(&robot.function(way, Method::InverseDynamics));
        let bias: Vec<f64> = state.value(&robot.function(way, Method::Bias));
        let size = largest(efforts).max(largest(&bias)).max(largest(&state.u));
        for (p, expected) in found.iter().zip(&state.u) {
            let off = (p - expected).abs();
            assert!(
                off <= 10.0 * tolerance * size,
                "{what}, {way:?}: {off:e} of {size}"
            );
        }
    }
}

/// Compares all samples of a motion. `effort` returns the effort on a joint, from t, q and its rate.
fn motion(name: &str, of: &str, tolerance: f64, effort: impl Fn(&str, f64, f64, f64) -> f64) {
    let (robot, file) = (Robot::read(&spec(name)), reference(of));
    let (all, independent) = joints(&robot, &file);
    let columns = names(&file["columns"]);
    let samples = file["samples"].as_array().expect("samples");
    assert!(samples.len() > 5);
    for sample in samples {
        let sample = numbers(sample);
        let at = |column: &str| sample[columns.iter().position(|c| c == column).expect("a column")];
        let read = |ending: &str| -> Vec<f64> {
            all.iter()
                .map(|name| at(&format!("{name}{ending}")))
                .collect()
        };
        let (q, v, a) = (read(""), read("_rate"), read("_acceleration"));
        let efforts: Vec<f64> = (all.iter().enumerate())
            .map(|(j, name)| effort(name, at("t"), q[j], v[j]))
            .collect();
        let what = format!("{name} at {} s", at("t"));
        compare(
            &robot,
            &what,
            (&q, &v, &a, &efforts),
            &independent,
            tolerance,
        );
    }
}

#[test]
fn the_five_bar_moves_as_with_multipliers() {
    motion(
        "five_bar",
        "five_bar_parallel",
        1e-13,
        |name, t, q, _| match name {
            "proximal1" => -20.0 * (q - 1.9) + 3.0 * (4.0 * t).sin() + 1.2,
            "proximal2" => -20.0 * (q - 1.2) + 2.0 * (3.0 * t).cos() - 0.5,
            _ => 0.0,
        },
    );
}

#[test]
fn the_slider_crank_moves_as_with_multipliers() {
    let torque = |name: &str, _, _, _| if name == "crank" { 0.5 } else { 0.0 };
    motion("slider_crank", "slider_crank", 1e-13, torque);
}

#[test]
fn the_slider_crank_moves_near_its_singular_position_as_with_multipliers() {
    motion(
        "slider_crank_near_singular",
        "slider_crank_near_singular",
        1e-12,
        |_, _, _, _| 0.0,
    );
}

#[test]
fn the_stewart_platform_moves_as_with_multipliers() {
    motion(
        "stewart_platform",
        "stewart_platform",
        1e-12,
        |name, t, q, v| {
            let Some(leg) = name
                .strip_prefix("leg")
                .and_then(|n| n.strip_suffix("_length"))
            else {
                return 0.0;
            };
            let k: f64 = leg.parse::<f64>().expect("a number") - 1.0;
            30.0 - 2000.0 * (q - 0.75) - 60.0 * v + 40.0 * ((k + 2.0) * t + k).sin()
        },
    );
}

/// Compares the states of a static file: accelerations under efforts of the actuated joints.
fn states(name: &str, of: &str, tolerance: f64) {
    let (robot, file) = (Robot::read(&spec(name)), reference(of));
    let (all, independent) = joints(&robot, &file);
    let actuated = names(&file["actuated"]);
    for (k, state) in file["states"]
        .as_array()
        .expect("states")
        .iter()
        .enumerate()
    {
        let forward = &state["forward"];
        let (q, v, a) = (
            numbers(&state["q"]),
            numbers(&state["qd"]),
            numbers(&forward["qdd"]),
        );
        let drive = numbers(&forward["actuator_efforts"]);
        let effort = |name: &String| match actuated.iter().position(|known| known == name) {
            Some(k) => drive[k],
            None => 0.0,
        };
        let efforts: Vec<f64> = all.iter().map(effort).collect();
        let what = format!("{name}, state {k}");
        compare(
            &robot,
            &what,
            (&q, &v, &a, &efforts),
            &independent,
            tolerance,
        );
    }
}

#[test]
fn the_delta_robot_accelerates_as_with_multipliers() {
    states("delta_robot", "delta_robot_static", 1e-12);
}

#[test]
fn the_stewart_platform_accelerates_as_with_multipliers() {
    states("stewart_platform", "stewart_platform_static", 1e-12);
}

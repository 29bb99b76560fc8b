//! Compares poses, velocities, Jacobians and J̇v of links and frames with external values: those of an
//! independent script, and of Pinocchio. Every formulation, in double-double and in `f64`.

use std::fs;
use std::path::{Path, PathBuf};

use crate::common::{FORMULATIONS, Robot, State, natural_size};
use bgdyn_codegen::bond_graph::SiteId;
use bgdyn_codegen::method::Method;
use bgdyn_runtime::{Dd, Scalar};
use serde_json::Value;

/// Largest number of joints for which the graph of the literal sum is small enough.
const LITERAL_UP_TO: usize = 12;
/// Tolerance of values in double-double, in roundings of the natural size: half of one is the rounding of
/// the golden values.
const EXACT: f64 = 0.5;
/// Tolerance in `f64`, in the same unit.
const ROUNDED: f64 = 1.0;
/// Tolerance for Pinocchio's own rounding, in the same unit.
const PEER: f64 = 2.0;

fn root(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Returns the golden files of a folder: each file's stem and content.
fn files(folder: &str) -> Vec<(String, Value)> {
    let entries = fs::read_dir(root(folder)).expect("the folder of golden values");
    let paths = entries.map(|e| e.expect("an entry").path());
    let mut paths: Vec<PathBuf> = paths
        .filter(|p| p.extension().is_some_and(|e| e == "json"))
        .collect();
    paths.sort();
    let read = |p: &PathBuf| {
        let stem = p
            .file_stem()
            .expect("a name")
            .to_string_lossy()
            .into_owned();
        (stem, serde_json::from_str(&text(p)).expect("JSON"))
    };
    paths.iter().map(read).collect()
}

/// All numbers in a value, row by row.
fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(rows) => rows.iter().flat_map(flat).collect(),
        number => vec![number.as_f64().expect("a number")],
    }
}

/// For each coordinate its joint's place in the golden file.
fn order(robot: &Robot, file: &Value) -> Vec<usize> {
    let names: Vec<&str> = file["joints"]
        .as_array()
        .expect("joints")
        .iter()
        .filter_map(Value::as_str)
        .collect();
    assert_eq!(names.len(), robot.nv());
    let place = |joint: &String| {
        names
            .iter()
            .position(|n| n == joint)
            .expect("the joint is there")
    };
    robot.joints().iter().map(place).collect()
}

/// q and v of a golden state, in the robot's order.
fn at(state: &Value, order: &[usize]) -> State {
    let of = |key: &str| {
        let x = flat(&state[key]);
        order.iter().map(|&i| x[i]).collect::<Vec<f64>>()
    };
    let zeros = vec![0.0; order.len()];
    State {
        q: of("q"),
        v: of("v"),
        a: zeros.clone(),
        tau: zeros,
        parameters: vec![],
    }
}

/// The columns of a 6 × n matrix in the robot's order.
fn columns(matrix: &Value, order: &[usize]) -> Vec<f64> {
    let rows = matrix.as_array().expect("rows").iter().map(flat);
    rows.flat_map(|row| order.iter().map(|&i| row[i]).collect::<Vec<f64>>())
        .collect()
}

fn site(robot: &Robot, name: &str) -> SiteId {
    let found = robot.graph.sites.iter().position(|s| s.name == name);
    SiteId(found.unwrap_or_else(|| panic!("no place `{name}`")))
}

/// The comparison, and the largest error in units of the tolerance.
#[derive(Default)]
struct Tally {
    compared: usize,
    worst: f64,
}

impl Tally {
    /// The method's value in a scalar, entry by entry.
    fn compare<T>(
        &mut self,
        robot: &Robot,
        (way, method): (&str, Method),
        s: &State,
        wanted: &[f64],
        roundings: f64,
    ) where
        T: Scalar<Refused = Option<usize>> + Into<Dd>,
    {
        let found: Vec<T> = s.value(&robot.function(way, method));
        let allowed = roundings * f64::EPSILON * natural_size(robot, s, method);
        assert_eq!(found.len(), wanted.len());
        for (k, (&x, &y)) in found.iter().zip(wanted).enumerate() {
            let x: Dd = x.into();
            let off = (x - Dd::from_f64(y)).abs().to_f64();
            let name = method.name(&robot.graph.sites);
            assert!(
                off <= allowed,
                "{way}, {name}, entry {k}: {} against {y}, off by {off:e}, allowed {allowed:e}\n{s:?}",
                x.to_f64()
            );
            self.worst = self.worst.max(off / allowed);
            self.compared += 1;
        }
    }
}

#[test]
fn places_equal_the_values_of_the_script() {
    let files = files("tests/golden/places");
    assert!(files.len() >= 19, "golden files are missing");
    for (name, file) in files {
        let robot = Robot::read(
            &text(&root(file["spec"].as_str().expect("a path"))),
            Some(&name),
        );
        let order = order(&robot, &file);
        let (mut exact, mut rounded) = (Tally::default(), Tally::default());
        for state in file["states"].as_array().expect("states") {
            let s = at(state, &order);
            assert!(s.v.iter().all(|v| *v != 0.0), "{name}: velocities");
            for (place, of) in state["places"].as_object().expect("places") {
                let [pose, velocity, jacobian, rate] = Method::of_site(site(&robot, place));
                let mut whole = flat(&of["rotation"]);
                whole.extend(flat(&of["translation"]));
                for (method, wanted) in [
                    (pose, whole),
                    (velocity, flat(&of["velocity"])),
                    (jacobian, columns(&of["jacobian"], &order)),
                    (rate, flat(&of["jacobian_dot_v"])),
                ] {
                    for way in FORMULATIONS {
                        if way == "literal" && robot.nv() > LITERAL_UP_TO {
                            continue;
                        }
                        exact.compare::<Dd>(&robot, (way, method), &s, &wanted, EXACT);
                        rounded.compare::<f64>(&robot, (way, method), &s, &wanted, ROUNDED);
                    }
                }
            }
        }
        let Tally { compared, worst } = exact;
        assert!(compared > 0, "{name}: nothing compared");
        println!(
            "{name:14} {compared:6} numbers, worst at {worst:.2} of what is allowed in double-double, {:.2} in f64",
            rounded.worst
        );
    }
}

#[test]
fn jacobians_equal_those_of_another_library() {
    let files = files("tests/golden/jacobians");
    assert!(files.len() >= 4, "golden files are missing");
    for (name, file) in files {
        let own = root(&format!("tests/golden/jacobians/{name}.yaml"));
        let spec = if own.exists() {
            own
        } else {
            root(&format!("tests/golden/specs/{name}.yaml"))
        };
        let robot = Robot::read(&text(&spec), Some(&name));
        let order = order(&robot, &file);
        let [_, velocity, jacobian, rate] =
            Method::of_site(site(&robot, file["link"].as_str().expect("a link")));
        let mut tally = Tally::default();
        for state in file["states"].as_array().expect("states") {
            let s = at(state, &order);
            let j = columns(&state["J"], &order);
            let moving: Vec<f64> = j
                .chunks(order.len())
                .map(|row| row.iter().zip(&s.v).map(|(x, v)| x * v).sum())
                .collect();
            for way in FORMULATIONS {
                tally.compare::<f64>(&robot, (way, jacobian), &s, &j, PEER);
                tally.compare::<f64>(&robot, (way, velocity), &s, &moving, PEER);
                tally.compare::<f64>(&robot, (way, rate), &s, &flat(&state["Jdot_v"]), PEER);
            }
        }
        println!(
            "{name:14} {:6} numbers, worst at {:.2} of what is allowed",
            tally.compared, tally.worst
        );
        assert!(tally.compared > 0, "{name}: nothing compared");
    }
}

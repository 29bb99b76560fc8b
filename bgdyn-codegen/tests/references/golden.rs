//! Compares the golden robots in the evaluator with Pinocchio's values: every method, by joint name, every
//! formulation.

use crate::common::{FORMULATIONS, Robot, State, full, golden, largest};
use bgdyn_codegen::method::Method;
use nalgebra::DMatrix;
use serde_json::Value;

/// Largest number of joints for which the graph of the literal sum is small enough.
const LITERAL_UP_TO: usize = 8;
/// Relative to the largest entry.
const TOLERANCE: f64 = 1e-12;

fn numbers(value: &Value) -> Option<Vec<f64>> {
    value.as_array()?.iter().map(Value::as_f64).collect()
}

/// Returns, for each coordinate, its joint's index in the golden file.
fn order(robot: &Robot, values: &Value) -> Vec<usize> {
    let names: Vec<&str> = values["joints"]
        .as_array()
        .expect("names of joints")
        .iter()
        .filter_map(Value::as_str)
        .collect();
    let place = |joint: &String| names.iter().position(|n| n == joint);
    let order: Vec<usize> = robot.joints().iter().filter_map(place).collect();
    assert_eq!(order.len(), names.len(), "joints differ: {names:?}");
    order
}

/// The largest error, in units of the tolerance, and the number of compared entries.
#[derive(Default)]
struct Tally {
    worst: f64,
    compared: usize,
}

impl Tally {
    fn compare(&mut self, x: &[f64], y: &[f64], relative: f64, what: &str) {
        assert_eq!(x.len(), y.len(), "{what}");
        let allowed = relative * largest(y);
        for (k, (x, y)) in x.iter().zip(y).enumerate() {
            let off = (x - y).abs();
            assert!(
                off <= allowed,
                "{what}: entry {k}: {x} against {y}, off by {off:e}, allowed {allowed:e}"
            );
            if off > 0.0 {
                self.worst = self.worst.max(off / allowed);
            }
        }
        self.compared += x.len();
    }
}

fn check(name: &str, robot: &Robot, formulation: &str, methods: &[Method], values: &Value) {
    let n = robot.nv();
    let order = order(robot, values);
    let states = values["states"].as_array().expect("states");
    let mass_matrix = robot.function(formulation, Method::MassMatrix);
    for &method in methods {
        let function = robot.function(formulation, method);
        let mut tally = Tally::default();
        let mut energies: Vec<(f64, f64)> = Vec::new();
        for (k, state) in states.iter().enumerate() {
            let what = format!(
                "{name}, {formulation}, {}, state {k}",
                method.name(&robot.graph.sites)
            );
            let by_joint = |key: &str| {
                let x = numbers(&state[key])?;
                Some(order.iter().map(|&i| x[i]).collect::<Vec<f64>>())
            };
            let mass = || {
                let rows = state["M"].as_array()?;
                let rows: Option<Vec<Vec<f64>>> = rows.iter().map(numbers).collect();
                let rows = rows?;
                Some(DMatrix::from_fn(n, n, |i, j| rows[order[i]][order[j]]))
            };
            let given = |key: &str| by_joint(key).expect("every state has q, v, a and tau_in");
            let s = State {
                q: given("q"),
                v: given("v"),
                a: given("a"),
                tau: given("tau_in"),
                parameters: vec![],
            };
            let value = s.value::<f64>(&function);
            let vector = match method {
                Method::InverseDynamics => by_joint("tau"),
                Method::Bias => by_joint("nle"),
                Method::Gravity => by_joint("g"),
                Method::ForwardDynamics => by_joint("qdd"),
                Method::KineticEnergy => state["T"].as_f64().map(|x| vec![x]),
                Method::MassMatrix => mass().map(|m| m.transpose().as_slice().to_vec()),
                Method::PotentialEnergy => {
                    energies.extend(state["V"].as_f64().map(|v| (value[0], v)));
                    None
                }
                _ => unreachable!("no method of the trait"),
            };
            let Some(expected) = vector else { continue };
            let value = if method == Method::MassMatrix {
                full(&value, n).concat()
            } else {
                value
            };
            let mut relative = TOLERANCE;
            if method == Method::ForwardDynamics {
                // Few states contain M; in the others our own M is used, which is compared in the few.
                let own = || {
                    let rows = full(&s.value::<f64>(&mass_matrix), n);
                    DMatrix::from_fn(n, n, |i, j| rows[i][j])
                };
                let singular = mass().unwrap_or_else(own).singular_values();
                relative = relative.max(1e-15 * singular.max() / singular.min());
            }
            tally.compare(&value, &expected, relative, &what);
        }
        if method == Method::PotentialEnergy {
            potential(&mut tally, &energies, &format!("{name}, {formulation}"));
        }
        assert!(
            tally.compared > 0,
            "{name}, {}: nothing",
            method.name(&robot.graph.sites)
        );
        println!(
            "{name:14} {formulation:16} {:17} {:6} numbers, worst at {:.1e} of what is allowed",
            method.name(&robot.graph.sites),
            tally.compared,
            tally.worst
        );
    }
}

/// Up to a constant: differences from the first state, relative to the largest energy.
fn potential(tally: &mut Tally, energies: &[(f64, f64)], what: &str) {
    let Some(&(first, golden)) = energies.first() else {
        return;
    };
    let (own, theirs): (Vec<f64>, Vec<f64>) = energies
        .iter()
        .map(|(x, y)| (x - first, y - golden))
        .unzip();
    let size = energies
        .iter()
        .fold(0.0_f64, |m, (x, y)| m.max(x.abs()).max(y.abs()));
    let relative = TOLERANCE * size / largest(&theirs);
    tally.compare(
        &own,
        &theirs,
        relative,
        &format!("{what}, potential energy"),
    );
}

#[test]
fn every_method_of_every_golden_robot() {
    let mut robots = 0;
    for name in golden::names() {
        let (robot, values) = (golden::robot(&name), golden::values(&name));
        for formulation in FORMULATIONS {
            if formulation == "recursion" || robot.nv() <= LITERAL_UP_TO {
                check(&name, &robot, formulation, &Method::OF_TRAIT, &values);
            }
        }
        for formulation in ["articulated", "articulated_base"] {
            let methods = [Method::ForwardDynamics];
            check(&name, &robot, formulation, &methods, &values);
        }
        check(&name, &robot, "common_axes", &[Method::MassMatrix], &values);
        robots += 1;
    }
    assert!(robots >= 15);
}

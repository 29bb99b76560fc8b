//! Compares operational space, derivatives along directions and adjoints with values from Pinocchio's matrices
//! (`golden/operational`).

use bgdyn_codegen::bond_graph::SiteId;
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::{Directional, Method, Operational, Shape};
use serde_json::Value;

use crate::common::{Robot, golden};

/// Relative to the largest entry, times the condition of what was inverted.
const TOLERANCE: f64 = 1e-12;

/// Largest factor by which inverse matrices of these robots enlarge rounding errors.
const CONDITION: f64 = 1e4;

/// Returns the numbers of a vector or of a matrix, row by row.
fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(all) => all.iter().flat_map(numbers).collect(),
        other => vec![other.as_f64().expect("a number")],
    }
}

fn close(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let size = expected.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
    for (k, (x, y)) in found.iter().zip(expected).enumerate() {
        let off = (x - y).abs();
        assert!(
            off <= tolerance * size,
            "{what}: entry {k}: {x} against {y}"
        );
    }
}

/// Returns the result of a method as it is returned, without what is only checked.
fn value(robot: &Robot, method: Method, at: &Inputs<f64>) -> Vec<f64> {
    let nv = robot.nv();
    let (values, refused) = robot.emitted(method).evaluate(at.clone());
    assert_eq!(refused, None);
    match method.shape() {
        Shape::Checked(entries) => entries.spread(&values[nv..], nv),
        _ => values,
    }
}

fn check(name: &str, robot: &Robot) {
    let folder = format!("{}/../tests/golden/operational", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(format!("{folder}/{name}.json"));
    let reference: Value = serde_json::from_str(&text.expect("golden values")).expect("JSON");
    let states = reference["states"].as_array().expect("states");
    assert_eq!(states.len(), 3);
    let site = last_link(robot);
    for state in states {
        let get = |field: &str| numbers(&state[field]);
        let at = |a: &str, u: &str, x: &str| Inputs {
            q: get("q"),
            v: get("v"),
            a: get(a),
            u: get(u),
            x: get(x),
            modes: get("dv"),
            ..Inputs::default()
        };
        for (of, field) in [
            (Operational::InverseMassMatrix, "inverse_mass_matrix"),
            (Operational::InverseInertia(site), "operational_inverse"),
            (Operational::Inertia(site), "operational_inertia"),
            (Operational::ConsistentInverse(site), "consistent_inverse"),
            (Operational::Bias(site), "operational_bias"),
        ] {
            let found = value(robot, Method::Operational(of), &at("a", "tau", "l"));
            close(
                &found,
                &get(field),
                TOLERANCE * CONDITION,
                &format!("{name}: {field}"),
            );
        }
        for of in Directional::ALL {
            let at = match of {
                Directional::InverseAlong => at("a", "da", "dq"),
                Directional::ForwardAlong => at("dtau", "tau", "dq"),
                Directional::InverseAdjoint | Directional::ForwardAdjoint => at("a", "tau", "l"),
            };
            let tolerance = match of.is_forward() {
                true => TOLERANCE * CONDITION,
                false => TOLERANCE,
            };
            let found = value(robot, Method::Directional(of), &at);
            close(
                &found,
                &get(of.name()),
                tolerance,
                &format!("{name}: {}", of.name()),
            );
        }
    }
}

/// Returns the site of the last link.
fn last_link(robot: &Robot) -> SiteId {
    let last = robot.mechanism.links().iter().rfind(|link| !link.hidden);
    let name = &last.expect("a link").name;
    let sites = &robot.graph.sites;
    SiteId(
        sites
            .iter()
            .position(|site| site.name == *name)
            .expect("its site"),
    )
}

#[test]
fn operational_space_of_arms_is_that_of_pinocchio() {
    for name in ["puma560", "panda7"] {
        check(name, &golden::robot(name));
    }
}

#[test]
fn operational_space_of_a_free_base_is_that_of_pinocchio() {
    let folder = format!("{}/../tests/golden/joints", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(format!("{folder}/satellite_arm6.yaml"));
    let robot = Robot::read(&text.expect("a spec"), Some("satellite_arm6"));
    check("satellite_arm6", &robot);
}

//! Compares operational space, derivatives along directions and adjoints with values from Pinocchio's matrices
//! (`golden/operational`).

use bgdyn_codegen::bond_graph::SiteId;
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::{Directional, Method, Operational, Shape};

use crate::common::{Robot, golden};
use crate::golden_values::{close, numbers, robot_of_joints, values};

/// Relative to the largest entry, times the condition of what was inverted.
const TOLERANCE: f64 = 1e-12;

/// Largest factor by which inverse matrices of these robots enlarge rounding errors.
const CONDITION: f64 = 1e4;

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
    let reference = values("operational", name);
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
        let first_order = |of: &Directional| !of.is_second();
        for of in Directional::ALL.into_iter().filter(first_order) {
            let at = match of {
                Directional::InverseAlong => at("a", "da", "dq"),
                Directional::ForwardAlong => at("dtau", "tau", "dq"),
                _ => at("a", "tau", "l"),
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
    check("satellite_arm6", &robot_of_joints("satellite_arm6"));
}

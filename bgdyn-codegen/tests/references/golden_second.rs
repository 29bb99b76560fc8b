//! Compares second derivatives of l·τ and of all efforts, and derivatives of the accelerations by parameters, with those of
//! Pinocchio (`golden/second`).

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::{Directional, Method, ParameterDerivatives, Regressor};

use crate::common::{Robot, golden};
use crate::golden_values::{close, numbers, values};

/// Relative to the largest entry.
const TOLERANCE: f64 = 1e-14;

/// Largest factor by which inverse mass matrices of these robots enlarge rounding errors.
const CONDITION: f64 = 1e2;

fn value(robot: &Robot, method: Method, at: &Inputs<f64>) -> Vec<f64> {
    let (values, refused) = robot.emitted(method).evaluate(at.clone());
    assert_eq!(refused, None);
    values
}

fn check(name: &str) {
    let (robot, reference) = (golden::robot(name), values("second", name));
    let states = reference["states"].as_array().expect("states");
    assert_eq!(states.len(), 2);
    let mut tensors = 0;
    for state in states {
        let of = |key: &str| numbers(&state[key]);
        let at = Inputs {
            q: of("q"),
            v: of("v"),
            a: of("a"),
            u: of("tau"),
            x: of("l"),
            ..Inputs::default()
        };
        let curvature = Method::Directional(Directional::InverseCurvature);
        let found = value(&robot, curvature, &at);
        close(
            &found,
            &of("curvature"),
            TOLERANCE,
            &format!("{name}: curvature"),
        );
        let second = Method::Directional(Directional::InverseSecond);
        let found = value(&robot, second, &at);
        if let Some(second) = state.get("second") {
            tensors += 1;
            let expected = ["qq", "qv", "vv", "aq"].map(|key| numbers(&second[key]));
            close(
                &found,
                &expected.concat(),
                TOLERANCE,
                &format!("{name}: second derivatives"),
            );
        }
        let n = robot.nv();
        let entry = |k: usize| {
            let (list, entry) = (k / (n * n), k % (n * n));
            let terms = at.x.iter().zip(found.chunks(n * n).skip(list * n));
            terms.map(|(l, matrix)| l * matrix[entry]).sum()
        };
        let contracted: Vec<f64> = (0..4 * n * n).map(entry).collect();
        close(
            &contracted,
            &of("curvature"),
            TOLERANCE,
            &format!("{name}: second derivatives times l"),
        );
        let change = value(
            &robot,
            Method::Regressor(Regressor::BaseParameters),
            &Inputs {
                u: of("parameters"),
                ..Inputs::default()
            },
        );
        let by_base = Method::ParameterDerivatives(ParameterDerivatives::Base);
        let found = value(&robot, by_base, &at);
        let rows = found[robot.nv()..].chunks(change.len());
        let product = |row: &[f64]| row.iter().zip(&change).map(|(x, y)| x * y).sum();
        let products: Vec<f64> = rows.map(product).collect();
        close(
            &products,
            &of("parameter_derivatives_times"),
            TOLERANCE * CONDITION,
            &format!("{name}: parameter derivatives"),
        );
    }
    assert_eq!(tensors, 1, "{name}: the first state has whole tensors");
}

#[test]
fn second_derivatives_and_those_by_parameters_are_those_of_pinocchio() {
    for name in ["scara4", "puma560", "panda7"] {
        check(name);
    }
}

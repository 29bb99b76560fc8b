//! Compares regressors with those of Pinocchio (`golden/regressors`): of all parameters entry by entry, of base
//! parameters by their products with K.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::{Method, Regressor};
use nalgebra::DMatrix;
use serde_json::Value;

use crate::common::{Robot, golden};
use crate::golden_values::{close, numbers, values};

/// Relative to the largest entry.
const TOLERANCE: f64 = 1e-13;

const ROBOTS: [&str; 3] = ["scara4", "puma560", "panda7"];

fn inputs(state: &Value) -> Inputs<f64> {
    let of = |key: &str| numbers(&state[key]);
    Inputs {
        q: of("q"),
        v: of("v"),
        a: of("a"),
        x: of("v_r"),
        u: of("adjoint"),
        ..Inputs::default()
    }
}

/// Returns K, row by row: the base parameters of ones in the places of the parameters.
fn transport(robot: &Robot, count: usize) -> DMatrix<f64> {
    let function = robot.emitted(Method::Regressor(Regressor::BaseParameters));
    let column = |p: usize| {
        let mut u = vec![0.0; count];
        u[p] = 1.0;
        let inputs = Inputs {
            u,
            ..Inputs::default()
        };
        function.evaluate(inputs).0
    };
    let columns: Vec<Vec<f64>> = (0..count).map(column).collect();
    DMatrix::from_fn(columns[0].len(), count, |i, j| columns[j][i])
}

fn check(name: &str) {
    let (robot, reference) = (golden::robot(name), values("regressors", name));
    let joints: Vec<&str> = (reference["joints"].as_array().expect("joints").iter())
        .filter_map(Value::as_str)
        .collect();
    assert_eq!(robot.joints(), joints, "the order of the joints");
    let parameters = numbers(&reference["parameters"]);
    let k = transport(&robot, parameters.len());
    assert_eq!(
        k.nrows() as u64,
        reference["count"],
        "{name}: base parameters"
    );
    let value = |of, at: &Inputs<f64>| {
        let function = robot.emitted(Method::Regressor(of));
        function.evaluate(at.clone()).0
    };
    let pi = value(Regressor::Parameters, &Inputs::default());
    close(&pi, &parameters, TOLERANCE, &format!("{name}: parameters"));
    for state in reference["states"].as_array().expect("states") {
        let at = inputs(state);
        let reference_a = Inputs {
            a: numbers(&state["a_r"]),
            ..at.clone()
        };
        let of_all = [
            (Regressor::Full, "regressor"),
            (Regressor::Gravity, "gravity_regressor"),
            (Regressor::Momentum, "momentum_regressor"),
            (Regressor::KineticEnergy, "kinetic_energy_regressor"),
            (Regressor::PotentialEnergy, "potential_energy_regressor"),
        ];
        for (of, key) in of_all {
            let expected = numbers(&state[key]);
            close(
                &value(of, &at),
                &expected,
                TOLERANCE,
                &format!("{name}: {key}"),
            );
        }
        let of_base = [
            (Regressor::Base, "regressor", &at),
            (Regressor::BaseGravity, "gravity_regressor", &at),
            (Regressor::BaseMomentum, "momentum_regressor", &at),
            (Regressor::Adaptive, "slotine_li_regressor", &reference_a),
        ];
        for (of, key, at) in of_base {
            let columns = DMatrix::from_row_slice(robot.nv(), k.nrows(), &value(of, at));
            let all = (columns * &k).transpose();
            let expected = numbers(&state[key]);
            close(
                all.as_slice(),
                &expected,
                TOLERANCE,
                &format!("{name}: {key} by K"),
            );
        }
        let transposed = [
            (Regressor::TransposedTimes, "regressor", &at),
            (
                Regressor::AdaptiveStep,
                "slotine_li_regressor",
                &reference_a,
            ),
        ];
        for (of, key, at) in transposed {
            let whole = DMatrix::from_row_slice(robot.nv(), k.ncols(), &numbers(&state[key]));
            let s = DMatrix::from_column_slice(1, at.u.len(), &at.u);
            let products = DMatrix::from_row_slice(1, k.nrows(), &value(of, at)) * &k;
            let expected = s * whole;
            let what = format!("{name}: products with {key}");
            close(products.as_slice(), expected.as_slice(), TOLERANCE, &what);
        }
    }
}

#[test]
fn regressors_are_those_of_pinocchio() {
    ROBOTS.into_iter().for_each(check);
}

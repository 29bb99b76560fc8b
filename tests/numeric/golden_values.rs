//! Golden values, and the comparison of a compiled model with them.

use std::fs;

use bgdyn::nalgebra::{SMatrix, SVector};
use bgdyn::{Dynamics, Scalar, Singular};
use nalgebra::DMatrix;
use serde_json::Value;

/// Golden states of a robot, joints by name.
pub(crate) struct Golden {
    states: Vec<Value>,
    /// For each joint of the model its index in the file.
    places: Vec<usize>,
}

impl Golden {
    pub(crate) fn open(robot: &str, joints: &[&str]) -> Golden {
        let path = format!(
            "{}/tests/golden/values/{robot}.json",
            env!("CARGO_MANIFEST_DIR")
        );
        let text = fs::read_to_string(&path).expect("the golden file is there");
        let file: Value = serde_json::from_str(&text).expect("the golden file is JSON");
        let names: Vec<&str> = file["joints"]
            .as_array()
            .unwrap()
            .iter()
            .map(|n| n.as_str().unwrap())
            .collect();
        let place = |j: &&str| {
            names
                .iter()
                .position(|n| n == j)
                .expect("the joint is there")
        };
        Golden {
            states: file["states"].as_array().unwrap().clone(),
            places: joints.iter().map(place).collect(),
        }
    }

    fn vector<const N: usize>(&self, state: &Value, key: &str) -> SVector<f64, N> {
        SVector::from_fn(|j, _| number(&state[key][self.places[j]]))
    }

    fn matrix<const N: usize>(&self, state: &Value, key: &str) -> Option<SMatrix<f64, N, N>> {
        state[key]
            .is_array()
            .then(|| SMatrix::from_fn(|i, j| number(&state[key][self.places[i]][self.places[j]])))
    }
}

fn number(value: &Value) -> f64 {
    value
        .as_number()
        .expect("a number")
        .to_string()
        .parse()
        .expect("an f64")
}

fn assert_near<const R: usize, const C: usize>(
    what: &str,
    found: &SMatrix<f64, R, C>,
    wanted: &SMatrix<f64, R, C>,
    relative: f64,
) {
    // Golden zeros contain the rounding error of terms that cancelled.
    let size = wanted.amax().max(1e-3);
    let error = (found - wanted).amax();
    assert!(
        error <= relative * size,
        "{what}: off by {error:e} of {size:e}"
    );
}

fn condition<const N: usize>(m: &SMatrix<f64, N, N>) -> f64 {
    let values = DMatrix::from_fn(N, N, |i, j| m[(i, j)]).singular_values();
    values.max() / values.min()
}

/// Compares a model in a scalar of rounding error `unit` (1 for f64) with its golden values.
pub(crate) fn equals_golden<T, M, const N: usize>(
    robot: &str,
    model: &M,
    joints: &[&'static str; N],
    unit: f64,
    widen: impl Fn(T) -> f64 + Copy,
) where
    T: Scalar<Singular<N> = Singular>,
    M: Dynamics<T, N, N>,
{
    let golden = Golden::open(robot, joints);
    let mut energy_offset = None;
    for state in &golden.states {
        let narrow = |v: SVector<f64, N>| v.map(T::from_f64);
        let wide = |v: SVector<T, N>| v.map(widen);
        let (q, v, a) = (
            narrow(golden.vector(state, "q")),
            narrow(golden.vector(state, "v")),
            narrow(golden.vector(state, "a")),
        );
        let relative = 1e-12 * unit;
        let vectors = [
            ("tau", model.inverse_dynamics(&q, &v, &a)),
            ("nle", model.bias(&q, &v)),
            ("g", model.gravity(&q)),
        ];
        for (key, found) in vectors {
            let wanted = golden.vector(state, key);
            assert_near(&format!("{robot} {key}"), &wide(found), &wanted, relative);
        }
        let mass = model.mass_matrix(&q).map(widen);
        assert_eq!(mass, mass.transpose(), "{robot}: M is exactly symmetric");
        if let Some(wanted) = golden.matrix(state, "M") {
            assert_near(&format!("{robot} M"), &mass, &wanted, relative);
        }
        let tau = narrow(golden.vector(state, "tau_in"));
        let found = model.forward_dynamics(&q, &v, &tau).expect("M is regular");
        let relative_fd = relative.max(1e-15 * unit * condition(&mass));
        let wanted = golden.vector(state, "qdd");
        assert_near(&format!("{robot} qdd"), &wide(found), &wanted, relative_fd);
        let kinetic = widen(model.kinetic_energy(&q, &v));
        assert_scalar(
            &format!("{robot} T"),
            kinetic,
            number(&state["T"]),
            relative,
        );
        let potential = widen(model.potential_energy(&q));
        let offset = *energy_offset.get_or_insert(potential - number(&state["V"]));
        let wanted = number(&state["V"]) + offset;
        assert_scalar(&format!("{robot} V"), potential, wanted, relative);
    }
    assert!(golden.states.len() >= 6, "{robot}: golden states are there");
}

fn assert_scalar(what: &str, found: f64, wanted: f64, relative: f64) {
    let error = (found - wanted).abs();
    assert!(
        error <= relative * wanted.abs().max(1.0),
        "{what}: {found} instead of {wanted}"
    );
}

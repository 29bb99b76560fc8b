//! Motions: RK4 in the independent velocities against reference solutions, and what long runs keep.

use std::path::PathBuf;

use bgdyn::Dynamics;
use bgdyn::nalgebra::{SVector, vector};
use bgdyn_sim::{State, rk4_step};
use serde_json::Value;

use crate::five_bar::FiveBar;
use crate::slider_crank::SliderCrank;

pub(crate) fn reference(name: &str) -> Value {
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "tests/golden/loops", name]
        .iter()
        .collect();
    let text = std::fs::read_to_string(path).expect("a reference");
    serde_json::from_str(&text).expect("JSON")
}

pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    let all = value.as_array().expect("a list").iter();
    all.map(|x| x.as_f64().expect("a number")).collect()
}

/// One step of `rk4_step`.
fn step<M: Dynamics<f64, NQ, NV>, const NQ: usize, const NV: usize>(
    model: &M,
    (q, v): (SVector<f64, NQ>, SVector<f64, NV>),
    (t, h): (f64, f64),
    tau: impl Fn(f64, &SVector<f64, NQ>) -> SVector<f64, NV>,
) -> (SVector<f64, NQ>, SVector<f64, NV>) {
    let efforts = |t, s: &State<f64, NQ, NV>| tau(t, &s.q);
    match rk4_step(model, t, &State { q, v }, h, efforts) {
        Ok(moved) => (moved.q, moved.v),
        Err(_) => panic!("no acceleration at {t} s"),
    }
}

/// The error of the cranks at 3 s, by step: fourth order, at most the reference's own table (6e-5, 6e-9).
#[test]
fn the_five_bar_follows_its_reference() {
    let (model, file) = (
        FiveBar::<f64>::default(),
        reference("five_bar_parallel.json"),
    );
    let samples = file["samples"].as_array().expect("samples");
    let last = numbers(&samples[samples.len() - 1]);
    let tau = |t: f64, q: &SVector<f64, 4>| {
        vector![
            -20.0 * (q[0] - 1.9) + 3.0 * (4.0 * t).sin() + 1.2,
            -20.0 * (q[2] - 1.2) + 2.0 * (3.0 * t).cos() - 0.5
        ]
    };
    let error = |steps: usize| {
        let first = numbers(&samples[0]);
        let start = SVector::from_fn(|k, _| first[1 + k]);
        let (mut state, h) = ((start, vector![0.0, 0.0]), 3.0 / steps as f64);
        for k in 0..steps {
            state = step(&model, state, (k as f64 * h, h), tau);
            let open = model.constraint_residual(&state.0).amax();
            assert!(open <= 4.0 * f64::EPSILON, "{open:e}");
        }
        f64::max((state.0[0] - last[1]).abs(), (state.0[2] - last[3]).abs())
    };
    let errors = [300, 600, 3000].map(error);
    assert!(errors[0] < 7e-5, "{errors:?}");
    assert!(errors[2] < 8e-9, "{errors:?}");
    let order = (errors[0] / errors[1]).log2();
    assert!(order > 3.8, "{errors:?}");
}

/// A slider-crank without torque: its energy drifts by no more than that of RK4, and the loop stays closed.
#[test]
fn the_slider_crank_keeps_its_energy_and_its_loop() {
    let model = SliderCrank::<f64>::default();
    let mut q = model.neutral();
    q[0] = 0.3;
    let q = model.close(&q).expect("within reach");
    let mut state = (q, vector![4.0]);
    let energy = |(q, v): &(SVector<f64, 3>, SVector<f64, 1>)| {
        model.kinetic_energy(q, v) + model.potential_energy(q)
    };
    let start = energy(&state);
    let h = 1e-3;
    for k in 0..20_000 {
        state = step(&model, state, (f64::from(k) * h, h), |_, _| vector![0.0]);
        let open = model.constraint_residual(&state.0).amax();
        assert!(open <= 4.0 * f64::EPSILON, "{open:e} at step {k}");
    }
    let drift = (energy(&state) - start).abs() / 3.139;
    assert!(drift < 1e-8, "{drift:e}");
}

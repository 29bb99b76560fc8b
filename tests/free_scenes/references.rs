//! Motions known to more digits than an `f64` has, and the orders of the integrators.

use bgdyn::runtime::{HybridSystem, Slope};
use bgdyn_sim::{
    Dop853, Dopri5, Gauss2, Gauss3, HybridState, Integrator, Midpoint, Moreau, Rk4, Rodas4, Run,
    ScenePlant, SemiImplicitEuler, Tolerance,
};
use serde_json::Value;

use crate::heavy_top_run::HeavyTopRun;
use crate::satellite_torques::SatelliteTorques;
use crate::{quaternion, rotation};

/// The samples of a file of golden motions.
fn samples(text: &str) -> Vec<Vec<f64>> {
    let file: Value = serde_json::from_str(text).expect("a JSON file");
    let rows = file["samples"].as_array().expect("samples");
    let number = |x: &Value| x.as_str().expect("a decimal").parse().expect("a number");
    let row = |row: &Value| row.as_array().expect("a row").iter().map(number).collect();
    rows.iter().map(row).collect()
}

fn top() -> Vec<Vec<f64>> {
    samples(include_str!("../golden/motions/heavy_top.json"))
}

/// The error of a state of the top against a sample: of the rotation matrix and of ω/40.
fn error(y: &[f64], sample: &[f64]) -> f64 {
    let (found, wanted) = (rotation(quaternion(y, 0)), rotation(quaternion(sample, 4)));
    let turned = found.iter().zip(wanted).map(|(a, b)| (a - b).abs());
    let rates = (0..3).map(|i| (y[4 + i] - sample[1 + i]).abs() / 40.0);
    turned.chain(rates).fold(0.0, f64::max)
}

/// The error at 0.6 s of the top after so many equal steps.
fn after<M>(method: M, steps: u32) -> f64
where
    M: Integrator<<HeavyTopRun as HybridSystem<f64>>::State>,
    HeavyTopRun: Slope<f64>,
{
    let scene = HeavyTopRun::<f64>::default();
    let mut run = Run::by(method, ScenePlant::with_slope(&scene), Run::begin(&scene)).unaudited();
    let sample = &top()[2];
    for _ in 0..steps {
        run.step(sample[0] / f64::from(steps)).expect("it turns");
    }
    error(run.y().as_slice(), sample)
}

/// Asserts that halving the steps divides the error as the order says, three times.
fn has_order<M>(method: M, order: f64, steps: u32)
where
    M: Integrator<<HeavyTopRun as HybridSystem<f64>>::State> + Clone,
{
    let errors: Vec<f64> = (0..4).map(|k| after(method.clone(), steps << k)).collect();
    for pair in errors.windows(2) {
        let slope = (pair[0] / pair[1]).log2();
        let name = method.info().name;
        assert!(
            slope > order - 0.2,
            "{name}: order {slope}, errors {errors:?}"
        );
    }
}

#[test]
fn explicit_integrators_keep_their_orders() {
    has_order(Rk4, 4.0, 300);
    has_order(Dopri5, 5.0, 100);
    has_order(SemiImplicitEuler, 1.0, 4000);
}

#[test]
fn implicit_integrators_keep_their_orders() {
    has_order(Midpoint::new(), 2.0, 400);
    has_order(Moreau::new(), 2.0, 400);
    has_order(Gauss2::new(), 4.0, 150);
    has_order(Gauss3::new(), 6.0, 40);
    has_order(Rodas4, 4.0, 300);
}

/// Asserts that two runs of the top, by steps and by tolerance, have the digits of the reference.
#[test]
fn the_top_goes_as_the_reference_says() {
    let scene = HeavyTopRun::<f64>::default();
    let tolerance = Tolerance {
        absolute: 1e-13,
        relative: 1e-13,
    };
    let begin = || Run::begin(&scene);
    let plain = Run::by(Dop853, ScenePlant::new(&scene), begin());
    let mut run = plain.with_tolerance(tolerance);
    let plain = Run::by(Gauss3::new(), ScenePlant::with_slope(&scene), begin());
    let mut symplectic = plain.compensated();
    for sample in &top()[1..] {
        while run.t() < sample[0] {
            let left = sample[0] - run.t();
            run.advance_densely(left).expect("it turns");
        }
        let found = error(run.y().as_slice(), sample);
        assert!(found < 2e-11, "t = {}: {found:e}", sample[0]);
        while symplectic.t() < sample[0] - 1e-9 {
            symplectic.step(5e-4).expect("it turns");
        }
        let found = error(symplectic.y().as_slice(), sample);
        assert!(found < 2e-11, "t = {}: {found:e}", sample[0]);
    }
    let closed = run.audit().drift();
    assert!(closed.abs() < 1e-9, "{closed} J");
}

/// A satellite from rest under the torques of its arm. Its linear and angular momentum about the world's
/// origin remain zero; a wrong frame of the base's velocity would show as momentum.
#[test]
fn the_satellite_goes_as_the_reference_says() {
    let scene = SatelliteTorques::<f64>::default();
    let HybridState { t, y, modes } = Run::begin(&scene);
    let plant = ScenePlant::new(&scene);
    let run = Run::by(Dop853, plant, HybridState { t, y, modes });
    let mut run = run.with_tolerance(Tolerance {
        absolute: 1e-13,
        relative: 1e-13,
    });
    for sample in &samples(include_str!("../golden/motions/satellite_torques.json"))[1..] {
        while run.t() < sample[0] {
            let left = sample[0] - run.t();
            run.advance_densely(left).expect("it turns");
        }
        let y = run.y();
        let sign = (3..7).map(|i| y[i] * sample[1 + i]).sum::<f64>().signum();
        for (i, &wanted) in sample[1..].iter().enumerate() {
            let found = if (3..7).contains(&i) {
                sign * y[i]
            } else {
                y[i]
            };
            assert!(
                (found - wanted).abs() < 2e-11,
                "t = {}, component {i}: {found} instead of {wanted}",
                sample[0]
            );
        }
    }
}

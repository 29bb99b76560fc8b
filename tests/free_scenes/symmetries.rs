//! Symmetries of runs: the sign of a quaternion, and turns about gravity's axis.

use bgdyn::runtime::HybridSystem;
use bgdyn_sim::{
    Dop853, Gauss2, HybridState, Integrator, Rk4, Rodas4, Run, ScenePlant, SemiImplicitEuler,
    Tolerance,
};

use crate::buoy_run::BuoyRun;
use crate::heavy_top_run::HeavyTopRun;

type BuoyState = <BuoyRun as HybridSystem<f64>>::State;
type TopState = <HeavyTopRun as HybridSystem<f64>>::State;

/// The buoy after a time, from its start with the signs of these quaternions changed.
fn buoy<M: Integrator<BuoyState>>(method: M, changed: &[usize], adaptive: bool) -> BuoyState {
    let scene = BuoyRun::<f64>::default();
    let HybridState { t, mut y, modes } = Run::begin(&scene);
    for &at in changed {
        y.rows_mut(at, 4).neg_mut();
    }
    let plant = ScenePlant::with_slope(&scene);
    let mut run = Run::by(method, plant, HybridState { t, y, modes });
    if adaptive {
        run = run.with_tolerance(Tolerance {
            absolute: 1e-8,
            relative: 1e-8,
        });
    }
    for _ in 0..40 {
        run.step(0.01).expect("it floats");
    }
    let mut y = *run.y();
    for &at in changed {
        y.rows_mut(at, 4).neg_mut();
    }
    y
}

/// Asserts that q and −q give one run, bit for bit.
fn ignores_signs<M: Integrator<BuoyState> + Clone>(method: M, adaptive: bool) {
    let name = method.info().name;
    let wanted = buoy(method.clone(), &[], adaptive);
    for changed in [&[3][..], &[8], &[3, 8]] {
        let found = buoy(method.clone(), changed, adaptive);
        assert_eq!(found, wanted, "{name}: the sign of {changed:?}");
    }
}

#[test]
fn the_sign_of_a_quaternion_changes_no_bit() {
    ignores_signs(Rk4, false);
    ignores_signs(SemiImplicitEuler, false);
    ignores_signs(Dop853, true);
    ignores_signs(Rodas4, true);
    ignores_signs(Gauss2::new(), false);
}

/// Returns the product of two quaternions x, y, z, w.
fn product(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    let ([x, y, z, w], [u, v, s, t]) = (a, b);
    [
        w * u + x * t + y * s - z * v,
        w * v - x * s + y * t + z * u,
        w * s + x * v - y * u + z * t,
        w * t - x * u - y * v - z * s,
    ]
}

/// The top after 0.5 s by a method, from its start turned about gravity's axis.
fn turned_top<M: Integrator<TopState>>(method: M, angle: f64) -> TopState {
    let scene = HeavyTopRun::<f64>::default();
    let HybridState { t, mut y, modes } = Run::begin(&scene);
    let (sine, cosine) = (angle / 2.0).sin_cos();
    let turned = product([0.0, 0.0, sine, cosine], [y[0], y[1], y[2], y[3]]);
    y.as_mut_slice()[..4].copy_from_slice(&turned);
    let plant = ScenePlant::with_slope(&scene);
    let mut run = Run::by(method, plant, HybridState { t, y, modes });
    for _ in 0..500 {
        run.step(1e-3).expect("it turns");
    }
    *run.y()
}

/// All methods commute with linear maps: a start turned about gravity's axis gives the same velocities, and
/// the turned quaternion.
#[test]
fn a_turn_about_the_axis_of_gravity_turns_the_run() {
    fn check<M: Integrator<TopState> + Clone>(method: M) {
        let name = method.info().name;
        let wanted = turned_top(method.clone(), 0.0);
        for angle in [0.5, 2.0, -3.0] {
            let found = turned_top(method.clone(), angle);
            let (sine, cosine) = (f64::sin(angle / 2.0), f64::cos(angle / 2.0));
            let from = [wanted[0], wanted[1], wanted[2], wanted[3]];
            let turned = product([0.0, 0.0, sine, cosine], from);
            for i in 0..7 {
                let (wanted, size) = match i {
                    0..4 => (turned[i], 1.0),
                    _ => (wanted[i], 40.0),
                };
                let off = (found[i] - wanted).abs() / size;
                assert!(off < 1e-12, "{name}, {angle}: component {i} by {off:e}");
            }
        }
    }
    check(Rk4);
    check(SemiImplicitEuler);
    check(Gauss2::new());
    check(Rodas4);
}

//! Lengths of quaternions over many steps.

use bgdyn::runtime::HybridSystem;
use bgdyn_sim::{Gauss2, Integrator, Rk4, Run, ScenePlant, SemiImplicitEuler};

use crate::excess;
use crate::heavy_top_run::HeavyTopRun;

/// The largest | |q|² − 1 | over so many steps of 0.5 ms, in units of the rounding error.
fn largest<M>(method: M, steps: usize, compensated: bool) -> f64
where
    M: Integrator<<HeavyTopRun as HybridSystem<f64>>::State>,
{
    let scene = HeavyTopRun::<f64>::default();
    let plant = ScenePlant::with_slope(&scene);
    let mut run = Run::by(method, plant, Run::begin(&scene)).unaudited();
    if compensated {
        run = run.compensated();
    }
    let mut most = 0.0_f64;
    for _ in 0..steps {
        run.step(5e-4).expect("it turns");
        most = most.max(excess(run.y().as_slice(), 0).abs());
    }
    most / f64::EPSILON
}

fn kept(steps: usize) {
    for (name, found, allowed) in [
        ("rk4", largest(Rk4, steps, false), 4.0),
        ("rk4, compensated", largest(Rk4, steps, true), 4.0),
        (
            "semi-implicit",
            largest(SemiImplicitEuler, steps, false),
            4.0,
        ),
        // Not projected as long as it keeps the length itself.
        ("gauss2", largest(Gauss2::new(), steps / 10, false), 66.0),
        (
            "gauss2, compensated",
            largest(Gauss2::new(), steps / 10, true),
            66.0,
        ),
    ] {
        assert!(
            found <= allowed,
            "{name}: {found} roundings, {allowed} allowed"
        );
    }
}

#[test]
fn quaternions_keep_their_length() {
    kept(100_000);
}

#[test]
#[ignore = "long: part of .ci/long"]
fn quaternions_keep_their_length_in_a_million_steps() {
    kept(1_000_000);
}

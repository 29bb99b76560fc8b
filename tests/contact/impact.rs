//! Free impacts of a weight: its speed afterwards has a closed form, for any mass and stiffness.

use bgdyn::nalgebra::SVector;
use bgdyn::runtime::HybridSystem;
use bgdyn_sim::{Rk4, Run, ScenePlant};

use crate::damped::Damped;
use crate::linear::Linear;
use crate::restored::Restored;
use crate::run;

/// v − ln(1 + a v)/a, which is the same before and after an impact.
fn invariant(v: f64, a: f64) -> f64 {
    v - (a * v).ln_1p() / a
}

/// Returns the speed after an impact at the speed `v`, with the factor 1 + a δ̇ of the damping.
fn speed_after(v: f64, a: f64) -> f64 {
    let wanted = invariant(v, a);
    // The invariant falls from infinity at −1/a to 0 at rest.
    let (mut low, mut high) = (-1.0 / a, 0.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        match invariant(middle, a) > wanted {
            true => low = middle,
            false => high = middle,
        }
    }
    -high
}

/// Impacts at 0.05 to 20 m/s: the slowest loses 1.5 % of its speed, the fastest 73 %.
#[test]
fn the_speed_after_an_impact_is_that_of_the_closed_form() {
    let scene = Damped::<f64>::default();
    for (v, end) in [(0.05, 0.1), (1.0, 0.1), (5.0, 0.05), (20.0, 0.05)] {
        let mut run = run!(&scene, 1e-13, |y: &mut SVector<f64, 2>| y[1] = -v);
        run.step(end).expect("it moves");
        assert!(run.y()[0] > 0.0, "it has left the ground");
        let wanted = speed_after(v, 0.45);
        let error = run.y()[1] / wanted - 1.0;
        assert!(error.abs() < 1e-10, "{v} m/s: {} for {wanted}", run.y()[1]);
        let audit = run.audit();
        let lost = v * v - wanted * wanted;
        let error = audit.dissipated.sum() - lost;
        assert!(error.abs() < 1e-9 * lost, "{v} m/s: {error} J of {lost} J");
    }
}

/// A restitution of 0.6 at 1.5 m/s: the damping follows from them.
#[test]
fn an_impact_at_the_stated_speed_has_the_stated_restitution() {
    let scene = Restored::<f64>::default();
    let mut run = run!(&scene, 1e-13, |_: &mut SVector<f64, 2>| {});
    run.step(0.1).expect("it moves");
    assert!((run.y()[1] - 0.9).abs() < 1e-10, "{}", run.y()[1]);
}

/// Returns the errors of the speed after an impact at 1 m/s by so many fixed steps of a method of order four, which stop
/// at touch and release.
fn errors<S>(scene: &S) -> [f64; 4]
where
    S: HybridSystem<f64, State = SVector<f64, 2>>,
{
    [200, 400, 800, 1600].map(|steps| {
        let run = Run::by(Rk4, ScenePlant::new(scene), Run::begin(scene));
        let mut run = run.unaudited();
        for _ in 0..steps {
            run.step(0.08 / f64::from(steps)).expect("it moves");
        }
        assert!(run.y()[0] > 0.0, "it has left the ground");
        (run.y()[1] - speed_after(1.0, 0.45)).abs()
    })
}

/// A linear force is smooth between its events: halving the steps divides the error by 16.
#[test]
fn fixed_steps_keep_the_order_of_the_method_with_a_linear_force() {
    let errors = errors(&Linear::<f64>::default());
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!(order > 3.5, "{order}: {errors:?}");
    }
}

/// Hertz's force begins as the power 3/2 of the time, of which no method of fixed steps has its order: the error falls
/// with the power 5/2 of the step, and depends on where in a step the weight touches.
#[test]
fn fixed_steps_have_order_five_halves_with_hertz() {
    let errors = errors(&Damped::<f64>::default());
    for (k, error) in errors.into_iter().enumerate() {
        let step = 1.0 / (200.0 * f64::from(1_u32 << k));
        let factor = error / step.powf(2.5);
        assert!(factor < 3.0, "{factor}: {errors:?}");
    }
}

//! Bodies in a plane: a disc on an incline, a block that rocks, a rod that jams.

use bgdyn::nalgebra::SVector;

use crate::jams::Jams;
use crate::rocks::Rocks;
use crate::rolls::Rolls;
use crate::slips::Slips;
use crate::{G, advance, start};

pub type Y = SVector<f64, 6>;

/// Speed along the incline of the slope 3/4, downhill.
pub fn downhill(y: &Y) -> f64 {
    let (sin, cos) = y[2].sin_cos();
    let (x, z) = (cos * y[3] - sin * y[4], sin * y[3] + cos * y[4]);
    -(4.0 * x + 3.0 * z) / 5.0
}

/// A disc rolls with (2/3) g sin α for tan α ≤ 3 μ, else it slips with g (sin α − μ cos α): constant accelerations, exact in
/// steps of any length.
#[test]
fn a_disc_rolls_or_slips_down_an_incline() {
    let (sin, cos) = (0.6, 0.8);
    let scene = Rolls::<f64>::default();
    for steps in [100, 1001, 4000] {
        let mut run = start!(&scene, |_: &mut Y| {});
        advance(&mut run, 2.0, steps);
        let speed = downhill(run.y());
        let (slip, error) = (speed - 0.2 * run.y()[5], speed - 2.0 / 3.0 * G * sin * 2.0);
        assert!(
            slip.abs() < 1e-11 && error.abs() < 1e-11,
            "{slip:e}, {error:e}"
        );
    }
    let scene = Slips::<f64>::default();
    let wanted = [G * (sin - 0.1 * cos) * 2.0, 2.0 * 0.1 * G * cos / 0.2 * 2.0];
    for steps in [100, 1001, 4000] {
        let mut run = start!(&scene, |_: &mut Y| {});
        for _ in 0..steps {
            run.step(2.0 / f64::from(steps)).expect("a step");
            assert!(run.contact_step().expect("a step").impulses[0][2] > 0.0);
        }
        let found = [downhill(run.y()), run.y()[5]];
        for (found, wanted) in found.into_iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-11, "{found}, {wanted}");
        }
    }
}

/// The angle and the distance of a corner of the rocking block from its centre, and p² = 3 g/(4 R).
pub fn rocker() -> (f64, f64, f64) {
    let (half_width, half_height) = (0.1_f64, 0.4);
    let size = half_width.hypot(half_height);
    (half_width.atan2(half_height), size, 3.0 * G / (4.0 * size))
}

/// Returns the time from rest at a tilt to the upright position: ∫ dθ/√(2 p² (cos(α − θ₀) − cos(α − θ))), with θ = θ₀ (1 − s²).
pub fn quarter(tilt: f64) -> f64 {
    let (alpha, _, square) = rocker();
    let rate = |s: f64| {
        let theta = tilt * (1.0 - s * s);
        let fallen = (alpha - tilt).cos() - (alpha - theta).cos();
        2.0 * tilt * s / (2.0 * square * fallen).sqrt()
    };
    let pieces = 4000;
    let width = 1.0 / f64::from(pieces);
    let node = 0.5 / 3.0_f64.sqrt();
    let piece = |k: i32| {
        let middle = (f64::from(k) + 0.5) * width;
        0.5 * width * (rate(middle - node * width) + rate(middle + node * width))
    };
    (0..pieces).map(piece).sum()
}

/// A block that rocks loses the share of Housner at each impact, θ̇⁺ = (1 − (3/2) sin² α) θ̇⁻, and swings as the full
/// equation θ̈ = −p² sin(α − θ) says.
#[test]
fn a_block_rocks_as_housner_says() {
    let scene = Rocks::<f64>::default();
    let (alpha, size, square) = rocker();
    let tilt = 0.2;
    let reached = (2.0 * square * ((alpha - tilt).cos() - alpha.cos())).sqrt();
    let after = (1.0 - 1.5 * alpha.sin().powi(2)) * reached;
    let other = alpha - (alpha.cos() + after * after / (2.0 * square)).acos();
    let time = quarter(tilt) + quarter(other);
    let error = |steps: usize| {
        let mut run = start!(&scene, |y: &mut Y| {
            // On the right corner, turned about it by the tilt.
            y[0] = 0.1 - size * (alpha - tilt).sin();
            y[1] = size * (alpha - tilt).cos();
            y[2] = -tilt;
        });
        advance(&mut run, time, steps);
        let y = run.y();
        assert!(y[5].abs() < 0.05, "it rests for an instant: {}", y[5]);
        (y[2] - other).abs()
    };
    let worst = |steps: usize| (0..8).map(|k| error(steps + k)).fold(0.0, f64::max);
    let (coarse, fine) = (worst(500), worst(8000));
    assert!(fine < 5e-4, "{coarse:e}, {fine:e}");
    assert!(coarse / fine > 8.0, "{coarse:e}, {fine:e}");
}

/// A rod that slides on its end with μ > 4/3 comes to states in which no force is possible (Painlevé): the steps go on with
/// an impulse, and energy never grows.
#[test]
fn a_rod_jams_without_gaining_energy() {
    let scene = Jams::<f64>::default();
    for (angle, speed) in [(1.0_f64, -3.0), (1.0, 3.0), (1.2, -5.0), (0.9, 2.0)] {
        let mut run = start!(&scene, |y: &mut Y| {
            y[1] = 0.5 * angle.sin();
            y[2] = angle;
            let (sin, cos) = angle.sin_cos();
            (y[3], y[4]) = (cos * speed, -sin * speed);
        });
        let energy = |y: &Y| 0.5 * (y[3] * y[3] + y[4] * y[4] + y[5] * y[5] / 12.0) + G * y[1];
        let mut before = energy(run.y());
        for _ in 0..3000 {
            run.step(1e-3).expect("it goes on");
            let now = energy(run.y());
            assert!(now < before + 1e-3, "at {} s: {before} J, {now} J", run.t());
            before = now;
            assert!(run.contact_step().expect("a step").solved, "{}", run.t());
        }
        let y = run.y();
        assert!(y.as_slice()[3..].iter().all(|v| v.abs() < 1e-9), "{y}");
        assert!(y[1].abs() < 1e-9, "it lies: {y}");
    }
}

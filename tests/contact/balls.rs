//! Balls: one that slides on the ground until it rolls, two that collide.

use bgdyn::nalgebra::{SMatrix, SVector, Vector3};
use bgdyn_sim::{Run, ScenePlant};

use crate::bowling::Bowling;
use crate::collision::Collision;
use crate::frictionless::Frictionless;
use crate::run;

/// Whatever friction is, v + (2/5) r ω is conserved along the ground: the ball rolls in the end at 5/7 of its speed.
#[test]
fn a_ball_that_slides_rolls_at_five_sevenths_of_its_speed() {
    let scene = Bowling::<f64>::default();
    let mut run = run!(&scene, 1e-11, |_: &mut SVector<f64, 13>| {});
    let speeds = |y: &[f64]| {
        // Velocities are in link axes: those along the ground, turned about y.
        let r = bgdyn::runtime::manifold::rotation([y[3], y[4], y[5], y[6]]);
        (
            r * Vector3::new(y[7], y[8], y[9]),
            r * Vector3::new(y[10], y[11], y[12]),
        )
    };
    let mut rolls = None;
    for k in 1..=40 {
        run.step(0.02).expect("it moves");
        let (v, w) = speeds(run.y().as_slice());
        let kept = v.x + 0.4 * 0.1 * w.y - 2.0;
        assert!(kept.abs() < 1e-9, "{kept} at {} s", run.t());
        assert!(v.y.abs() < 1e-12 && w.x.abs() < 1e-12 && w.z.abs() < 1e-12);
        if rolls.is_none() && (v.x - 0.1 * w.y).abs() < 5e-3 {
            rolls = Some(0.02 * f64::from(k));
        }
    }
    let (v, _) = speeds(run.y().as_slice());
    assert!((v.x - 10.0 / 7.0).abs() < 1e-9, "{}", v.x);
    // 2 v₀/(7 μ g) with Coulomb's law; the smooth law takes a little longer, and the first impact changes the force.
    let rolls = rolls.expect("it rolls");
    assert!((rolls - 0.1942_f64).abs() < 0.03, "{rolls} s");
}

/// Momentum, moment of momentum about the origin, and kinetic energy of two balls.
fn sums(y: &[f64]) -> (Vector3<f64>, Vector3<f64>, f64) {
    let mut sums = (Vector3::zeros(), Vector3::zeros(), 0.0);
    for (k, mass, radius) in [(0, 1.3, 0.1), (1, 0.7, 0.07)] {
        let (q, v) = (&y[7 * k..7 * k + 7], &y[14 + 6 * k..20 + 6 * k]);
        let r = bgdyn::runtime::manifold::rotation([q[3], q[4], q[5], q[6]]);
        let r: SMatrix<f64, 3, 3> = r;
        let place = Vector3::new(q[0], q[1], q[2]);
        let p = r * Vector3::new(v[0], v[1], v[2]) * mass;
        let inertia = 0.4 * mass * radius * radius;
        let spin = r * Vector3::new(v[3], v[4], v[5]) * inertia;
        sums.0 += p;
        sums.1 += spin + place.cross(&p);
        sums.2 += 0.5 * (p.norm_squared() / mass + spin.norm_squared() / inertia);
    }
    sums
}

/// Spinning balls that collide off centre, with friction: the contact passes no momentum and no moment from outside,
/// and what is lost is what the contact dissipates.
#[test]
fn two_balls_keep_their_momenta() {
    let scene = Collision::<f64>::default();
    let mut run = run!(&scene, 1e-12, |_: &mut SVector<f64, 26>| {});
    let (p, l, energy) = sums(run.y().as_slice());
    run.step(0.3).expect("they move");
    let (after, moment, left) = sums(run.y().as_slice());
    assert!((after - p).norm() < 1e-11, "{}", (after - p).norm());
    assert!((moment - l).norm() < 1e-11, "{}", (moment - l).norm());
    let lost = run.audit().dissipated.sum();
    assert!(lost > 0.1, "{lost} J");
    assert!(
        (energy - left - lost).abs() < 1e-9,
        "{energy} {left} {lost}"
    );
}

/// A head-on impact without friction: the approach and its reversal have the closed form of a single mass, and spin
/// stays.
#[test]
fn a_central_impact_has_the_closed_form() {
    let scene = Frictionless::<f64>::default();
    let mut run = run!(&scene, 1e-13, |_: &mut SVector<f64, 26>| {});
    run.step(0.1).expect("they move");
    let y = run.y().as_slice();
    let r = |k: usize| {
        bgdyn::runtime::manifold::rotation([y[7 * k + 3], y[7 * k + 4], y[7 * k + 5], y[7 * k + 6]])
    };
    let v = |k: usize| r(k) * Vector3::new(y[14 + 6 * k], y[15 + 6 * k], y[16 + 6 * k]);
    let parting = v(1).x - v(0).x;
    let invariant = |v: f64| v - (0.3 * v).ln_1p() / 0.3;
    let error = invariant(-parting) - invariant(2.0);
    assert!(parting > 0.5 && error.abs() < 1e-10, "{parting}: {error}");
    assert!((y[18] - 5.0).abs() < 1e-12, "its spin is {}", y[18]);
}

/// The same collision in single precision.
#[test]
fn single_precision_is_as_near_as_its_digits() {
    let wide = Collision::<f64>::default();
    let mut wide = run!(&wide, 1e-10, |_: &mut SVector<f64, 26>| {});
    let narrow = Collision::<f32>::default();
    let mut run = Run::by(
        bgdyn_sim::Rk4,
        ScenePlant::new(&narrow),
        Run::begin(&narrow),
    );
    wide.step(0.3).expect("they move");
    for _ in 0..3000 {
        run.step(1e-4_f32).expect("they move");
    }
    let pairs = wide.y().iter().zip(run.y().iter());
    let worst = pairs
        .map(|(a, b)| (a - f64::from(*b)).abs())
        .fold(0.0, f64::max);
    assert!(worst < 2e-3, "{worst}");
}

//! Balls that bounce and collide.

use bgdyn::nalgebra::{Quaternion, SVector, UnitQuaternion, Vector3};

use crate::bounces::Bounces;
use crate::collides::Collides;
use crate::{G, advance, start};

const RADIUS: f64 = 0.11;

/// Impacts are at √(2H/g) (1 + 2e + 2e² + …); the error of the height falls with the step.
#[test]
fn a_ball_bounces_with_order_one() {
    let scene = Bounces::<f64>::default();
    let (height, e) = (0.5, 0.8);
    let first = (2.0_f64 * height / G).sqrt();
    let speed = G * first;
    // In the middle of the third flight after the first impact.
    let time = first + 2.0 * speed / G * (e + e * e + 0.5 * e * e * e);
    let exact = (e * e * e * speed).powi(2) / (2.0 * G);
    let error = |steps: usize| {
        let mut run = start!(&scene, |_: &mut SVector<f64, 13>| {});
        advance(&mut run, time, steps);
        (run.y()[2] - RADIUS - exact).abs()
    };
    // The error jumps with the places of the impacts in their steps: compare the largest of several.
    let worst = |steps: usize| (0..16).map(|k| error(steps + k)).fold(0.0, f64::max);
    let (coarse, fine) = (worst(500), worst(8000));
    let ratio = coarse / fine;
    assert!((8.0..32.0).contains(&ratio), "{coarse:e}, {fine:e}");
    assert!(fine < 2e-3, "{fine:e}");
}

/// All impacts are over at √(2H/g) (1 + e)/(1 − e); what was lost is in the account.
#[test]
fn a_ball_comes_to_rest() {
    let scene = Bounces::<f64>::default();
    let over = (2.0_f64 * 0.5 / G).sqrt() * (1.0 + 0.8) / (1.0 - 0.8);
    let mut run = start!(&scene, |_: &mut SVector<f64, 13>| {});
    advance(&mut run, 0.97 * over, 4000);
    assert!(run.y().as_slice()[7..].iter().any(|v| v.abs() > 1e-3));
    advance(&mut run, 0.06 * over, 250);
    let y = *run.y();
    assert!(y.as_slice()[7..].iter().all(|v| v.abs() < 1e-12), "{y}");
    assert!((y[2] - RADIUS).abs() < 1e-12, "{}", y[2] - RADIUS);
    let audit = run.audit();
    let lost = audit.dissipated.iter().sum::<f64>();
    assert!((lost - 0.65 * G * 0.5).abs() < 1e-3 * lost, "{audit:?}");
    assert!(audit.drift().abs() < 1e-5 * lost, "{}", audit.drift());
}

/// Runs in lanes have explicit methods only: a scene with rigid contacts ends at once, and does not fall through the ground.
#[test]
fn lanes_end_where_contacts_are_rigid() {
    let scene = Bounces::<f64>::default();
    let ode = bgdyn_sim::lanes::SmoothScene::new(&scene);
    let mut run = bgdyn_sim::lanes::LaneRun::new(bgdyn::runtime::HybridSystem::start(&scene).0);
    run.step(&bgdyn_sim::Rk4, &ode, 1e-3);
    assert_eq!(run.ended(0), Some(0.0));
}

/// Two equal balls: the normal impulse is m (1 + e) v_n/2, the tangential one the lesser of μ times that and m v_t/7.
#[test]
fn balls_collide_off_centre_with_spin() {
    let mut scene = Collides::<f64>::default();
    for (friction, sticks) in COLLISIONS {
        scene.friction = friction;
        let mut run = start!(&scene, spin_first);
        advance(&mut run, 0.06, 60_000);
        assert_collided(run.y(), (friction, sticks), 3e-4);
    }
}

/// Coefficients of friction, and whether the balls stick with them.
pub const COLLISIONS: [(f64, bool); 2] = [(0.05, false), (0.6, true)];

/// Gives the first ball a spin, rad/s.
pub fn spin_first(y: &mut SVector<f64, 26>) {
    y.as_mut_slice()[17..20].copy_from_slice(&[11.0, -4.0, 6.0]);
}

/// Asserts that the velocities after the collision, along axes of the world, are exact up to `bar`.
pub fn assert_collided(y: &SVector<f64, 26>, (friction, sticks): (f64, bool), bar: f64) {
    // Centres at the impact: the first moves along x until the distance is 60 mm.
    let offset = Vector3::new(
        -(0.06_f64.powi(2) - 0.02_f64.powi(2) - 0.015_f64.powi(2)).sqrt(),
        0.02,
        0.015,
    );
    let normal = offset.normalize();
    let (v, w) = (Vector3::new(2.0, 0.0, 0.0), Vector3::new(11.0, -4.0, 6.0));
    let slip = v + w.cross(&(-0.03 * normal));
    let along = slip - normal * slip.dot(&normal);
    let (mass, e) = (0.2, 0.9);
    let pressed = -mass * (1.0 + e) * v.dot(&normal) / 2.0;
    let stuck = mass * along.norm() / 7.0;
    assert_eq!(stuck < friction * pressed, sticks);
    let rubbed = along.normalize() * -stuck.min(friction * pressed);
    let impulse = normal * pressed + rubbed;
    // Orientations turn with the spin: compare velocities in world axes.
    let turned = |q: usize, at: usize| {
        let [x, i, j, k] = [y[q + 3], y[q], y[q + 1], y[q + 2]];
        let turn = UnitQuaternion::from_quaternion(Quaternion::new(x, i, j, k));
        turn * Vector3::new(y[at], y[at + 1], y[at + 2])
    };
    let close = |found: Vector3<f64>, wanted: Vector3<f64>| {
        assert!(
            (found - wanted).norm() < bar,
            "{friction}: {found} for {wanted}"
        );
    };
    let (first, second) = (turned(3, 14), turned(10, 20));
    close(first, v + impulse / mass);
    close(second, -impulse / mass);
    let inertia = 0.4 * mass * 0.03 * 0.03;
    let spun = -0.03 * normal.cross(&impulse) / inertia;
    close(turned(3, 17), w + spun);
    close(turned(10, 23), spun);
    // Momentum to rounding, whatever the step.
    let momentum = mass * (first + second);
    assert!((momentum - mass * v).norm() < 1e-11, "{momentum}");
}

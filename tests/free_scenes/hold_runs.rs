//! Runs of controllers that hold a pose: convergence from half a turn away, balances of energy, equilibria and
//! small oscillations in closed form.

use bgdyn::runtime::HybridSystem;
use bgdyn::runtime::manifold::spherical;
use bgdyn_sim::{Dop853, HybridState, Rk4, Run, ScenePlant, Tolerance};

use crate::heavy_top_hold::HeavyTopHold;
use crate::holds::{PROBE_TARGET, dd, potential, spring};
use crate::platform_hold::PlatformHold;
use crate::probe_hold::ProbeHold;
use crate::probe_swing::ProbeSwing;

/// From within 1e-3 rad of half a turn, about each axis and about others, the probe comes to its target.
#[test]
fn a_probe_turns_to_its_target_from_half_a_turn_away() {
    let scene = ProbeHold::<f64>::default();
    let (start, modes) = scene.start();
    let axes = [
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.6, 0.48, -0.64],
    ];
    for axis in axes {
        let mut y = start;
        let angle = std::f64::consts::PI - 1e-3;
        let turned = spherical::integrate(PROBE_TARGET, axis.map(|n: f64| n * angle));
        y.as_mut_slice()[3..7].copy_from_slice(&turned);
        let from = HybridState { t: 0.0, y, modes };
        let mut run = Run::by(Rk4, ScenePlant::new(&scene), from);
        for _ in 0..8000 {
            run.step(0.01).expect("it moves");
        }
        let y = run.y();
        let q = [y[3], y[4], y[5], y[6]];
        let left = spherical::difference(q, PROBE_TARGET);
        let place = [y[0] - 0.5, y[1] + 0.2, y[2] - 0.1];
        let still = y.as_slice()[7..].iter();
        let most = left
            .iter()
            .chain(&place)
            .chain(still)
            .fold(0.0, |a: f64, x| a.max(x.abs()));
        assert!(most < 1e-12, "{axis:?}: {most:e}");
        // It begins and ends at rest: the drives have taken up what they supplied, up to 2 k = 4 to 8 J.
        let closed = run.audit().drift().abs();
        assert!(closed < 1e-6, "{axis:?}: {closed:e} J");
    }
}

/// Without damping the kinetic energy and the potential of the hold add up to a constant.
#[test]
fn a_swing_keeps_its_energy() {
    let scene = ProbeSwing::<f64>::default();
    let energy = |y: &[f64]| {
        let (linear, angular) = (&y[7..10], &y[10..13]);
        let kinetic: f64 = linear.iter().map(|v| 1.5 * v * v).sum::<f64>()
            + angular
                .iter()
                .zip([0.1, 0.15, 0.2])
                .map(|(w, j)| j * w * w)
                .sum::<f64>();
        let q: [f64; 4] = std::array::from_fn(|i| y[3 + i]);
        let half = 0.5_f64.sqrt();
        let turned = potential(dd(q), dd([0.0, 0.0, half, half]), [2.0, 3.0, 4.0]).to_f64();
        let place = spring(dd([y[0], y[1], y[2]]), [0.0; 3], [30.0, 40.0, 50.0]).to_f64();
        kinetic + turned + place
    };
    let run = Run::by(Dop853, ScenePlant::new(&scene), Run::begin(&scene));
    let mut run = run.with_tolerance(Tolerance {
        absolute: 1e-13,
        relative: 1e-13,
    });
    let first = energy(run.y().as_slice());
    let (mut most, mut turned) = (0.0_f64, 0.0_f64);
    while run.t() < 20.0 {
        run.advance_densely(20.0 - run.t()).expect("it swings");
        most = most.max((energy(run.y().as_slice()) - first).abs());
        turned = turned.max(run.y()[10].abs());
    }
    assert!(turned > 1.0, "{turned} rad/s");
    assert!(most < 2e-11 * first, "{most:e} of {first} J");
    let audit = run.audit();
    assert!(audit.drift().abs() < 2e-11 * first, "{:e}", audit.drift());
}

/// Small oscillations about the target have the frequencies √(k/J) and √(k/m): after ten periods and a quarter
/// the deviation passes zero.
#[test]
fn small_oscillations_have_the_frequencies_of_their_stiffness() {
    let scene = ProbeSwing::<f64>::default();
    let (start, modes) = scene.start();
    let half = 0.5_f64.sqrt();
    let target = [0.0, 0.0, half, half];
    let inertias = [3.0, 3.0, 3.0, 0.2, 0.3, 0.4];
    let stiffnesses = [30.0, 40.0, 50.0, 2.0, 3.0, 4.0];
    for axis in 0..6 {
        let mut y = start;
        y.fill(0.0);
        y.as_mut_slice()[3..7].copy_from_slice(&target);
        let small = 1e-5;
        match axis {
            0..3 => y[axis] = small,
            _ => {
                let mut turn = [0.0; 3];
                turn[axis - 3] = small;
                y.as_mut_slice()[3..7].copy_from_slice(&spherical::integrate(target, turn));
            }
        }
        let frequency = f64::sqrt(stiffnesses[axis] / inertias[axis]);
        let time = 10.25 * std::f64::consts::TAU / frequency;
        let steps = 8000;
        let from = HybridState { t: 0.0, y, modes };
        let mut run = Run::by(Rk4, ScenePlant::new(&scene), from);
        (0..steps).for_each(|_| {
            run.step(time / f64::from(steps)).expect("it swings");
        });
        let y = run.y();
        let left = match axis {
            0..3 => y[axis],
            _ => spherical::difference([y[3], y[4], y[5], y[6]], target)[axis - 3],
        };
        // The phase is off by 10.25 turns of the error of the frequency.
        let error = (left / small).abs() / (10.25 * std::f64::consts::TAU);
        assert!(
            error < 1e-8,
            "axis {axis}: the frequency is off by {error:e}"
        );
    }
}

/// A heavy top held horizontally sinks by atan(m g l/k).
#[test]
fn a_heavy_top_sinks_until_the_moments_balance() {
    let scene = HeavyTopHold::<f64>::default();
    let mut run = Run::by(Rk4, ScenePlant::new(&scene), Run::begin(&scene));
    for _ in 0..6000 {
        run.step(5e-3).expect("it sinks");
    }
    let y = run.y();
    let sunk = spherical::difference([y[0], y[1], y[2], y[3]], [0.0, 0.0, 0.0, 1.0]);
    let wanted = -(15.0 * 9.81 / 300.0_f64).atan();
    assert!(
        (sunk[0] - wanted).abs() < 1e-12,
        "{} rad, not {wanted}",
        sunk[0]
    );
    assert!(sunk[1].abs() < 1e-14 && sunk[2].abs() < 1e-14, "{sunk:?}");
}

/// A platform follows the ramp of its target without an error once it is there.
#[test]
fn a_platform_follows_its_target() {
    let scene = PlatformHold::<f64>::default();
    let mut run = Run::by(Rk4, ScenePlant::new(&scene), Run::begin(&scene));
    for _ in 0..6000 {
        run.step(1e-2).expect("it moves");
    }
    let (y, t) = (run.y(), run.t());
    let off = [
        y[0] - 1.0,
        y[1] - 0.3 * t,
        y[2] - std::f64::consts::FRAC_PI_2,
    ];
    assert!(off.iter().all(|x| x.abs() < 1e-9), "{off:?}");
}

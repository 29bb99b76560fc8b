//! A block on an incline, and a ball that slides until it rolls.

use bgdyn::nalgebra::{SVector, Vector3};

use crate::across::Across;
use crate::bowls::Bowls;
use crate::sticks::Sticks;
use crate::{G, advance, start};

/// Velocity downhill and across an incline of the slope 1/3, and away from it.
fn downhill(v: &[f64]) -> [f64; 3] {
    let size = 10.0_f64.sqrt();
    [
        -(3.0 * v[0] + v[2]) / size,
        v[1],
        (3.0 * v[2] - v[0]) / size,
    ]
}

/// With the angle φ between velocity and downhill direction, s sin φ/tan(φ/2)^k is constant for k = μ/tan α: the cone is
/// round, a pyramid has other paths.
#[test]
fn a_block_curves_across_an_incline() {
    let scene = Across::<f64>::default();
    let k = 0.2 * 3.0;
    let error = |steps| {
        let mut run = start!(&scene, |_: &mut SVector<f64, 6>| {});
        advance(&mut run, 1.5, steps);
        let [down, side, away] = downhill(&run.y().as_slice()[3..]);
        assert!(away.abs() < 1e-14, "{away}");
        let (speed, angle) = (down.hypot(side), side.atan2(down));
        assert!(angle < 0.6, "it curves: {angle}");
        let constant = speed * angle.sin() / (0.5 * angle).tan().powf(k);
        (constant / 2.0 - 1.0).abs()
    };
    let (coarse, fine) = (error(150), error(600));
    let order = (coarse / fine).log2() / 2.0;
    assert!(fine < 5e-4, "{coarse:e}, {fine:e}");
    assert!(order > 0.9, "order {order}: {coarse:e}, {fine:e}");
}

/// It stops after v₀²/(2 g (μ cos α + sin α)), and then does not move at all.
#[test]
fn a_block_stops_and_sticks_on_an_incline() {
    let scene = Sticks::<f64>::default();
    let size = 10.0_f64.sqrt();
    let way = size * size / (2.0 * G * (0.5 * 3.0 + 1.0) / size);
    let stopped = |steps| {
        let mut run = start!(&scene, |_: &mut SVector<f64, 6>| {});
        advance(&mut run, 1.0, steps);
        let [down, side, _] = downhill(&run.y().as_slice()[..3]);
        assert!(side == 0.0);
        ((-down - way).abs(), run)
    };
    let (error, mut run) = stopped(4000);
    assert!(error < 2e-6, "{error:e}");
    let before = *run.y();
    advance(&mut run, 20.0, 20_000);
    let moved = (run.y() - before).norm();
    assert!(moved < 1e-13, "{moved:e}");
    // What it lost is friction's share of the energy it had.
    let audit = run.audit();
    assert!(audit.drift().abs() < 1e-9, "{audit:?}");
}

/// A ball with any spin ends with the velocity (5 v₀ + 2 R ω₀ × n)/7 and rolls; the spin about the normal stays.
#[test]
fn a_ball_slides_on_a_parabola_until_it_rolls() {
    let scene = Bowls::<f64>::default();
    let radius = 0.11;
    let (v, w) = (Vector3::new(3.0, 0.0, 0.0), Vector3::new(9.0, -20.0, 7.0));
    let ends = (5.0 * v + 2.0 * radius * w.cross(&Vector3::<f64>::z())) / 7.0;
    let slip = v - radius * w.cross(&Vector3::<f64>::z());
    let time = 2.0 * slip.norm() / (7.0 * 0.12 * G);
    // While it slides friction keeps its direction.
    let force = slip.normalize() * (-0.12 * G);
    let place = v * time + 0.5 * force * time * time + ends * 0.5 * time;
    let error = |steps: usize| {
        let mut run = start!(&scene, |_: &mut SVector<f64, 13>| {});
        advance(&mut run, 1.5 * time, steps);
        let y = run.y();
        let turn = bgdyn::nalgebra::UnitQuaternion::from_quaternion(
            bgdyn::nalgebra::Quaternion::new(y[6], y[3], y[4], y[5]),
        );
        let velocity = turn * Vector3::new(y[7], y[8], y[9]);
        let spin = turn * Vector3::new(y[10], y[11], y[12]);
        let rolls = velocity - radius * spin.cross(&Vector3::<f64>::z());
        assert!(rolls.norm() < 1e-12, "{rolls}");
        let (velocity, spin) = (velocity - ends, spin.z - 7.0);
        assert!(
            velocity.norm() < 1e-12 && spin.abs() < 1e-12,
            "{velocity}, {spin:e}"
        );
        (Vector3::new(y[0], y[1], 0.0) - place).norm()
    };
    // It begins to roll somewhere in a step.
    let (coarse, fine) = (error(1000), error(4000));
    let order = (coarse / fine).log2() / 2.0;
    assert!(fine < 1e-7 && order > 1.9, "{coarse:e}, {fine:e}");
}

//! Positions of joints with quasi-velocities, in `f64` against double-double: changes have the digits of
//! the change, and projections in two words keep the orientation of both.

use bgdyn_runtime::manifold::floating;
use bgdyn_runtime::{Dd, QuasiJoint, QuasiJointKind};
use bgdyn_sim::quasi_joints::{normalize_in_two, position_change};

/// A planar joint, a plain one, a spherical and a floating one: 15 positions, 13 velocities.
const JOINTS: [QuasiJoint; 3] = [
    QuasiJoint {
        kind: QuasiJointKind::Planar,
        position: 0,
        velocity: 15,
    },
    QuasiJoint {
        kind: QuasiJointKind::Spherical,
        position: 4,
        velocity: 19,
    },
    QuasiJoint {
        kind: QuasiJointKind::Floating,
        position: 8,
        velocity: 22,
    },
];
const POSITIONS: usize = 15;

/// Numbers in −1 … 1.
fn number(seed: u32, k: usize) -> f64 {
    let x = (f64::from(seed) * 0.754_877_666 + (k as f64 + 1.0) * 0.569_840_290_998).fract();
    2.0 * x - 1.0
}

/// A state a kilometre from the origin.
fn state(seed: u32) -> Vec<f64> {
    let mut y: Vec<f64> = (0..28).map(|k| 3.0 * number(seed, k)).collect();
    for k in [0, 1, 8, 9, 10] {
        y[k] *= 1000.0;
    }
    for at in [4, 11] {
        let length = y[at..at + 4].iter().map(|x| x * x).sum::<f64>().sqrt();
        y[at..at + 4].iter_mut().for_each(|x| *x /= length);
    }
    y
}

fn exact(x: &[f64]) -> Vec<Dd> {
    x.iter().map(|&x| Dd::from_f64(x)).collect()
}

#[test]
fn a_change_has_its_own_digits() {
    for seed in 0..50 {
        let y = state(seed);
        for h in [1e-2, 1e-5, 1e-9] {
            let mut change = vec![0.0; POSITIONS];
            position_change(&JOINTS, POSITIONS, &y, h, &mut change);
            let mut reference = vec![Dd::ZERO; POSITIONS];
            let h = Dd::from_f64(h);
            position_change(&JOINTS, POSITIONS, &exact(&y), h, &mut reference);
            for parts in [0..2, 2..3, 3..4, 4..8, 8..11, 11..15] {
                let size = parts
                    .clone()
                    .map(|k| reference[k].to_f64().abs())
                    .fold(0.0, f64::max);
                for k in parts {
                    let off = (Dd::from_f64(change[k]) - reference[k]).to_f64().abs();
                    assert!(
                        off <= 8.0 * f64::EPSILON * size,
                        "seed {seed}, {k}: {off:e} of {size:e}"
                    );
                }
            }
            // In double-double it is the difference of the positions.
            let q: [Dd; 7] = std::array::from_fn(|k| Dd::from_f64(y[8 + k]));
            let d: [Dd; 6] = std::array::from_fn(|k| Dd::from_f64(y[22 + k]) * h);
            let to = floating::integrate(floating::normalize(q), d);
            for (k, (to, from)) in to.into_iter().zip(floating::normalize(q)).enumerate() {
                let off = (to - from - reference[8 + k]).to_f64().abs();
                assert!(off < 1e-14 * h.to_f64(), "seed {seed}, {k}: {off:e}");
            }
        }
    }
}

#[test]
fn projection_in_two_words_keeps_the_orientation_of_both() {
    for seed in 0..50 {
        let mut y = state(seed);
        let mut low: Vec<f64> = (0..y.len())
            .map(|k| 1e-17 * number(seed + 100, k))
            .collect();
        for at in [4, 11] {
            let scale = 1.0 + 1e-9 * number(seed + 200, at);
            y[at..at + 4].iter_mut().for_each(|x| *x *= scale);
        }
        let whole = |y: &[f64], low: &[f64], at: usize| -> [Dd; 4] {
            std::array::from_fn(|k| Dd::from_f64(y[at + k]) + Dd::from_f64(low[at + k]))
        };
        let before = [4, 11].map(|at| whole(&y, &low, at));
        assert!(normalize_in_two(&JOINTS, &mut y, &mut low));
        for (at, before) in [4, 11].into_iter().zip(before) {
            let after = whole(&y, &low, at);
            let dot = |a: &[Dd; 4], b: &[Dd; 4]| {
                a.iter().zip(b).fold(Dd::ZERO, |sum, (&a, &b)| sum + a * b)
            };
            let length = dot(&after, &after).sqrt();
            assert!(
                (length - Dd::ONE).to_f64().abs() < 4.0 * f64::EPSILON,
                "seed {seed}"
            );
            let scale = dot(&before, &before).sqrt();
            for (a, b) in after.into_iter().zip(before) {
                let off = (a / length - b / scale).to_f64().abs();
                assert!(
                    off < 1e-24,
                    "seed {seed}: the orientation is off by {off:e}"
                );
            }
        }
    }
}

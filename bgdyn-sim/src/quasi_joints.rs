//! Positions of joints with quasi-velocities: rates, exact motion at constant velocity, projection.
//!
//! Quaternions are components of the state with the rates ½ q∘ω, tangent to the unit sphere. A step leaves
//! the sphere by its error, and the projection scales the quaternion. It never changes the sign: along a run
//! a quaternion is continuous.

use bgdyn_runtime::manifold::{floating, planar, spherical};
use bgdyn_runtime::{QuasiJoint, QuasiJointKind, Scalar};

use crate::real::Real;
use crate::two_sum::sum_in_two;

/// Largest deviation of |q|² from 1, in units of the rounding error, that integrators which conserve |q|²
/// leave.
const STRAYED: f64 = 64.0;

/// Components of the state: `N` numbers from an index.
pub(crate) fn part<T: Scalar, const N: usize>(y: &[T], from: usize) -> [T; N] {
    core::array::from_fn(|i| y.get(from + i).copied().unwrap_or(T::from_f64(0.0)))
}

/// Writes components of a vector from an index.
pub(crate) fn set<T: Scalar, const N: usize>(to: &mut [T], from: usize, values: [T; N]) {
    for (to, value) in to.iter_mut().skip(from).zip(values) {
        *to = value;
    }
}

/// Calls a function with each position outside of these joints and the index of its velocity.
fn each_plain(joints: &[QuasiJoint], positions: usize, mut with: impl FnMut(usize, usize)) {
    let (mut position, mut velocity) = (0, positions);
    for joint in joints {
        while position < joint.position {
            with(position, velocity);
            (position, velocity) = (position + 1, velocity + 1);
        }
        position += joint.positions();
        velocity += joint.velocities();
    }
    while position < positions {
        with(position, velocity);
        (position, velocity) = (position + 1, velocity + 1);
    }
}

/// Writes the rates of the first `positions` components of the state `y` into `rates`: q̇ = N(q) v.
pub fn position_rates<T: Scalar>(
    joints: &[QuasiJoint],
    positions: usize,
    y: &[T],
    rates: &mut [T],
) {
    each_plain(joints, positions, |q, v| set(rates, q, part::<T, 1>(y, v)));
    for joint in joints {
        let (q, v) = (joint.position, joint.velocity);
        match joint.kind {
            QuasiJointKind::Planar => {
                set(rates, q, planar::position_rates(part(y, q), part(y, v)));
            }
            QuasiJointKind::Spherical => {
                set(rates, q, spherical::position_rates(part(y, q), part(y, v)));
            }
            QuasiJointKind::Floating => {
                set(rates, q, floating::position_rates(part(y, q), part(y, v)));
            }
        }
    }
}

/// Writes the change of the first `positions` components of the state `y` in the time `h` at the velocities
/// of `y`, constant in link axes, to the last digits of the change: compensated sums keep them.
pub fn position_change<T: Scalar>(
    joints: &[QuasiJoint],
    positions: usize,
    y: &[T],
    h: T,
    change: &mut [T],
) {
    each_plain(joints, positions, |q, v| {
        let [rate] = part(y, v);
        set(change, q, [h * rate]);
    });
    for joint in joints {
        let (q, v) = (joint.position, joint.velocity);
        match joint.kind {
            QuasiJointKind::Planar => {
                let rates: [T; 3] = part(y, v);
                set(change, q, planar::change(part(y, q), rates.map(|v| h * v)));
            }
            QuasiJointKind::Spherical => {
                let rates: [T; 3] = part(y, v);
                set(
                    change,
                    q,
                    spherical::change(part(y, q), rates.map(|v| h * v)),
                );
            }
            QuasiJointKind::Floating => {
                let rates: [T; 6] = part(y, v);
                set(
                    change,
                    q,
                    floating::change(part(y, q), rates.map(|v| h * v)),
                );
            }
        }
    }
}

/// Returns |q|² − 1 of the quaternion at an index.
fn excess<T: Scalar>(y: &[T], at: usize) -> T {
    let [x, y, z, w] = part(y, at);
    let one = T::from_f64(1.0);
    (x * x + y * y + z * z) + (w + one) * (w - one)
}

/// Returns q (1/|q| − 1), by which a quaternion misses length 1.
fn correction<T: Scalar>(y: &[T], at: usize) -> [T; 4] {
    let q: [T; 4] = part(y, at);
    let one = T::from_f64(1.0);
    let excess = excess(y, at);
    let length = (one + excess).sqrt();
    let part = excess / (length * (one + length));
    q.map(|x| -(x * part))
}

/// Scales every quaternion of the state `y` to length 1. Returns whether there is one.
pub fn normalize<T: Scalar>(joints: &[QuasiJoint], y: &mut [T]) -> bool {
    let quaternions = joints.iter().filter_map(QuasiJoint::quaternion);
    let mut any = false;
    for at in quaternions {
        let correction = correction(y, at);
        for (y, d) in y.iter_mut().skip(at).zip(correction) {
            *y = *y + d;
        }
        any = true;
    }
    any
}

/// Scales every quaternion of a state in two words, `y` + `low` unevaluated. The orientation keeps the
/// digits of both. Returns whether there is a quaternion.
pub fn normalize_in_two<T: Scalar>(joints: &[QuasiJoint], y: &mut [T], low: &mut [T]) -> bool {
    let quaternions = joints.iter().filter_map(QuasiJoint::quaternion);
    let mut any = false;
    for at in quaternions {
        let correction = correction(y, at);
        let words = y.iter_mut().zip(low.iter_mut()).skip(at);
        for ((y, low), d) in words.zip(correction) {
            (*y, *low) = sum_in_two(*y, *low + d);
        }
        any = true;
    }
    any
}

/// Returns whether a quaternion of the state `y` has a length other than 1 by more than the rounding errors
/// of many steps.
pub fn strays<T: Real>(joints: &[QuasiJoint], y: &[T]) -> bool {
    let most = T::EPSILON * T::from_f64(STRAYED);
    let mut quaternions = joints.iter().filter_map(QuasiJoint::quaternion);
    quaternions.any(|at| excess(y, at).abs() > most)
}

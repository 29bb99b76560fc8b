//! Linear velocities of planar and floating joints along axes that do not turn.
//!
//! In the state these velocities v are along the axes of the link, R v along those of its origin. Where nothing pushes a link,
//! R v is constant and v is not: steps that take R v have no error there.

use bgdyn_runtime::manifold::{floating, planar, spherical};
use bgdyn_runtime::{QuasiJoint, QuasiJointKind, Scalar};

use crate::quasi_joints::{part, position_rates, set};

/// Writes the change of the first `positions` components of the state `y` in the time `h` at its velocities: linear ones are
/// constant along the axes of the joint's origin, angular ones along those of the link.
pub(crate) fn straight_change<T: Scalar>(
    joints: &[QuasiJoint],
    positions: usize,
    y: &[T],
    h: T,
    change: &mut [T],
) {
    position_rates(joints, positions, y, change);
    for x in change.iter_mut().take(positions) {
        *x = h * *x;
    }
    for joint in joints {
        let Some(q) = joint.quaternion() else {
            continue;
        };
        // The angular velocities of a joint are its last ones.
        let angular: [T; 3] = part(y, joint.velocity + joint.velocities() - 3);
        let turn = spherical::change(part(y, q), angular.map(|w| h * w));
        set(change, q, turn);
    }
}

/// Turns the velocities of the state `y` from the axes at the positions of another one to those at its own: Rᵀ R₀ v.
pub(crate) fn carry<T: Scalar>(joints: &[QuasiJoint], from: &[T], y: &mut [T]) {
    let zero = T::from_f64(0.0);
    for joint in joints {
        let (q, v) = (joint.position, joint.velocity);
        match joint.kind {
            QuasiJointKind::Planar => {
                let ([_, _, a], [_, _, b]): ([T; 3], [T; 3]) = (part(from, q), part(y, q));
                let rates = planar::position_rates([zero, zero, a - b], part(y, v));
                set(y, v, rates);
            }
            QuasiJointKind::Floating => {
                let rates = floating::position_rates(part(from, q), part(y, v));
                let [a, b, c]: [T; 3] = part(&rates, 0);
                let [i, j, k, w] = part(y, q + 3);
                let back = [zero, zero, zero, -i, -j, -k, w];
                let rates = floating::position_rates(back, [a, b, c, zero, zero, zero]);
                set::<T, 3>(y, v, part(&rates, 0));
            }
            QuasiJointKind::Spherical => {}
        }
    }
}

/// Adds ω × v, with ω of one state and v of another, to the rates v̇: with both of the same they are then Rᵀ d(R v)/dt.
pub(crate) fn add_turning<T: Scalar>(
    joints: &[QuasiJoint],
    (turning, moving): (&[T], &[T]),
    rates: &mut [T],
) {
    for joint in joints {
        let at = joint.velocity;
        let [x, y, z] = part(moving, at);
        let [dx, dy, dz] = part(rates, at);
        match joint.kind {
            QuasiJointKind::Planar => {
                let [_, _, w] = part(turning, at);
                set(rates, at, [dx - w * y, dy + w * x]);
            }
            QuasiJointKind::Floating => {
                let [a, b, c]: [T; 3] = part(turning, at + 3);
                let sums = [
                    dx + (b * z - c * y),
                    dy + (c * x - a * z),
                    dz + (a * y - b * x),
                ];
                set(rates, at, sums);
            }
            QuasiJointKind::Spherical => {}
        }
    }
}

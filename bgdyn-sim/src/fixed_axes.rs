//! Linear velocities of planar and floating joints in axes that do not turn.
//!
//! In the state these velocities v are along the axes of the link, R v along those of its origin. Where nothing pushes a link,
//! R v is constant and v is not: steps that take R v have no error there.

use bgdyn_runtime::manifold::{floating, planar};
use bgdyn_runtime::{QuasiJoint, QuasiJointKind, Scalar};

use crate::quasi_joints::{part, set};

/// Returns R v of a joint with its positions in `y`, or Rᵀ v with the `inverse`. Two components are those of a planar joint.
fn turned<T: Scalar>(joint: &QuasiJoint, y: &[T], v: [T; 3], inverse: bool) -> [T; 3] {
    let zero = T::from_f64(0.0);
    let sign = |x: T| if inverse { -x } else { x };
    let [a, b, c] = v;
    match joint.kind {
        QuasiJointKind::Planar => {
            let [_, _, angle] = part(y, joint.position);
            let [a, b, _] = planar::position_rates([zero, zero, sign(angle)], [a, b, zero]);
            [a, b, zero]
        }
        QuasiJointKind::Floating => {
            let [_, _, _, i, j, k, w] = part(y, joint.position);
            let q = [zero, zero, zero, sign(i), sign(j), sign(k), w];
            let rates = floating::position_rates(q, [a, b, c, zero, zero, zero]);
            part(&rates, 0)
        }
        QuasiJointKind::Spherical => v,
    }
}

/// Writes three components for a floating joint, two for a planar one.
fn set_linear<T: Scalar>(joint: &QuasiJoint, to: &mut [T], from: usize, linear: [T; 3]) {
    match joint.kind {
        QuasiJointKind::Planar => set(to, from, [linear[0], linear[1]]),
        QuasiJointKind::Floating => set(to, from, linear),
        QuasiJointKind::Spherical => {}
    }
}

/// Turns the velocities of the state `y` from the axes at the positions of another one to those at its own.
pub(crate) fn carry<T: Scalar>(joints: &[QuasiJoint], from: &[T], y: &mut [T]) {
    for joint in joints {
        let fixed = turned(joint, from, part(y, joint.velocity), false);
        let own = turned(joint, y, fixed, true);
        set_linear(joint, y, joint.velocity, own);
    }
}

/// Writes the change of the places in the time `h` along straight lines, h R v.
pub(crate) fn go_straight<T: Scalar>(joints: &[QuasiJoint], y: &[T], h: T, change: &mut [T]) {
    for joint in joints {
        let fixed = turned(joint, y, part(y, joint.velocity), false);
        set_linear(joint, change, joint.position, fixed.map(|v| h * v));
    }
}

/// Adds ω × v, with ω of one state and v of another, to the rates v̇: then they are Rᵀ d(R v)/dt.
pub(crate) fn add_turning<T: Scalar>(
    joints: &[QuasiJoint],
    (turning, moving): (&[T], &[T]),
    rates: &mut [T],
) {
    for joint in joints {
        let at = joint.velocity;
        let (v, rate): ([T; 3], [T; 3]) = (part(moving, at), part(rates, at));
        let sum = match joint.kind {
            QuasiJointKind::Planar => {
                let [_, _, w] = part(turning, at);
                [rate[0] - w * v[1], rate[1] + w * v[0], rate[2]]
            }
            QuasiJointKind::Floating => {
                let [a, b, c]: [T; 3] = part(turning, at + 3);
                [
                    rate[0] + (b * v[2] - c * v[1]),
                    rate[1] + (c * v[0] - a * v[2]),
                    rate[2] + (a * v[1] - b * v[0]),
                ]
            }
            QuasiJointKind::Spherical => rate,
        };
        set_linear(joint, rates, at, sum);
    }
}

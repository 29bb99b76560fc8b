//! Locks joints of a mechanism: their links are welded together at given positions.

use bgdyn_runtime::Dd;

use crate::math::{Mat3, Vec3};
use crate::mechanism::{Joint, Motion, Pose};

/// Where a joint holds its link at a coordinate.
pub(super) fn locked_pose(joint: &Joint, at: Dd) -> Pose {
    let Pose {
        rotation,
        translation,
    } = joint.origin;
    match joint.kind.motion {
        Motion::Rotation => Pose {
            rotation: rotation * turn(joint.axis, at),
            translation,
        },
        Motion::Translation => Pose {
            rotation,
            translation: translation + rotation * joint.axis.scale(at),
        },
        Motion::None => joint.origin,
    }
}

/// Rotation by an angle about a unit vector n: n nᵀ + cos q (1 − n nᵀ) + sin q [n]×, quarter turns
/// exact.
fn turn(axis: Vec3<Dd>, angle: Dd) -> Mat3<Dd> {
    let (sin, cos) = angle.sin_cos();
    let exact = |x: Dd| {
        let near = Dd::from_f64(x.to_f64().round());
        if (x - near).to_f64().abs() < 1e-28 {
            near
        } else {
            x
        }
    };
    let (sin, cos) = (exact(sin), exact(cos));
    let n = axis.0;
    Mat3::from_fn(|i, j| {
        let along = n[i] * n[j];
        let across = if i == j { Dd::ONE - along } else { -along };
        let swirl = match (3 + j - i) % 3 {
            0 => Dd::ZERO,
            1 => -n[3 - i - j],
            _ => n[3 - i - j],
        };
        along + cos * across + sin * swirl
    })
}

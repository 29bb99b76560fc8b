//! Locks joints of a mechanism: their links are welded together at given positions.

use bgdyn_runtime::Dd;

use crate::math::rodrigues;
use crate::mechanism::joint::PoseNumbers;
use crate::mechanism::{Joint, Motion, Pose};

/// Returns the pose of a joint's link at a coordinate.
pub(super) fn locked_pose(joint: &Joint, at: Dd) -> Pose {
    let Pose {
        rotation,
        translation,
    } = joint.origin;
    match joint.kind.motion {
        Motion::Rotation => Pose {
            rotation: rotation * rodrigues(joint.axis, cos_sin(at), |x| x),
            translation,
        },
        Motion::Translation => Pose {
            rotation,
            translation: translation + rotation * joint.axis.scale(at),
        },
        Motion::Compound(motion) if motion.positions.len() == 1 => {
            let (turn, shift) = motion.pose(&joint.constants(), &[at], &Exact);
            Pose {
                rotation: rotation * turn,
                translation: translation + rotation * shift,
            }
        }
        // Only joints with one velocity can be locked.
        Motion::None | Motion::Compound(_) => joint.origin,
    }
}

/// Double-double numbers with exact quarter turns.
struct Exact;

impl PoseNumbers<Dd> for Exact {
    fn constant(&self, x: Dd) -> Dd {
        x
    }

    fn cos_sin(&self, angle: Dd) -> (Dd, Dd) {
        cos_sin(angle)
    }

    fn twice_inverse(&self, squares: Dd) -> Dd {
        Dd::from_f64(2.0) / squares
    }
}

/// Returns cosine and sine of an angle, exact for quarter turns.
fn cos_sin(angle: Dd) -> (Dd, Dd) {
    let (sin, cos) = angle.sin_cos();
    let exact = |x: Dd| {
        let near = Dd::from_f64(x.to_f64().round());
        if (x - near).to_f64().abs() < 1e-28 {
            near
        } else {
            x
        }
    };
    (exact(cos), exact(sin))
}

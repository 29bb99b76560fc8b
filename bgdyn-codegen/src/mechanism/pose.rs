//! A constant pose.

use bgdyn_runtime::Dd;

use crate::math::{Mat3, Vec3};

/// A constant pose: axes and origin of one frame in another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Columns are the axes of the inner frame in the outer one.
    pub rotation: Mat3<Dd>,
    /// Origin of the inner frame in the outer one, m.
    pub translation: Vec3<Dd>,
}

impl Pose {
    /// No rotation, no displacement.
    pub const IDENTITY: Pose = Pose {
        rotation: Mat3([
            [Dd::ONE, Dd::ZERO, Dd::ZERO],
            [Dd::ZERO, Dd::ONE, Dd::ZERO],
            [Dd::ZERO, Dd::ZERO, Dd::ONE],
        ]),
        translation: Vec3([Dd::ZERO; 3]),
    };

    /// Returns the pose of `inner`, given in these axes, in the axes in which this pose is given.
    pub fn of(self, inner: Pose) -> Pose {
        Pose {
            rotation: self.rotation * inner.rotation,
            translation: self.translation + self.rotation * inner.translation,
        }
    }

    /// Returns the pose of the outer frame in the inner one.
    pub fn inverse(self) -> Pose {
        let rotation = self.rotation.transpose();
        Pose {
            rotation,
            translation: -(rotation * self.translation),
        }
    }
}

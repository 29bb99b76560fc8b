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
}

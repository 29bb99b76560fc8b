//! Poses of joints with quasi-velocities that a law reads.

use super::EffortSums;
use super::attitude::{Attitude, relative};
use crate::expr::Expr;
use crate::formulation;
use crate::layout::QuasiJoint;
use crate::math::{Mat3, Vec3};

impl<'g> EffortSums<'g, '_> {
    /// Returns the orientation of a spherical or floating joint against a unit quaternion x, y, z, w, which
    /// turns the target's axes to those of the joint's origin.
    ///
    /// # Panics
    /// If the joint has no quaternion.
    pub fn attitude(&self, joint: &QuasiJoint, target: [Expr<'g>; 4]) -> Attitude<'g> {
        let first = joint.quaternion.expect("the joint has a quaternion");
        let q = [0, 1, 2, 3].map(|k| self.q[first + k]);
        let two = self.b.number(2.0);
        let twice = match joint.any_length {
            true => two / q.into_iter().fold(self.b.zero(), |sum, x| sum + x * x),
            false => two,
        };
        let (vector, real) = relative(target, q);
        Attitude {
            vector,
            real,
            twice,
        }
    }

    /// Returns the pose of the link of a joint with quasi-velocities in the joint's origin: the rotation from
    /// link axes to origin axes, and the link's origin, m.
    ///
    /// # Panics
    /// If the mechanism has no such joint.
    pub(crate) fn pose_in_joint(&self, joint: &QuasiJoint) -> (Mat3<Expr<'g>>, Vec3<Expr<'g>>) {
        let first = joint.coordinates.start;
        let pose = formulation::pose_in_joint(self.b, self.graph, first, &self.q);
        pose.expect("a joint of the mechanism with quasi-velocities")
    }
}

//! The orientation of a joint against a target, the moment that turns it there, and its potential.
//!
//! With the quaternion (u, w) = conj(q_target)∘q, u = n sin(θ/2), w = cos(θ/2), and stiffnesses k_i about the
//! link's axes, V = 2 Σ k_i u_i² is smooth over all orientations and the same for q and −q (the modified trace
//! function of Koditschek 1989, in quaternions). Its gradient along the tangent is 2 (w K u + (K u) × u). For
//! one stiffness k the moment is −k n sin θ, and V = k (1 − cos θ). Small turns have the stiffnesses k_i. Half
//! a turn about the link's axis i is an equilibrium too, unstable, with V = 2 k_i.

use bgdyn_runtime::Dd;

use super::EffortSums;
use crate::expr::Expr;
use crate::formulation;
use crate::layout::QuasiJoint;
use crate::math::{Mat3, Vec3};

/// The orientation of a joint against a target. The axis of its turn has the same components in link axes and
/// in those of the target.
#[derive(Clone, Copy, Debug)]
pub struct Attitude<'g> {
    /// n sin(θ/2), times the length of the joint's quaternion.
    vector: Vec3<Expr<'g>>,
    /// cos(θ/2), times the length of the joint's quaternion.
    real: Expr<'g>,
    /// 2 over the square of this length.
    twice: Expr<'g>,
}

impl<'g> Attitude<'g> {
    /// Returns the moment towards the target in link axes, N·m, under these stiffnesses about them, N·m/rad:
    /// the negative gradient of the potential along the tangent.
    pub fn moment(&self, stiffness: Vec3<Expr<'g>>) -> Vec3<Expr<'g>> {
        let [x, y, z] = stiffness.0;
        if x == y && y == z {
            return -self.vector.scale(self.real * x * self.twice);
        }
        let pull = Vec3([0, 1, 2].map(|k| stiffness.0[k] * self.vector.0[k]));
        -(pull.scale(self.real) + pull.cross(self.vector)).scale(self.twice)
    }

    /// Returns a vector of the target's axes in link axes.
    pub fn in_link_axes(&self, x: Vec3<Expr<'g>>) -> Vec3<Expr<'g>> {
        let across = self.vector.cross(x);
        let turned = self.vector.cross(across) - across.scale(self.real);
        x + turned.scale(self.twice)
    }
}

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

/// Returns vector and real part of conj(a)∘b.
pub(crate) fn relative<'g>(a: [Expr<'g>; 4], b: [Expr<'g>; 4]) -> (Vec3<Expr<'g>>, Expr<'g>) {
    let ([ax, ay, az, aw], [bx, by, bz, bw]) = (a, b);
    let (u, v) = (Vec3([ax, ay, az]), Vec3([bx, by, bz]));
    let vector = (v.scale(aw) - u.scale(bw)) - u.cross(v);
    (vector, aw * bw + u.dot(v))
}

/// Returns twice the vector part of conj(q)∘q̇: the angular velocity of a target in its own axes, rad/s.
pub(crate) fn angular_velocity<'g>(q: [Expr<'g>; 4], rates: [Expr<'g>; 4]) -> Vec3<Expr<'g>> {
    relative(q, rates).0.map(|x| x * Dd::from_f64(2.0))
}

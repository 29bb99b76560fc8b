//! The orientation of a joint against a target, the moment that turns it there, and its potential.
//!
//! With the quaternion (u, w) = conj(q_target)∘q, u = n sin(θ/2), w = cos(θ/2), and stiffnesses k_i about the
//! link's axes, V = 2 Σ k_i u_i² is smooth over all orientations and the same for q and −q (the modified trace
//! function of Koditschek 1989, in quaternions). Its gradient along the tangent is 2 (w K u + (K u) × u). For
//! one stiffness k the moment is −k n sin θ, and V = k (1 − cos θ). Small turns have the stiffnesses k_i. Half
//! a turn about the link's axis i is an equilibrium too, unstable, with V = 2 k_i.

use bgdyn_runtime::Dd;

use crate::expr::Expr;
use crate::math::Vec3;

/// The orientation of a joint against a target. The axis of its turn has the same components in link axes and
/// in those of the target.
#[derive(Clone, Copy, Debug)]
pub struct Attitude<'g> {
    /// n sin(θ/2), times the length of the joint's quaternion.
    pub(super) vector: Vec3<Expr<'g>>,
    /// cos(θ/2), times the length of the joint's quaternion.
    pub(super) real: Expr<'g>,
    /// 2 over the square of this length.
    pub(super) twice: Expr<'g>,
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

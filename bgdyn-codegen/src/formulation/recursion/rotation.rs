//! The rotation of a body relative to its basis: about z, or about any axis.

use bgdyn_runtime::Dd;
use bgdyn_runtime::manifold::quaternion_of;
use bgdyn_runtime::nalgebra::Matrix3;

use super::geometry::{Body, identity};
use crate::bond_graph::LinkFrame;
use crate::expr::{Builder, Expr};
use crate::formulation::joint_motion::joint_positions;
use crate::math::{Mat3, Vec3};
use crate::mechanism::Motion;

/// A rotation from a body's own axes to those of its basis.
#[derive(Clone, Copy, Debug)]
#[expect(
    clippy::large_enum_variant,
    reason = "copied by value like every expression; there are few of them"
)]
pub(super) enum Rotation<'g> {
    /// About z: cosine and sine of the angle.
    AboutZ((Expr<'g>, Expr<'g>)),
    /// The body's own axes as columns.
    General(Mat3<Expr<'g>>),
}

impl<'g> From<(Expr<'g>, Expr<'g>)> for Rotation<'g> {
    fn from(angle: (Expr<'g>, Expr<'g>)) -> Self {
        Rotation::AboutZ(angle)
    }
}

impl<'g> Rotation<'g> {
    /// Returns cosine and sine of a rotation about z, which all rotations of plain mechanisms are.
    pub fn angle(self) -> (Expr<'g>, Expr<'g>) {
        match self {
            Rotation::AboutZ(angle) => angle,
            Rotation::General(_) => unreachable!("a rotation that is not about z"),
        }
    }

    /// Returns R v.
    pub fn apply(self, v: Vec3<Expr<'g>>) -> Vec3<Expr<'g>> {
        match self {
            Rotation::AboutZ((c, s)) => {
                let [x, y, z] = v.0;
                Vec3([c * x - s * y, s * x + c * y, z])
            }
            Rotation::General(r) => r * v,
        }
    }

    /// Returns Rᵀ v.
    pub fn apply_back(self, v: Vec3<Expr<'g>>) -> Vec3<Expr<'g>> {
        match self {
            Rotation::AboutZ((c, s)) => {
                let [x, y, z] = v.0;
                Vec3([c * x + s * y, c * y - s * x, z])
            }
            Rotation::General(r) => r.transpose() * v,
        }
    }

    /// Returns the body's own axes in axes in which those of the basis are the columns of `basis`.
    pub fn own_axes(self, basis: &Mat3<Expr<'g>>) -> Mat3<Expr<'g>> {
        match self {
            Rotation::AboutZ((c, s)) => {
                let (x, y) = (basis.column(0), basis.column(1));
                let columns = [
                    x.scale(c) + y.scale(s),
                    y.scale(c) - x.scale(s),
                    basis.column(2),
                ];
                Mat3(columns.map(|v| v.0)).transpose()
            }
            Rotation::General(r) => *basis * r,
        }
    }
}

/// The pose of a body relative to its parent, for a joint with several velocities.
pub(super) struct JointPose<'g> {
    /// Columns: the axes of the joint's origin in the parent's axes.
    pub twist: Mat3<Dd>,
    /// The body's origin in the axes of the joint's origin, in units of the plan.
    pub origin: Vec3<Expr<'g>>,
    /// From the body's axes to those of the joint's origin.
    pub turn: Rotation<'g>,
}

/// Returns the pose of a body whose joint has several velocities. A constant rotation before a quaternion
/// is folded into the quaternion: 16 products instead of 27.
pub(super) fn joint_pose<'g>(
    b: &'g Builder,
    body: &Body,
    link: &LinkFrame,
    q: &[Expr<'g>],
    (offset, unit): (Vec3<Dd>, Dd),
) -> JointPose<'g> {
    let Motion::Compound(motion) = body.motion else {
        unreachable!("{} has one velocity", body.joint)
    };
    let mut positions = joint_positions(b, link, q);
    let folded = match motion.quaternion() {
        Some(first) if body.parent.is_some() && permutation(body.twist).is_none() => {
            let own = std::array::from_fn(|k| positions[first + k]);
            let twist = Matrix3::from_fn(|i, j| body.twist.0[i][j]);
            let whole = product(quaternion_of(&twist), own);
            positions[first..first + 4].copy_from_slice(&whole);
            true
        }
        _ => false,
    };
    let (rotation, shift) = motion.pose(&link.constants(), &positions, &b);
    let origin = b.vector(offset.scale(Dd::ONE / unit)) + shift.map(|x| x * (Dd::ONE / unit));
    let about_z = rotation.0[2][2].as_constant() == Some(Dd::ONE);
    let turn = match about_z {
        true => Rotation::AboutZ((rotation.0[0][0], rotation.0[1][0])),
        false => Rotation::General(rotation),
    };
    match folded {
        true => JointPose {
            twist: identity(),
            origin: body.twist.map(|x| b.constant(x)) * origin,
            turn,
        },
        false => JointPose {
            twist: body.twist,
            origin,
            turn,
        },
    }
}

/// Returns the product of two quaternions x, y, z, w.
fn product<'g>(first: [Dd; 4], second: [Expr<'g>; 4]) -> [Expr<'g>; 4] {
    let [a, b, c, d] = first;
    let [x, y, z, w] = second;
    [
        x * d + w * a + (z * b - y * c),
        y * d + w * b + (x * c - z * a),
        z * d + w * c + (y * a - x * b),
        w * d - x * a - (y * b + z * c),
    ]
}

/// Returns, for a rotation by quarter turns, the parent's axis parallel to each new one.
pub(super) fn permutation(twist: Mat3<Dd>) -> Option<[usize; 3]> {
    // A rotation that differs by 1e-17 from a quarter turn has ones, but no zeros.
    let only = |k: usize, i: usize| (0..3).all(|l| l == i || twist.0[l][k] == Dd::ZERO);
    let index_of = |k: usize| (0..3).find(|&i| only(k, i));
    Some([index_of(0)?, index_of(1)?, index_of(2)?])
}

//! The pose of a frame: position and orientation in the world.

use core::ops::Mul;

use nalgebra::{
    Isometry3, Matrix3, Matrix4, RealField, Rotation3, SVector, UnitQuaternion, Vector3,
};

use crate::{Scalar, rotation};

/// Axes and origin of a frame in the world, or in any other frame.
///
/// A product of poses is read from left to right: with `a` the pose of A in the world and `b` the pose
/// of B in A, `a * b` is the pose of B in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<T> {
    /// Columns are the frame's axes in world axes.
    pub rotation: Matrix3<T>,
    /// The frame's origin in the world, m.
    pub translation: Vector3<T>,
}

impl<T: Scalar> Pose<T> {
    /// The pose of the world itself: no turn, no displacement.
    pub fn identity() -> Self {
        let (zero, one) = (T::from_f64(0.0), T::from_f64(1.0));
        Pose {
            rotation: Matrix3::from_fn(|i, j| if i == j { one } else { zero }),
            translation: Vector3::from_fn(|_, _| zero),
        }
    }

    /// The pose of the world in this frame.
    ///
    /// The rotation is transposed, so that it must be orthogonal, as those of generated functions are.
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.transpose();
        let translation = rotation::turn(&rotation, &self.translation).map(|x| -x);
        Pose {
            rotation,
            translation,
        }
    }

    /// A point given in the frame's axes, in the world's, m.
    pub fn transform_point(&self, p: &Vector3<T>) -> Vector3<T> {
        let turned = self.transform_vector(p);
        turned.zip_map(&self.translation, |a, b| a + b)
    }

    /// A direction given in the frame's axes, in the world's.
    pub fn transform_vector(&self, v: &Vector3<T>) -> Vector3<T> {
        rotation::turn(&self.rotation, v)
    }

    /// A twist given in the frame's axes, in the world's: angular part first, rad/s and m/s.
    ///
    /// Both halves are turned, and the point that the linear part belongs to stays: of a twist at the
    /// frame's origin that is what `velocity_X` and `jacobian_world_X` mean.
    pub fn turn_twist(&self, twist: &SVector<T, 6>) -> SVector<T, 6> {
        let [angular, linear] = halves(twist).map(|half| self.transform_vector(&half));
        join(&angular, &linear)
    }

    /// The twist of a body given in the frame, in the world: angular part first, rad/s and m/s.
    ///
    /// Axes and point both change: the linear part given is the velocity of the body's point at the
    /// frame's origin, the one returned is that of its point at the world's origin, v + p × ω.
    /// [`Pose::turn_twist`] keeps the point.
    pub fn transform_twist(&self, twist: &SVector<T, 6>) -> SVector<T, 6> {
        let [angular, linear] = halves(twist).map(|half| self.transform_vector(&half));
        let [[x, y, z]] = self.translation.data.0;
        let [[a, b, c]] = angular.data.0;
        let moment = Vector3::new(y * c - z * b, z * a - x * c, x * b - y * a);
        join(&angular, &linear.zip_map(&moment, |v, m| v + m))
    }

    /// What is left from this pose to `target`, angular part first: the rotation vector that turns this
    /// orientation to the target's ([`rotation::between`]), rad, and the displacement of the origin, m.
    ///
    /// World axes, and the order of `jacobian_world_X`: J v = k · error leads straight to the target.
    pub fn error_to(&self, target: &Self) -> SVector<T, 6> {
        let angular = rotation::between(&self.rotation, &target.rotation);
        let linear = target.translation.zip_map(&self.translation, |a, b| a - b);
        join(&angular, &linear)
    }

    /// As a homogeneous matrix.
    pub fn to_homogeneous(&self) -> Matrix4<T> {
        let (zero, one) = (T::from_f64(0.0), T::from_f64(1.0));
        Matrix4::from_fn(|i, j| match (i, j) {
            (3, 3) => one,
            (3, _) => zero,
            (_, 3) => self.translation[i],
            _ => self.rotation[(i, j)],
        })
    }
}

fn halves<T: Scalar>(twist: &SVector<T, 6>) -> [Vector3<T>; 2] {
    let [[a, b, c, x, y, z]] = twist.data.0;
    [Vector3::new(a, b, c), Vector3::new(x, y, z)]
}

fn join<T: Scalar>(angular: &Vector3<T>, linear: &Vector3<T>) -> SVector<T, 6> {
    let ([[a, b, c]], [[x, y, z]]) = (angular.data.0, linear.data.0);
    crate::vector([a, b, c, x, y, z])
}

impl<T: Scalar> Mul for Pose<T> {
    type Output = Self;

    /// The pose of a frame given in this one, in what this one is given in.
    fn mul(self, inner: Self) -> Self {
        Pose {
            rotation: rotation::product(&self.rotation, &inner.rotation),
            translation: self.transform_point(&inner.translation),
        }
    }
}

/// The same placement with a unit quaternion in place of the matrix.
impl<T: RealField> From<Pose<T>> for Isometry3<T> {
    fn from(pose: Pose<T>) -> Self {
        let rotation = Rotation3::from_matrix_unchecked(pose.rotation);
        let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
        Isometry3::from_parts(pose.translation.into(), rotation)
    }
}

/// The same placement with a matrix in place of the unit quaternion.
impl<T: RealField> From<Isometry3<T>> for Pose<T> {
    fn from(isometry: Isometry3<T>) -> Self {
        Pose {
            rotation: isometry.rotation.to_rotation_matrix().into_inner(),
            translation: isometry.translation.vector,
        }
    }
}

//! The pose of a frame: position and orientation in the world.

use core::ops::Mul;

use nalgebra::{
    Isometry3, Matrix3, Matrix4, RealField, Rotation3, SVector, UnitQuaternion, Vector3,
};

use crate::{Scalar, rotation};

/// Axes and origin of a frame in the world, or in any other frame.
///
/// Products of poses are written from left to right: if `a` is the pose of A in the world and `b` the pose
/// of B in A, `a * b` is the pose of B in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<T> {
    /// Columns are the frame's axes in world axes.
    pub rotation: Matrix3<T>,
    /// The frame's origin in the world, m.
    pub translation: Vector3<T>,
}

impl<T: Scalar> Pose<T> {
    /// Returns the pose of the world in the world: no rotation, no displacement.
    pub fn identity() -> Self {
        let (zero, one) = (T::from_f64(0.0), T::from_f64(1.0));
        Pose {
            rotation: Matrix3::from_fn(|i, j| if i == j { one } else { zero }),
            translation: Vector3::from_fn(|_, _| zero),
        }
    }

    /// Returns the pose of the world in this frame.
    ///
    /// The rotation is transposed, so it must be orthogonal; poses of generated functions are.
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.transpose();
        let translation = rotation::turn(&rotation, &self.translation).map(|x| -x);
        Pose {
            rotation,
            translation,
        }
    }

    /// Transforms a point from the frame to the world, m.
    pub fn transform_point(&self, p: &Vector3<T>) -> Vector3<T> {
        let turned = self.transform_vector(p);
        turned.zip_map(&self.translation, |a, b| a + b)
    }

    /// Transforms a direction from the frame's axes to world axes.
    pub fn transform_vector(&self, v: &Vector3<T>) -> Vector3<T> {
        rotation::turn(&self.rotation, v)
    }

    /// Transforms a twist from the frame's axes to world axes: angular part first, rad/s and m/s.
    ///
    /// Both parts are rotated, and the reference point of the linear part does not change. For a twist at
    /// the frame's origin the result has the convention of `velocity_X` and `jacobian_world_X`.
    pub fn turn_twist(&self, twist: &SVector<T, 6>) -> SVector<T, 6> {
        let [angular, linear] = halves(twist).map(|half| self.transform_vector(&half));
        join(&angular, &linear)
    }

    /// Transforms the twist of a body from the frame to the world: angular part first, rad/s and m/s.
    ///
    /// Axes and reference point change: the given linear part is the velocity of the body at the frame's
    /// origin; the returned one is its velocity at the world's origin, v + p × ω. [`Pose::turn_twist`]
    /// does not change the point.
    pub fn transform_twist(&self, twist: &SVector<T, 6>) -> SVector<T, 6> {
        let [angular, linear] = halves(twist).map(|half| self.transform_vector(&half));
        let [[x, y, z]] = self.translation.data.0;
        let [[a, b, c]] = angular.data.0;
        let moment = Vector3::new(y * c - z * b, z * a - x * c, x * b - y * a);
        join(&angular, &linear.zip_map(&moment, |v, m| v + m))
    }

    /// Returns the error from this pose to `target`, angular part first: the rotation vector from this
    /// orientation to the target's ([`rotation::between`]), rad, and the displacement of the origin, m.
    ///
    /// The error is in world axes, in the order of `jacobian_world_X`: velocities with J v = k · error
    /// lead straight to the target.
    pub fn error_to(&self, target: &Self) -> SVector<T, 6> {
        let angular = rotation::between(&self.rotation, &target.rotation);
        let linear = target.translation.zip_map(&self.translation, |a, b| a - b);
        join(&angular, &linear)
    }

    /// Returns the pose as a homogeneous matrix.
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

    /// Composes two poses: `inner` is given in the frame of `self`.
    fn mul(self, inner: Self) -> Self {
        Pose {
            rotation: rotation::product(&self.rotation, &inner.rotation),
            translation: self.transform_point(&inner.translation),
        }
    }
}

/// Converts the rotation matrix to a unit quaternion.
impl<T: RealField> From<Pose<T>> for Isometry3<T> {
    fn from(pose: Pose<T>) -> Self {
        let rotation = Rotation3::from_matrix_unchecked(pose.rotation);
        let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
        Isometry3::from_parts(pose.translation.into(), rotation)
    }
}

/// Converts the unit quaternion to a rotation matrix.
impl<T: RealField> From<Isometry3<T>> for Pose<T> {
    fn from(isometry: Isometry3<T>) -> Self {
        Pose {
            rotation: isometry.rotation.to_rotation_matrix().into_inner(),
            translation: isometry.translation.vector,
        }
    }
}

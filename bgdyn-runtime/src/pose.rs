//! Where a frame is.

use nalgebra::{Matrix3, Matrix4, Vector3};

use crate::Scalar;

/// Axes and origin of a frame in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<T> {
    /// Columns are the frame's axes in world axes.
    pub rotation: Matrix3<T>,
    /// The frame's origin in the world, m.
    pub translation: Vector3<T>,
}

impl<T: Scalar> Pose<T> {
    /// A point given in the frame's axes, in the world's, m.
    pub fn transform_point(&self, p: &Vector3<T>) -> Vector3<T> {
        let turned = self.transform_vector(p);
        turned.zip_map(&self.translation, |a, b| a + b)
    }

    /// A direction given in the frame's axes, in the world's.
    pub fn transform_vector(&self, v: &Vector3<T>) -> Vector3<T> {
        let r = &self.rotation;
        let row = |i: usize| r[(i, 0)] * v[0] + r[(i, 1)] * v[1] + r[(i, 2)] * v[2];
        Vector3::new(row(0), row(1), row(2))
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

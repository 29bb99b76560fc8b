//! Rotation matrices, and the cross product as a matrix.
//!
//! A matrix R turns the coordinates of a vector in the turned frame into those in the frame it was
//! turned from: `x_parent = R · x_child`. Angles are in radians and right-handed, for every scalar.

use nalgebra::{Matrix3, Vector3};

use crate::Scalar;

/// The turn by `angle` (rad) about the x axis.
pub fn about_x<T: Scalar>(angle: T) -> Matrix3<T> {
    let (s, c) = angle.sin_cos();
    let (o, l) = (T::from_f64(0.0), T::from_f64(1.0));
    Matrix3::new(l, o, o, o, c, -s, o, s, c)
}

/// The turn by `angle` (rad) about the y axis.
pub fn about_y<T: Scalar>(angle: T) -> Matrix3<T> {
    let (s, c) = angle.sin_cos();
    let (o, l) = (T::from_f64(0.0), T::from_f64(1.0));
    Matrix3::new(c, o, s, o, l, o, -s, o, c)
}

/// The turn by `angle` (rad) about the z axis.
pub fn about_z<T: Scalar>(angle: T) -> Matrix3<T> {
    let (s, c) = angle.sin_cos();
    let (o, l) = (T::from_f64(0.0), T::from_f64(1.0));
    Matrix3::new(c, -s, o, s, c, o, o, o, l)
}

/// The turn by roll, pitch and yaw (rad) about the *fixed* axes x, y and z, in this order, as in
/// URDF: R = Rz(yaw)·Ry(pitch)·Rx(roll).
pub fn rpy<T: Scalar>(roll: T, pitch: T, yaw: T) -> Matrix3<T> {
    let (sr, cr) = roll.sin_cos();
    let (sp, cp) = pitch.sin_cos();
    let (sy, cy) = yaw.sin_cos();
    Matrix3::new(
        cy * cp,
        cy * sp * sr - sy * cr,
        cy * sp * cr + sy * sr,
        sy * cp,
        sy * sp * sr + cy * cr,
        sy * sp * cr - cy * sr,
        -sp,
        cp * sr,
        cp * cr,
    )
}

/// The matrix of the cross product: `skew(v) · x = v × x`. Units of `v`.
pub fn skew<T: Scalar>(v: &Vector3<T>) -> Matrix3<T> {
    let [x, y, z] = (*v).into();
    let o = T::from_f64(0.0);
    Matrix3::new(o, -z, y, z, o, -x, -y, x, o)
}

/// The vector whose [`skew`] is the antisymmetric part of `m`: half the differences of the entries
/// that face each other. Units of `m`.
pub fn unskew<T: Scalar>(m: &Matrix3<T>) -> Vector3<T> {
    let half = T::from_f64(0.5);
    let pair = |i, j| half * (m[(i, j)] - m[(j, i)]);
    Vector3::new(pair(2, 1), pair(0, 2), pair(1, 0))
}

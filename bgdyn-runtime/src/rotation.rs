//! Rotation matrices, rotation vectors, and the matrix of a cross product.
//!
//! A matrix R maps coordinates of a vector in the rotated (child) frame to those in the parent frame:
//! `x_parent = R · x_child`. Angles are in radians and right-handed, for every scalar.

use nalgebra::{Matrix3, Vector3};

use crate::Scalar;

/// Returns the rotation by `angle` (rad) about the x axis.
pub fn about_x<T: Scalar>(angle: T) -> Matrix3<T> {
    let (s, c) = angle.sin_cos();
    let (o, l) = (T::from_f64(0.0), T::from_f64(1.0));
    Matrix3::new(l, o, o, o, c, -s, o, s, c)
}

/// Returns the rotation by `angle` (rad) about the y axis.
pub fn about_y<T: Scalar>(angle: T) -> Matrix3<T> {
    let (s, c) = angle.sin_cos();
    let (o, l) = (T::from_f64(0.0), T::from_f64(1.0));
    Matrix3::new(c, o, s, o, l, o, -s, o, c)
}

/// Returns the rotation by `angle` (rad) about the z axis.
pub fn about_z<T: Scalar>(angle: T) -> Matrix3<T> {
    let (s, c) = angle.sin_cos();
    let (o, l) = (T::from_f64(0.0), T::from_f64(1.0));
    Matrix3::new(c, -s, o, s, c, o, o, o, l)
}

/// Returns the rotation by roll, pitch and yaw (rad) about the *fixed* axes x, y and z, in this order, as
/// in URDF: R = Rz(yaw)·Ry(pitch)·Rx(roll).
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

/// Returns the matrix of the cross product: `skew(v) · x = v × x`. Units of `v`.
pub fn skew<T: Scalar>(v: &Vector3<T>) -> Matrix3<T> {
    let [x, y, z] = (*v).into();
    let o = T::from_f64(0.0);
    Matrix3::new(o, -z, y, z, o, -x, -y, x, o)
}

/// Returns the vector whose [`skew`] is the antisymmetric part of `m`: half the differences of opposite
/// entries. Units of `m`.
pub fn unskew<T: Scalar>(m: &Matrix3<T>) -> Vector3<T> {
    let half = T::from_f64(0.5);
    let pair = |i, j| half * (m[(i, j)] - m[(j, i)]);
    Vector3::new(pair(2, 1), pair(0, 2), pair(1, 0))
}

/// Returns the rotation vector of the rotation R: its direction is the axis, its length the angle, 0 to π
/// rad.
///
/// `rotation` must be orthogonal within rounding. The error is that of the rounding of its entries, also
/// near angles of 0 and π; at π the axis has either sign. The function has no branch and no square root of
/// a number that can vanish, so that it works for lanes and dual numbers, and its derivative is correct at
/// angle 0.
pub fn vector<T: Scalar>(rotation: &Matrix3<T>) -> Vector3<T> {
    let [mut w, mut x, mut y, mut z] = quaternion(rotation);
    let (half, one) = (T::from_f64(0.5), T::from_f64(1.0));
    for _ in 0..HALVINGS {
        // Half the angle: the cosine from the cosine of the angle, which is not negative; the sine from
        // both.
        let cosine = (half * (one + w)).sqrt();
        let scale = half / cosine;
        (w, x, y, z) = (cosine, x * scale, y * scale, z * scale);
    }
    let share = one / w;
    let [x, y, z] = [x * share, y * share, z * share];
    // angle / tan(angle) as a series in the square of the tangent.
    let tangent = x * x + y * y + z * z;
    let last = T::from_f64(0.0);
    let series = (0..TERMS).rev().fold(last, |sum, k| {
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        let coefficient = T::from_f64(sign) / T::from_f64(2.0 * f64::from(k) + 1.0);
        sum * tangent + coefficient
    });
    let whole = T::from_f64(2.0 * f64::from(1_u32 << HALVINGS)) * series;
    Vector3::new(x * whole, y * whole, z * whole)
}

/// Number of halvings of the half angle. It is at most π/2 before and π/32 after them, with a tangent
/// below 0.1.
const HALVINGS: u32 = 4;
/// Number of terms of the series; the first omitted term is below 2⁻¹⁰⁶.
const TERMS: u32 = 16;

/// Returns the rotation vector from the axes `from` to the axes `to`, both given by their columns in world
/// axes. The vector is in world axes, rad, no longer than π, and its rotation times `from` is `to`.
pub fn between<T: Scalar>(from: &Matrix3<T>, to: &Matrix3<T>) -> Vector3<T> {
    vector(&product(to, &from.transpose()))
}

/// Returns the unit quaternion of a rotation, real part first and not negative.
fn quaternion<T: Scalar>(r: &Matrix3<T>) -> [T; 4] {
    let one = T::from_f64(1.0);
    let (xx, yy, zz) = (r[(0, 0)], r[(1, 1)], r[(2, 2)]);
    let sum = |i, j| r[(i, j)] + r[(j, i)];
    let rest = |i, j| r[(i, j)] - r[(j, i)];
    // Each candidate is 4 times one component times the quaternion; the one of the largest component is
    // accurate.
    let candidates = [
        [one + xx + yy + zz, rest(2, 1), rest(0, 2), rest(1, 0)],
        [rest(2, 1), one + xx - yy - zz, sum(0, 1), sum(0, 2)],
        [rest(0, 2), sum(0, 1), one - xx + yy - zz, sum(1, 2)],
        [rest(1, 0), sum(0, 2), sum(1, 2), one - xx - yy + zz],
    ];
    let [mut best, others @ ..] = candidates;
    let mut square = best[0];
    for (k, other) in others.iter().enumerate() {
        let larger = T::less(square, other[k + 1]);
        square = T::select(larger, other[k + 1], square);
        for (chosen, &component) in best.iter_mut().zip(other) {
            *chosen = T::select(larger, component, *chosen);
        }
    }
    let [w, x, y, z] = best;
    let length = (w * w + x * x + y * y + z * z).sqrt();
    let positive = T::select(w.less(T::from_f64(0.0)), -one, one);
    best.map(|component| component * positive / length)
}

/// Returns R x.
pub(crate) fn turn<T: Scalar>(r: &Matrix3<T>, x: &Vector3<T>) -> Vector3<T> {
    let row = |i: usize| r[(i, 0)] * x[0] + r[(i, 1)] * x[1] + r[(i, 2)] * x[2];
    Vector3::new(row(0), row(1), row(2))
}

/// Returns A B.
pub(crate) fn product<T: Scalar>(a: &Matrix3<T>, b: &Matrix3<T>) -> Matrix3<T> {
    Matrix3::from_fn(|i, j| a[(i, 0)] * b[(0, j)] + a[(i, 1)] * b[(1, j)] + a[(i, 2)] * b[(2, j)])
}

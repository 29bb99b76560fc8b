//! Quaternions as arrays x, y, z, w. A unit quaternion turns link axes to origin axes: x_origin = R x_link.

use nalgebra::Matrix3;

use super::functions::{Sines, arc_ratio};
use crate::Scalar;

/// 2π, as the sum of two words.
const TAU: (f64, f64) = (core::f64::consts::TAU, 2.4492935982947064e-16);

/// Returns the rotation matrix of the unit quaternion `q`, in the order x, y, z, w: its columns are the
/// turned (link) axes in the axes of the origin.
///
/// `q` is not normalised. The entries are R = 1 + 2 w \[u\]× + 2 \[u\]×² with u = (x, y, z): a length other
/// than 1 by ε changes R by about 2ε.
pub fn rotation<T: Scalar>(q: [T; 4]) -> Matrix3<T> {
    let [x, y, z, w] = q;
    let one = T::from_f64(1.0);
    let [x2, y2, z2] = [x + x, y + y, z + z];
    let (xx, yy, zz) = (x * x2, y * y2, z * z2);
    let (xy, xz, yz) = (x * y2, x * z2, y * z2);
    let (wx, wy, wz) = (w * x2, w * y2, w * z2);
    Matrix3::new(
        one - (yy + zz),
        xy - wz,
        xz + wy,
        xy + wz,
        one - (xx + zz),
        yz - wx,
        xz - wy,
        yz + wx,
        one - (xx + yy),
    )
}

/// Returns the unit quaternion of a rotation matrix, in the order x, y, z, w, with w ≥ 0; where w = 0, with
/// one of the two signs.
///
/// `rotation` must be orthogonal within rounding. The error is that of the rounding of its entries, for
/// every angle.
pub fn quaternion_of<T: Scalar>(rotation: &Matrix3<T>) -> [T; 4] {
    let one = T::from_f64(1.0);
    let [[xx, yx, zx], [xy, yy, zy], [xz, yz, zz]] = rotation.data.0;
    // Each row is 4 times one component times the quaternion (Shepperd 1978); the row of the largest
    // component is accurate.
    let (wx, wy, wz) = (zy - yz, xz - zx, yx - xy);
    let (sxy, sxz, syz) = (xy + yx, xz + zx, yz + zy);
    let squares = [
        one + xx - yy - zz,
        one - xx + yy - zz,
        one - xx - yy + zz,
        one + xx + yy + zz,
    ];
    let [x, y, z, w] = squares;
    let rows = [
        [x, sxy, sxz, wx],
        [sxy, y, syz, wy],
        [sxz, syz, z, wz],
        [wx, wy, wz, w],
    ];
    let start = ([T::from_f64(0.0); 4], T::from_f64(0.0));
    let (best, _) = rows
        .into_iter()
        .zip(squares)
        .fold(start, |(best, largest), (row, square)| {
            // A NaN is taken as larger.
            let keep = square.less(largest);
            (choose(keep, best, row), T::select(keep, largest, square))
        });
    normalize(short(best))
}

/// Returns the quaternion divided by its length; a zero quaternion unchanged.
pub(super) fn normalize<T: Scalar>(q: [T; 4]) -> [T; 4] {
    let (zero, one) = (T::from_f64(0.0), T::from_f64(1.0));
    let [x, y, z, w] = q;
    let square = (x * x + y * y) + (z * z + w * w);
    // The sum is 1 for zero and NaN for NaN.
    let length = T::select(zero.less(square), square, one + square).sqrt();
    q.map(|component| component / length)
}

/// Returns that of q and −q whose real part is not negative.
fn short<T: Scalar>(q: [T; 4]) -> [T; 4] {
    let [_, _, _, w] = q;
    let negative = w.less(T::from_f64(0.0));
    choose(negative, q.map(|component| -component), q)
}

/// [`Scalar::select`] of all components.
fn choose<T: Scalar>(mask: T::Mask, [x, y, z, w]: [T; 4], [a, b, c, d]: [T; 4]) -> [T; 4] {
    [(x, a), (y, b), (z, c), (w, d)].map(|(x, a)| T::select(mask, x, a))
}

/// Returns the product a∘b: first the turn b, then a.
pub(super) fn product<T: Scalar>(a: [T; 4], b: [T; 4]) -> [T; 4] {
    let [ax, ay, az, aw] = a;
    let [bx, by, bz, bw] = b;
    // Grouped so that the vector part of conj(q)∘q is exactly 0.
    [
        (aw * bx + ax * bw) + (ay * bz - az * by),
        (aw * by + ay * bw) + (az * bx - ax * bz),
        (aw * bz + az * bw) + (ax * by - ay * bx),
        (aw * bw + ax * -bx) - (ay * by + az * bz),
    ]
}

/// Returns the conjugate: the inverse of a unit quaternion.
pub(super) fn conjugate<T: Scalar>([x, y, z, w]: [T; 4]) -> [T; 4] {
    [-x, -y, -z, w]
}

/// Returns ½ q∘ω: the rates of the components.
pub(super) fn rates<T: Scalar>(q: [T; 4], [x, y, z]: [T; 3]) -> [T; 4] {
    let [qx, qy, qz, qw] = q;
    let half = T::from_f64(0.5);
    [
        half * (qw * x + (qy * z - qz * y)),
        half * (qw * y + (qz * x - qx * z)),
        half * (qw * z + (qx * y - qy * x)),
        -(half * (qx * x + qy * y + qz * z)),
    ]
}

/// Returns the unit quaternion of a rotation vector (rad), and the ratios of half its length.
pub(super) fn exponential<T: Scalar>(vector: [T; 3]) -> ([T; 4], Sines<T>) {
    let half = T::from_f64(0.5);
    let [x, y, z] = vector.map(|component| half * component);
    let sines = Sines::of_square(x * x + y * y + z * z);
    let [x, y, z] = [x, y, z].map(|component| sines.sine * component);
    ([x, y, z, sines.cosine], sines)
}

/// Returns q∘(exp(d/2) − 1): the change of a quaternion by a rotation vector `d` (rad), to its own last
/// digits.
pub(super) fn change<T: Scalar>(q: [T; 4], d: [T; 3]) -> [T; 4] {
    let half = T::from_f64(0.5);
    let ([x, y, z, _], sines) = exponential(d);
    let [hx, hy, hz] = d.map(|component| half * component);
    let square = hx * hx + hy * hy + hz * hz;
    product(q, [x, y, z, -(square * sines.versine)])
}

/// Returns the rotation vector, no longer than π (rad), of a quaternion whose length need not be exactly 1,
/// and the square of half its length.
pub(super) fn logarithm<T: Scalar>(q: [T; 4]) -> ([T; 3], T) {
    let [x, y, z, w] = normalize(short(q));
    let square = x * x + y * y + z * z;
    let ratio = arc_ratio(square, w);
    let whole = ratio + ratio;
    ([whole * x, whole * y, whole * z], square * (ratio * ratio))
}

/// Returns R(q) v, with the entries of [`rotation`].
pub(super) fn turn<T: Scalar>([x, y, z, w]: [T; 4], v: [T; 3]) -> [T; 3] {
    let u = [x, y, z];
    let once = cross(u, v).map(|component| component + component);
    let twice = cross(u, once);
    sum(v, sum(once.map(|component| w * component), twice))
}

/// Returns a × b.
pub(super) fn cross<T: Scalar>([ax, ay, az]: [T; 3], [bx, by, bz]: [T; 3]) -> [T; 3] {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

/// Returns a + b.
pub(super) fn sum<T: Scalar>([ax, ay, az]: [T; 3], [bx, by, bz]: [T; 3]) -> [T; 3] {
    [ax + bx, ay + by, az + bz]
}

/// Returns a unit quaternion, evenly distributed over all rotations if the three numbers are over [0, 1)
/// (Shoemake 1992).
pub(super) fn sample<T: Scalar>([u, first, second]: [T; 3]) -> [T; 4] {
    let (hi, lo) = TAU;
    let turn = T::from_parts(hi, lo);
    let (s1, c1) = (turn * first).sin_cos();
    let (s2, c2) = (turn * second).sin_cos();
    let (a, b) = ((T::from_f64(1.0) - u).sqrt(), u.sqrt());
    [a * s1, a * c1, b * s2, b * c2]
}

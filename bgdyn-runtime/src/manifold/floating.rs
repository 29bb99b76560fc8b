//! A floating joint: q is the position of the link's origin in origin axes (m), then the unit quaternion
//! x, y, z, w from link axes to origin axes; v is the velocity of the link's origin (m/s), then the angular
//! velocity (rad/s), both of the link relative to its parent in link axes.

use super::functions::Sines;
use super::quaternion::{self, cross, sum, turn};
use super::spherical;
use super::tangent::{self, cross_columns};
use crate::Scalar;

/// Returns the rates of the coordinates, m/s and 1/s: the linear velocity turned to origin axes, and
/// ½ q∘ω. `v` is in link axes, m/s and rad/s.
pub fn position_rates<T: Scalar>(q: [T; 7], v: [T; 6]) -> [T; 7] {
    let (_, orientation) = parts(q);
    let (linear, angular) = halves(v);
    let rates = quaternion::rates(orientation, angular);
    whole(turn(orientation, linear), rates)
}

/// Returns the coordinates after the twist `d` in link axes, m and rad: the exponential of SE(3) on the
/// right, with the quaternion normalised. They are those after the constant velocity d for one second: the
/// link moves along a screw.
///
/// As `pinocchio::integrate` for its free-flyer joint.
pub fn integrate<T: Scalar>(q: [T; 7], d: [T; 6]) -> [T; 7] {
    let (position, orientation) = parts(q);
    let (path, step) = screw(d);
    whole(
        sum(position, turn(orientation, path)),
        quaternion::normalize(quaternion::product(orientation, step)),
    )
}

/// Returns the change of the coordinates by the twist `d` in link axes, m and rad, to the last digits of
/// the change, which the difference of two positions has lost. It is not normalised.
pub fn change<T: Scalar>(q: [T; 7], d: [T; 6]) -> [T; 7] {
    let (_, orientation) = parts(q);
    let (path, _) = screw(d);
    let (_, angular) = halves(d);
    whole(
        turn(orientation, path),
        quaternion::change(orientation, angular),
    )
}

/// Returns the displacement by the twist `d`, in the link axes at its beginning, and the quaternion of its
/// turn.
fn screw<T: Scalar>(d: [T; 6]) -> ([T; 3], [T; 4]) {
    let (linear, angular) = halves(d);
    let (half, quarter) = (T::from_f64(0.5), T::from_f64(0.25));
    let (step, sines) = quaternion::exponential(angular);
    // (1 − cos)/x² and (x − sin)/x³ of the whole angle x, from those of its half.
    let versine = half * (sines.sine * sines.sine);
    let excess = quarter * (sines.excess + sines.sine * sines.versine);
    (bent(linear, angular, versine, excess), step)
}

/// Returns the twist from `q0` to `q1` in the link axes of `q0`, m and rad: `integrate(q0, d)` is the pose
/// of `q1` (its quaternion may have the other sign). The rotation vector is no longer than π.
///
/// It is the inverse of [`integrate`] for turns by less than π, the logarithm of SE(3). At π the sign of
/// the rotation vector is one of the two, and rounding decides near π. It is finite for all finite
/// positions and finite quaternions near length 1.
pub fn difference<T: Scalar>(q1: [T; 7], q0: [T; 7]) -> [T; 6] {
    let (position1, orientation1) = parts(q1);
    let (position0, orientation0) = parts(q0);
    let back = quaternion::conjugate(orientation0);
    let (angular, square) = quaternion::logarithm(quaternion::product(back, orientation1));
    let path = turn(back, sum(position1, position0.map(|x| -x)));
    // 1 − ½ [φ]× + e [φ]×² is the inverse of the matrix of `integrate`, e = (1 − h/tan h)/4h² with half
    // the angle h.
    let sines = Sines::of_square(square);
    let e = T::from_f64(0.25) * (sines.versine - sines.excess) / sines.sine;
    let [x, y, z] = bent(path, angular, T::from_f64(-0.5), e);
    let [rx, ry, rz] = angular;
    [x, y, z, rx, ry, rz]
}

/// Returns the columns of the matrix of y ↦ \[x, y\] = (ω × v' + v × ω', ω × ω') for the twists x = (v, ω), y = (v', ω').
pub fn bracket<T: Scalar>(x: [T; 6]) -> [[T; 6]; 6] {
    let (linear, angular) = halves(x);
    let zero = T::from_f64(0.0);
    let [[a, b, c], [d, e, f]] = [cross_columns(angular), cross_columns(linear)];
    let alone = |[x, y, z]: [T; 3]| [x, y, z, zero, zero, zero];
    let both = |[x, y, z]: [T; 3], [rx, ry, rz]: [T; 3]| [x, y, z, rx, ry, rz];
    [
        alone(a),
        alone(b),
        alone(c),
        both(d, a),
        both(e, b),
        both(f, c),
    ]
}

/// Returns the derivatives of [`integrate`]`(q, d)` by q and by d, along the tangent, column by column: column k is the
/// twist in the link axes of the result, for a small displacement of q along component k in its link axes, or a change
/// of d's component k. d in m and rad.
pub fn integration_maps<T: Scalar>(d: [T; 6]) -> [[[T; 6]; 6]; 2] {
    let [_, _, _, x, y, z] = d;
    tangent::integration_maps(&bracket(d), x * x + y * y + z * z)
}

/// Returns the coordinates with the quaternion divided by its length. A zero quaternion is returned
/// unchanged; one whose square underflows is not accurate.
pub fn normalize<T: Scalar>(q: [T; 7]) -> [T; 7] {
    let (position, orientation) = parts(q);
    whole(position, quaternion::normalize(orientation))
}

/// Returns the coordinates of the link at the origin, with its axes along origin axes: zeros and the
/// quaternion (0, 0, 0, 1).
pub fn neutral<T: Scalar>() -> [T; 7] {
    let zero = T::from_f64(0.0);
    whole([zero; 3], spherical::neutral())
}

/// Returns a position in [−1, 1) m along each axis from the first three numbers, and a unit quaternion
/// from the last three ([`super::spherical::sample`]). Both are evenly distributed if the numbers are over
/// [0, 1).
pub fn sample<T: Scalar>(u: [T; 6]) -> [T; 7] {
    let (position, orientation) = halves(u);
    let one = T::from_f64(1.0);
    whole(
        position.map(|u| u + u - one),
        quaternion::sample(orientation),
    )
}

/// Returns x + a φ × x + b φ × (φ × x).
fn bent<T: Scalar>(x: [T; 3], phi: [T; 3], a: T, b: T) -> [T; 3] {
    let once = cross(phi, x);
    let twice = cross(phi, once);
    sum(x, sum(once.map(|y| a * y), twice.map(|y| b * y)))
}

fn parts<T>([x, y, z, qx, qy, qz, qw]: [T; 7]) -> ([T; 3], [T; 4]) {
    ([x, y, z], [qx, qy, qz, qw])
}

fn halves<T>([x, y, z, rx, ry, rz]: [T; 6]) -> ([T; 3], [T; 3]) {
    ([x, y, z], [rx, ry, rz])
}

fn whole<T>([x, y, z]: [T; 3], [qx, qy, qz, qw]: [T; 4]) -> [T; 7] {
    [x, y, z, qx, qy, qz, qw]
}

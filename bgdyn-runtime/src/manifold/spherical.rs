//! A spherical joint: q is the unit quaternion x, y, z, w from link axes to origin axes, v the angular
//! velocity ω of the link relative to its parent in link axes, rad/s.

use super::quaternion;
use super::tangent::{self, cross_columns};
use crate::Scalar;

/// Returns the rates of the coordinates, 1/s: q̇ = ½ q∘ω for `v` = ω in link axes, rad/s.
pub fn position_rates<T: Scalar>(q: [T; 4], v: [T; 3]) -> [T; 4] {
    quaternion::rates(q, v)
}

/// Returns the coordinates after a turn by the rotation vector `d` (rad, link axes): q∘exp(d/2),
/// normalised. They are those after the constant velocity d for one second.
pub fn integrate<T: Scalar>(q: [T; 4], d: [T; 3]) -> [T; 4] {
    let (turn, _) = quaternion::exponential(d);
    quaternion::normalize(quaternion::product(q, turn))
}

/// Returns the change of the coordinates by the rotation vector `d` (rad, link axes): q∘(exp(d/2) − 1), to
/// the last digits of the change, which the difference of two positions has lost. It is not normalised.
pub fn change<T: Scalar>(q: [T; 4], d: [T; 3]) -> [T; 4] {
    quaternion::change(q, d)
}

/// Returns the rotation vector (rad, link axes) from `q0` to `q1`, no longer than π: `integrate(q0, d)` is
/// `q1` or −`q1`, which are the same orientation.
///
/// It is the inverse of [`integrate`] for turns by less than π. At π its sign is one of the two, and
/// rounding decides near π. It is finite for all finite quaternions near length 1.
pub fn difference<T: Scalar>(q1: [T; 4], q0: [T; 4]) -> [T; 3] {
    let (vector, _) = quaternion::logarithm(quaternion::product(quaternion::conjugate(q0), q1));
    vector
}

/// Returns the columns of the matrix of y ↦ \[x, y\] = x × y.
pub fn bracket<T: Scalar>(x: [T; 3]) -> [[T; 3]; 3] {
    cross_columns(x)
}

/// Returns the derivatives of [`integrate`]`(q, d)` by q and by d, along the tangent, column by column: column k is the
/// rotation vector in the link axes of the result, for a small turn of q about its link axis k, or a change of d's
/// component k. d in rad.
pub fn integration_maps<T: Scalar>(d: [T; 3]) -> [[[T; 3]; 3]; 2] {
    let [x, y, z] = d;
    tangent::integration_maps(&bracket(d), x * x + y * y + z * z)
}

/// Returns the quaternion divided by its length. A zero quaternion is returned unchanged; one whose square
/// underflows is not accurate.
pub fn normalize<T: Scalar>(q: [T; 4]) -> [T; 4] {
    quaternion::normalize(q)
}

/// Returns the coordinates with link axes along origin axes: (0, 0, 0, 1).
pub fn neutral<T: Scalar>() -> [T; 4] {
    let (zero, one) = (T::from_f64(0.0), T::from_f64(1.0));
    [zero, zero, zero, one]
}

/// Returns a unit quaternion, evenly distributed over all orientations if the three numbers of `u` are
/// over [0, 1) (Shoemake, "Uniform random rotations", Graphics Gems III, 1992).
pub fn sample<T: Scalar>(u: [T; 3]) -> [T; 4] {
    quaternion::sample(u)
}

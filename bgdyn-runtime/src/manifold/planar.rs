//! A planar joint: q is the position x, y of the link's origin in origin axes (m) and the angle about z
//! (rad); v is the velocity of the link's origin along the link's x and y axes (m/s) and the angular
//! velocity about z (rad/s).

use super::functions::sine_ratio;
use super::tangent;
use crate::Scalar;

/// π, as the sum of two words.
const PI: (f64, f64) = (core::f64::consts::PI, 1.2246467991473532e-16);

/// Returns the rates of the coordinates, m/s and rad/s: the linear velocity turned to origin axes, and the
/// angular velocity. `v` is in link axes.
pub fn position_rates<T: Scalar>(q: [T; 3], v: [T; 3]) -> [T; 3] {
    let [_, _, angle] = q;
    let [x, y, rate] = v;
    let [x, y] = turn(angle.sin_cos(), [x, y]);
    [x, y, rate]
}

/// Returns the coordinates after the twist `d` in link axes, m and rad: the exponential of SE(2) on the
/// right. They are those after the constant velocity d for one second: the link's origin moves along an
/// arc of a circle. Angles add and are not wrapped.
pub fn integrate<T: Scalar>(q: [T; 3], d: [T; 3]) -> [T; 3] {
    let [x, y, angle] = q;
    let [dx, dy, turned] = change(q, d);
    [x + dx, y + dy, angle + turned]
}

/// Returns the change of the coordinates by the twist `d` in link axes, m and rad, to the last digits of
/// the change: [`integrate`] is its sum with `q`.
pub fn change<T: Scalar>(q: [T; 3], d: [T; 3]) -> [T; 3] {
    let [_, _, angle] = q;
    let [dx, dy, turned] = d;
    // The chord of an arc has the direction of its middle.
    let half = T::from_f64(0.5) * turned;
    let chord = sine_ratio(half);
    let middle = T::sin_cos_sum(&[angle, half], (0.0, 0.0));
    let [dx, dy] = turn(middle, [chord * dx, chord * dy]);
    [dx, dy, turned]
}

/// Returns the twist from `q0` to `q1` in the link axes of `q0`, m and rad: `integrate(q0, d)` = `q1`.
///
/// The angle is the difference of the two angles, not wrapped: full turns count. Near a difference of
/// ±2π, ±4π, … a twist that reaches another position is very long.
pub fn difference<T: Scalar>(q1: [T; 3], q0: [T; 3]) -> [T; 3] {
    let [x1, y1, angle1] = q1;
    let [x0, y0, angle0] = q0;
    let turned = angle1 - angle0;
    let half = T::from_f64(0.5) * turned;
    let chord = sine_ratio(half);
    let (s, c) = T::sin_cos_sum(&[angle0, half], (0.0, 0.0));
    let [x, y] = turn((-s, c), [x1 - x0, y1 - y0]);
    [x / chord, y / chord, turned]
}

/// Returns the columns of the matrix of y ↦ \[x, y\] for the twists x and y: linear along x and y, angular.
pub fn bracket<T: Scalar>([x, y, turn]: [T; 3]) -> [[T; 3]; 3] {
    let zero = T::from_f64(0.0);
    [[zero, turn, zero], [-turn, zero, zero], [y, -x, zero]]
}

/// Returns the derivatives of [`integrate`]`(q, d)` by q and by d, along the tangent, column by column: column k is the
/// twist in the link axes of the result, for a small displacement of q along component k in its link axes, or a change
/// of d's component k. d in m and rad.
pub fn integration_maps<T: Scalar>(d: [T; 3]) -> [[[T; 3]; 3]; 2] {
    let [_, _, turn] = d;
    tangent::integration_maps(&bracket(d), turn * turn)
}

/// Returns the coordinates unchanged: none of them has a constraint.
pub fn normalize<T: Scalar>(q: [T; 3]) -> [T; 3] {
    q
}

/// Returns the coordinates of the link at the origin, with its axes along origin axes: zeros.
pub fn neutral<T: Scalar>() -> [T; 3] {
    [T::from_f64(0.0); 3]
}

/// Returns a position in [−1, 1) m along each axis and an angle in [−π, π) rad, evenly distributed if the
/// three numbers of `u` are over [0, 1).
pub fn sample<T: Scalar>(u: [T; 3]) -> [T; 3] {
    let one = T::from_f64(1.0);
    let [x, y, angle] = u.map(|u| u + u - one);
    let (hi, lo) = PI;
    [x, y, T::from_parts(hi, lo) * angle]
}

/// Returns the vector turned by the angle of the sine and cosine.
fn turn<T: Scalar>((s, c): (T, T), [x, y]: [T; 2]) -> [T; 2] {
    [c * x - s * y, s * x + c * y]
}

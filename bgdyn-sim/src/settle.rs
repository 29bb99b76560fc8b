//! The slip below which a coordinate counts as at rest.

use crate::space::Real;

/// The slip, rad/s or m/s, up to which a coordinate with this `velocity` counts as at rest: the part
/// `rest` of the larger of its own and its counterpart's velocity, and what rounding leaves.
pub fn resting_slip<T: Real>(slip: T, velocity: T, rest: T) -> T {
    let largest = velocity.abs().max((velocity - slip).abs());
    rest * largest + T::EPSILON * T::from_f64(64.0)
}

//! Modes of dry friction that agree with the state.

use crate::space::Real;

/// The mode that a joint's slip calls for: 0 where it rests against its counterpart, else the
/// direction it slips in.
///
/// `slip` is the joint's `velocity` less its counterpart's, rad/s or m/s. At rest is a joint whose
/// slip is no more than the part `rest` of the larger of both velocities; one that slips the way its
/// `mode` says keeps it, however slow it is.
pub fn mode_by_slip<T: Real>(mode: T, slip: T, velocity: T, rest: T) -> T {
    let zero = T::from_f64(0.0);
    let largest = velocity.abs().max((velocity - slip).abs());
    let rounding = T::EPSILON * T::from_f64(64.0);
    if mode * slip > zero {
        mode
    } else if slip.abs() <= rest * largest + rounding {
        zero
    } else {
        slip.sign()
    }
}

//! The motion of a base that carries a mechanism (`base: given` in its file).

use nalgebra::{Matrix3, Vector3};

use crate::{Scalar, rotation};

/// The motion of the base that carries a mechanism, in base axes.
///
/// The velocity of the base changes no effort of the mechanism (Galileo), so it is not part of this.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BaseMotion<T> {
    /// Angular velocity ω in an inertial frame, rad/s: what a gyroscope on the base measures.
    pub angular_velocity: Vector3<T>,
    /// Angular acceleration ω̇ in an inertial frame, rad/s².
    pub angular_acceleration: Vector3<T>,
    /// Acceleration of the base's origin less gravity, m/s²: what an accelerometer there measures. At rest
    /// it is opposite to gravity.
    pub specific_force: Vector3<T>,
}

impl<T: Scalar> BaseMotion<T> {
    /// Returns the motion of a base at rest, whose axes have this rotation to world axes; `gravity` is the
    /// acceleration of free fall in world axes, m/s².
    pub fn at_rest(rotation: &Matrix3<T>, gravity: &Vector3<T>) -> Self {
        let zero = Vector3::from_fn(|_, _| T::from_f64(0.0));
        Self::from_world(rotation, [&zero; 3], gravity)
    }

    /// Returns the motion from quantities in world axes: the rotation from base axes to world axes; angular
    /// velocity, rad/s, angular acceleration, rad/s², and acceleration of the base's origin, m/s²; and the
    /// acceleration of free fall `gravity`, m/s².
    pub fn from_world(
        rotation: &Matrix3<T>,
        [angular_velocity, angular_acceleration, acceleration]: [&Vector3<T>; 3],
        gravity: &Vector3<T>,
    ) -> Self {
        let back = rotation.transpose();
        let free = acceleration.zip_map(gravity, |a, g| a - g);
        BaseMotion {
            angular_velocity: rotation::turn(&back, angular_velocity),
            angular_acceleration: rotation::turn(&back, angular_acceleration),
            specific_force: rotation::turn(&back, &free),
        }
    }
}

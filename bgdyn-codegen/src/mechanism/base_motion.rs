//! The motion of a base that carries the mechanism: `base: given`.
//!
//! The base is a hidden, massless link with the joint [`super::joint::given`], which has no coordinates. Its
//! motion is nine run-time parameters in base axes. Poses and velocities are relative to the base; efforts
//! are those of the motion in space.

use super::id::ParameterId;
use crate::math::Vec3;

/// The names of the run-time parameters before `_x`, `_y`, `_z`, with their meanings and units.
pub const BASE_PARAMETERS: [(&str, &str, &str); 3] = [
    (
        "base_angular_velocity",
        "angular velocity of the base",
        "rad/s",
    ),
    (
        "base_angular_acceleration",
        "angular acceleration of the base",
        "rad/s²",
    ),
    (
        "base_specific_force",
        "acceleration of the base's origin less gravity",
        "m/s²",
    ),
];

/// Returns the names of the nine run-time parameters.
pub fn base_parameter_names() -> impl Iterator<Item = String> {
    let axes = ["x", "y", "z"];
    BASE_PARAMETERS
        .into_iter()
        .flat_map(move |(name, ..)| axes.map(|axis| format!("{name}_{axis}")))
}

/// The motion of the base, in base axes: run-time parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BaseMotion {
    /// ω, rad/s.
    pub angular_velocity: Vec3<ParameterId>,
    /// ω̇, rad/s².
    pub angular_acceleration: Vec3<ParameterId>,
    /// Acceleration of the base's origin less gravity, m/s²: what an accelerometer there measures.
    pub specific_force: Vec3<ParameterId>,
}

impl BaseMotion {
    /// Returns its parameters, the first of which has this index: those of [`BASE_PARAMETERS`] in their
    /// order.
    pub(super) fn from_parameter(first: usize) -> Self {
        let part = |i: usize| Vec3(std::array::from_fn(|k| ParameterId(first + 3 * i + k)));
        BaseMotion {
            angular_velocity: part(0),
            angular_acceleration: part(1),
            specific_force: part(2),
        }
    }

    /// Returns its nine parameters: ω, ω̇, then the specific force.
    pub fn parameters(&self) -> [ParameterId; 9] {
        let parts = [
            self.angular_velocity.0,
            self.angular_acceleration.0,
            self.specific_force.0,
        ];
        std::array::from_fn(|k| parts[k / 3][k % 3])
    }
}

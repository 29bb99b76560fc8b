//! The motion of a base that carries the mechanism: `base: given`.
//!
//! The base is a hidden, massless link with the joint [`super::joint::given`], which has no coordinates. Its
//! motion is nine run-time parameters in base axes. Poses and velocities are relative to the base; efforts
//! are those of the motion in space.

use bgdyn_runtime::Dd;

use super::{Degrees, Inertial, Joint, Limits, Link, Parameter, ParameterId, Pose, Value, joint};
use crate::math::Vec3;

/// The name of the hidden link. Generated code uses it in the names of intermediate results only.
const NAME: &str = "moving_base";

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
    pub angular_velocity: Vec3<Value>,
    /// ω̇, rad/s².
    pub angular_acceleration: Vec3<Value>,
    /// Acceleration of the base's origin less gravity, m/s²: what an accelerometer there measures.
    pub specific_force: Vec3<Value>,
}

impl BaseMotion {
    /// Returns its nine numbers: ω, ω̇, then the specific force.
    pub fn numbers(&self) -> [Value; 9] {
        let parts = [
            self.angular_velocity.0,
            self.angular_acceleration.0,
            self.specific_force.0,
        ];
        std::array::from_fn(|k| parts[k / 3][k % 3])
    }

    /// Returns the motion, and its parameters with the values of a base at rest, for the first free index
    /// of a parameter.
    pub(super) fn at_rest(gravity: Vec3<Dd>, first: usize) -> (Self, Vec<Parameter>) {
        let defaults = [Vec3([Dd::ZERO; 3]), Vec3([Dd::ZERO; 3]), -gravity];
        let named = BASE_PARAMETERS.into_iter().zip(defaults);
        let parameters = named.flat_map(|((name, meaning, unit), default)| {
            (0..3).map(move |k| {
                let axis = ["x", "y", "z"][k];
                Parameter {
                    name: format!("{name}_{axis}"),
                    meaning: format!("{meaning}, along {axis} of the base"),
                    default: default.0[k],
                    unit,
                }
            })
        });
        let part = |i: usize| {
            let value = |k: usize| Value::Parameter(ParameterId(first + 3 * i + k));
            Vec3(std::array::from_fn(value))
        };
        let motion = BaseMotion {
            angular_velocity: part(0),
            angular_acceleration: part(1),
            specific_force: part(2),
        };
        (motion, parameters.collect())
    }
}

/// Returns the hidden link of the base.
pub(super) fn base_link(massless: Inertial) -> Link {
    Link {
        name: NAME.into(),
        label: None,
        parent: None,
        joint: Joint {
            name: NAME.into(),
            label: None,
            kind: joint::given(),
            axis: Vec3([Dd::ZERO, Dd::ZERO, Dd::ONE]),
            origin: Pose::IDENTITY,
            limits: Limits::default(),
            coordinate: None,
            degrees: Degrees::default(),
        },
        inertial: massless,
        hidden: true,
    }
}

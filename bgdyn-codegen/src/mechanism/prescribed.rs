//! Joints whose motion is given at run time: the constraint `prescribed`.
//!
//! Such a joint has no entry in q and v. Its position, velocity and acceleration are three run-time parameters.
//! `Mechanism::released` is the mechanism in which these joints are free; it has the same links and parameters.

use super::id::{LinkId, ParameterId};

/// The endings of the three run-time parameters, with their units for a rotation and for a translation.
pub const PRESCRIBED_PARAMETERS: [(&str, [&str; 2]); 3] = [
    ("position", ["rad", "m"]),
    ("velocity", ["rad/s", "m/s"]),
    ("acceleration", ["rad/s²", "m/s²"]),
];

/// A joint whose motion is given at run time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PrescribedJoint {
    /// The link outboard of the joint.
    pub link: LinkId,
    /// Its position, its velocity, its acceleration.
    pub motion: [ParameterId; 3],
}

/// Returns the names of the three run-time parameters of a joint.
pub fn prescribed_parameter_names(joint: &str) -> [String; 3] {
    PRESCRIBED_PARAMETERS.map(|(ending, _)| format!("{joint}_{ending}"))
}

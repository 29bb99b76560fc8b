//! The list of joint types: a file for each, and a line for each in [`JOINT_TYPES`].

mod continuous;
mod fixed;
mod joint_type;
mod prismatic;
mod revolute;

pub use joint_type::{JointType, Motion};

/// Returns the fixed joint.
pub(crate) fn fixed() -> &'static JointType {
    &fixed::FIXED
}

/// Returns the prismatic joint.
pub(crate) fn prismatic() -> &'static JointType {
    &prismatic::PRISMATIC
}

/// All joint types.
pub static JOINT_TYPES: [&JointType; 4] = [
    &revolute::REVOLUTE,
    &continuous::CONTINUOUS,
    &prismatic::PRISMATIC,
    &fixed::FIXED,
];

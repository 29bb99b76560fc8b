//! Joint types: a file for each, and a line for each in [`JOINT_TYPES`].

mod continuous;
mod fixed;
mod joint_type;
mod prismatic;
mod revolute;

pub use joint_type::{JointType, Motion};

/// The joint that lets nothing move.
pub(crate) fn fixed() -> &'static JointType {
    &fixed::FIXED
}

/// The joint that lets slide along an axis.
pub(crate) fn prismatic() -> &'static JointType {
    &prismatic::PRISMATIC
}

/// Every joint type there is.
pub static JOINT_TYPES: [&JointType; 4] = [
    &revolute::REVOLUTE,
    &continuous::CONTINUOUS,
    &prismatic::PRISMATIC,
    &fixed::FIXED,
];

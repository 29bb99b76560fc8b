//! The list of joint types: a file for each, and a line for each in [`JOINT_TYPES`].

mod compound;
mod continuous;
mod cylindrical;
mod fixed;
mod floating;
mod given;
mod helical;
mod joint_type;
mod planar;
mod prismatic;
mod revolute;
mod spherical;
mod universal;

pub use compound::{
    Column, CompoundMotion, DoubleDouble, JointConstants, PoseNumbers, PositionPart, Step, Twist,
    VelocityPart,
};
pub use joint_type::{ChainMember, JointType, Motion};

/// Returns the fixed joint.
pub(crate) fn fixed() -> &'static JointType {
    &fixed::FIXED
}

/// Returns a joint whose motion is given: that of a base, or a prescribed one.
pub(crate) fn given() -> &'static JointType {
    &given::GIVEN
}

/// Returns the floating joint.
pub(crate) fn floating() -> &'static JointType {
    &floating::FLOATING
}

/// Returns the prismatic joint.
pub(crate) fn prismatic() -> &'static JointType {
    &prismatic::PRISMATIC
}

/// All joint types that a link can have.
pub static JOINT_TYPES: [&JointType; 10] = [
    &revolute::REVOLUTE,
    &continuous::CONTINUOUS,
    &prismatic::PRISMATIC,
    &fixed::FIXED,
    &spherical::SPHERICAL,
    &floating::FLOATING,
    &planar::PLANAR,
    &cylindrical::CYLINDRICAL,
    &universal::UNIVERSAL,
    &helical::HELICAL,
];

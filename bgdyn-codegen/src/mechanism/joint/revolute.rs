//! The revolute joint: rotation about an axis, between position limits if the spec has them.

use super::{JointType, Motion};

/// Rotation about an axis, between position limits if the spec states them.
pub(super) static REVOLUTE: JointType = JointType {
    keyword: "revolute",
    motion: Motion::Rotation,
    position_limits: true,
    chain: &[],
};

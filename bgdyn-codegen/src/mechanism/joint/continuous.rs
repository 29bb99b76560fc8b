//! The continuous joint: rotation about an axis without position limits.

use super::{JointType, Motion};

/// Rotation about an axis without position limits; the coordinate is the angle.
pub(super) static CONTINUOUS: JointType = JointType {
    keyword: "continuous",
    motion: Motion::Rotation,
    position_limits: false,
    chain: &[],
};

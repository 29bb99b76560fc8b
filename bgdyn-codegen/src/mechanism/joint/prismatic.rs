//! The prismatic joint: translation along an axis.

use super::{JointType, Motion};

/// Translation along an axis.
pub(super) static PRISMATIC: JointType = JointType {
    keyword: "prismatic",
    motion: Motion::Translation,
    position_limits: true,
    chain: &[],
};

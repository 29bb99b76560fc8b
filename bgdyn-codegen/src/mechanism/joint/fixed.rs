//! The fixed joint: the link is welded to its parent.

use super::{JointType, Motion};

/// No motion: the link is welded to its parent.
pub(super) static FIXED: JointType = JointType {
    keyword: "fixed",
    motion: Motion::None,
    position_limits: false,
    chain: &[],
};

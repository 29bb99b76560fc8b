//! The cylindrical joint: rotation about an axis and translation along it.

use super::{ChainMember, JointType, Motion, prismatic::PRISMATIC, revolute::REVOLUTE};

/// Rotation about an axis, then translation along it: two joints in series.
pub(super) static CYLINDRICAL: JointType = JointType {
    keyword: "cylindrical",
    motion: Motion::Translation,
    position_limits: true,
    chain: &[
        ChainMember {
            suffix: "turn",
            kind: &REVOLUTE,
            second_axis: false,
        },
        ChainMember {
            suffix: "slide",
            kind: &PRISMATIC,
            second_axis: false,
        },
    ],
};

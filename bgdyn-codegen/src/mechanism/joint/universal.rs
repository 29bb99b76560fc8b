//! The universal joint: rotation about one axis, then about another.

use super::{ChainMember, JointType, Motion, revolute::REVOLUTE};

/// Rotation about `axis`, then about `axis2`, which the first rotation carries along: two joints in series.
pub(super) static UNIVERSAL: JointType = JointType {
    keyword: "universal",
    motion: Motion::Rotation,
    position_limits: true,
    chain: &[
        ChainMember {
            suffix: "first",
            kind: &REVOLUTE,
            second_axis: false,
        },
        ChainMember {
            suffix: "second",
            kind: &REVOLUTE,
            second_axis: true,
        },
    ],
};

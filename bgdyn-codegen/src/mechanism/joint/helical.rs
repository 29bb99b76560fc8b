//! The helical joint: rotation about an axis with a proportional advance along it.

use super::compound::{CompoundMotion, Step, Twist, VelocityPart, angle};
use super::{JointType, Motion};

static MOTION: CompoundMotion = CompoundMotion {
    manifold: "",
    steps: &[Step::Screw(0)],
    positions: &[angle("")],
    velocities: &[VelocityPart {
        suffix: "",
        twist: Twist::Screw,
    }],
    axial: true,
};

/// A screw: rotation about an axis, with `lead` along it for each turn; the coordinate is the angle.
pub(super) static HELICAL: JointType = JointType {
    keyword: "helical",
    motion: Motion::Compound(&MOTION),
    position_limits: true,
    chain: &[],
};

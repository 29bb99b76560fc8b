//! The joint between the world and a base whose motion is given: no coordinates, and not at rest.

use super::compound::CompoundMotion;
use super::{JointType, Motion};

static MOTION: CompoundMotion = CompoundMotion {
    manifold: "",
    steps: &[],
    positions: &[],
    velocities: &[],
    axial: false,
};

/// The motion of the base, by `base: given`. No link of a file has this joint.
pub(super) static GIVEN: JointType = JointType {
    keyword: "given",
    motion: Motion::Compound(&MOTION),
    position_limits: false,
    chain: &[],
};

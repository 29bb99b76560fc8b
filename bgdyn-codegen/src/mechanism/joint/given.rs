//! A joint whose motion is given: no coordinates, and not at rest.
//!
//! It is that between the world and a base whose motion is given, and in graphs that of a prescribed joint.

use super::compound::CompoundMotion;
use super::{JointType, Motion};

static MOTION: CompoundMotion = CompoundMotion {
    manifold: "",
    steps: &[],
    positions: &[],
    velocities: &[],
    axial: false,
};

/// A joint whose motion is given. No link of a file has this joint.
pub(super) static GIVEN: JointType = JointType {
    keyword: "given",
    motion: Motion::Compound(&MOTION),
    position_limits: false,
    chain: &[],
};

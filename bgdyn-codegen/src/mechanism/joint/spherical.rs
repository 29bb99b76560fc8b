//! The spherical joint: any rotation about a point.

use super::compound::{CompoundMotion, Step, angular, component};
use super::{JointType, Motion};

static MOTION: CompoundMotion = CompoundMotion {
    manifold: "spherical",
    steps: &[Step::Quaternion(0)],
    positions: &[
        component("qx", 0),
        component("qy", 0),
        component("qz", 0),
        component("qw", 1),
    ],
    velocities: &[angular("rx", 0), angular("ry", 1), angular("rz", 2)],
    axial: false,
};

/// Any rotation about the origin. Positions: a unit quaternion x, y, z, w, from link axes to origin axes.
/// Velocities: the angular velocity of the link relative to its parent, in link axes.
pub(super) static SPHERICAL: JointType = JointType {
    keyword: "spherical",
    motion: Motion::Compound(&MOTION),
    position_limits: false,
    chain: &[],
};

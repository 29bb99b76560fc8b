//! The floating joint: any motion of a rigid body.

use super::compound::{CompoundMotion, Step, angular, component, length, linear};
use super::{JointType, Motion};

static MOTION: CompoundMotion = CompoundMotion {
    manifold: "floating",
    steps: &[
        Step::Shift([Some(0), Some(1), Some(2)]),
        Step::Quaternion(3),
    ],
    positions: &[
        length("x"),
        length("y"),
        length("z"),
        component("qx", 0),
        component("qy", 0),
        component("qz", 0),
        component("qw", 1),
    ],
    velocities: &[
        linear("x", 0),
        linear("y", 1),
        linear("z", 2),
        angular("rx", 0),
        angular("ry", 1),
        angular("rz", 2),
    ],
    axial: false,
};

/// Any motion of a rigid body. Positions: the link's origin in origin axes, then a unit quaternion x, y,
/// z, w. Velocities: linear, then angular, both in link axes.
pub(super) static FLOATING: JointType = JointType {
    keyword: "floating",
    motion: Motion::Compound(&MOTION),
    position_limits: false,
    chain: &[],
};

//! The planar joint: motion in the x–y plane of its origin.

use super::compound::{CompoundMotion, Step, angle, angular, length, linear};
use super::{JointType, Motion};

static MOTION: CompoundMotion = CompoundMotion {
    manifold: "planar",
    steps: &[Step::Shift([Some(0), Some(1), None]), Step::TurnZ(2)],
    positions: &[length("x"), length("y"), angle("turn")],
    velocities: &[linear("x", 0), linear("y", 1), angular("turn", 2)],
    axial: false,
};

/// Motion in the x–y plane of the origin. Positions: x, y, the angle about z. Velocities: along the link's
/// x and y, about z.
pub(super) static PLANAR: JointType = JointType {
    keyword: "planar",
    motion: Motion::Compound(&MOTION),
    position_limits: false,
    chain: &[],
};

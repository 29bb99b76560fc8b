//! Prescribed joints in the bond graph.

use crate::mechanism::{CoordinateId, ParameterId};

/// A joint whose motion is given at run time: a flow source on the 1-junction of its velocity.
#[derive(Clone, Debug, PartialEq)]
pub struct PrescribedVelocity {
    /// Name of the joint.
    pub name: String,
    /// Its velocity in the mechanism in which it is free.
    pub coordinate: CoordinateId,
    /// Its position, its velocity, its acceleration.
    pub motion: [ParameterId; 3],
    /// Whether its unit is m/s, not rad/s.
    pub linear: bool,
}

/// Where a position or a velocity of the mechanism with free joints comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FreeArgument {
    /// From q or v: its index there.
    Own(usize),
    /// From the motion of a prescribed joint: its index in `Released::prescribed`.
    Prescribed(usize),
}

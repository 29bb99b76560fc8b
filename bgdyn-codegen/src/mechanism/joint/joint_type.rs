//! The type of a joint: its word in the spec, and the motion that it allows.

/// The motion that a joint allows in the equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// None: the link is welded to its parent.
    None,
    /// Rotation about the axis by the coordinate, in radians.
    Rotation,
    /// Translation along the axis by the coordinate, in metres.
    Translation,
}

impl Motion {
    /// Returns the unit of the coordinate.
    pub fn unit(self) -> &'static str {
        match self {
            Motion::None => "none",
            Motion::Rotation => "rad",
            Motion::Translation => "m",
        }
    }
}

/// A word for a joint's `type` in the spec, and its meaning.
#[derive(Debug, PartialEq, Eq)]
pub struct JointType {
    /// The word in the spec.
    pub keyword: &'static str,
    /// The motion it allows.
    pub motion: Motion,
    /// Whether it can have `lower` and `upper` limits.
    pub position_limits: bool,
}

//! What a joint type is: its word in the spec, and the motion that it allows.

/// The motion a joint allows, as the equations see it.
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
    /// Unit of the coordinate.
    pub fn unit(self) -> &'static str {
        match self {
            Motion::None => "none",
            Motion::Rotation => "rad",
            Motion::Translation => "m",
        }
    }
}

/// What the spec can say in a joint's `type`, and what it means.
#[derive(Debug, PartialEq, Eq)]
pub struct JointType {
    /// The word in the spec.
    pub keyword: &'static str,
    /// The motion it allows.
    pub motion: Motion,
    /// Whether `lower` and `upper` limits have a meaning.
    pub position_limits: bool,
}

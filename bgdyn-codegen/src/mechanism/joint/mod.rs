//! Joint types: a file for each, and a line for each in [`JOINT_TYPES`].

mod continuous;
mod fixed;
mod prismatic;
mod revolute;

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

/// The joint that lets nothing move.
pub(crate) fn fixed() -> &'static JointType {
    &fixed::FIXED
}

/// The joint that lets slide along an axis.
pub(crate) fn prismatic() -> &'static JointType {
    &prismatic::PRISMATIC
}

/// Every joint type there is.
pub static JOINT_TYPES: [&JointType; 4] = [
    &revolute::REVOLUTE,
    &continuous::CONTINUOUS,
    &prismatic::PRISMATIC,
    &fixed::FIXED,
];

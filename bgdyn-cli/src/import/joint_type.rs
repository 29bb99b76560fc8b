//! The joint types that an import can give a mechanism.

/// The motion of a joint.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum JointType {
    Revolute,
    Continuous,
    Prismatic,
    Helical,
    Fixed,
    Spherical,
    Floating,
    Planar,
}

impl JointType {
    /// The types of a table of Denavit–Hartenberg parameters.
    const TABLE: [JointType; 4] = [
        JointType::Revolute,
        JointType::Continuous,
        JointType::Prismatic,
        JointType::Fixed,
    ];

    /// Returns its keyword in a mechanism, which a URDF and a table use too.
    pub(super) fn keyword(self) -> &'static str {
        match self {
            JointType::Revolute => "revolute",
            JointType::Continuous => "continuous",
            JointType::Prismatic => "prismatic",
            JointType::Helical => "helical",
            JointType::Fixed => "fixed",
            JointType::Spherical => "spherical",
            JointType::Floating => "floating",
            JointType::Planar => "planar",
        }
    }

    /// Returns the type of this keyword in a table; `None` for other words.
    pub(super) fn of_table(keyword: &str) -> Option<Self> {
        let mut types = Self::TABLE.into_iter();
        types.find(|kind| kind.keyword() == keyword)
    }

    /// Returns the type of this keyword in a URDF; `None` for other words.
    pub(super) fn of_urdf(keyword: &str) -> Option<Self> {
        let moving = [JointType::Floating, JointType::Planar];
        let mut types = Self::TABLE.into_iter().chain(moving);
        types.find(|kind| kind.keyword() == keyword)
    }

    /// Returns whether it has one coordinate.
    pub(super) fn is_scalar(self) -> bool {
        matches!(
            self,
            JointType::Revolute | JointType::Continuous | JointType::Prismatic | JointType::Helical
        )
    }

    /// Returns whether the joint has an axis in a mechanism.
    pub(super) fn has_axis(self) -> bool {
        self.is_scalar()
    }

    /// Returns the endings that a mechanism adds to the joint's name for its positions and velocities; none
    /// for a joint with one coordinate.
    pub(super) fn endings(self) -> &'static [&'static str] {
        match self {
            JointType::Floating => &[
                "_x", "_y", "_z", "_qx", "_qy", "_qz", "_qw", "_rx", "_ry", "_rz",
            ],
            JointType::Spherical => &["_qx", "_qy", "_qz", "_qw", "_rx", "_ry", "_rz"],
            JointType::Planar => &["_x", "_y", "_turn"],
            _ => &[],
        }
    }
}

//! The joint types that a URDF and a mechanism have in common.

/// The motion of a joint.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum JointType {
    Revolute,
    Continuous,
    Prismatic,
    Fixed,
}

impl JointType {
    const ALL: [JointType; 4] = [
        JointType::Revolute,
        JointType::Continuous,
        JointType::Prismatic,
        JointType::Fixed,
    ];

    /// Returns its keyword in a URDF, a table and a mechanism.
    pub(super) fn keyword(self) -> &'static str {
        match self {
            JointType::Revolute => "revolute",
            JointType::Continuous => "continuous",
            JointType::Prismatic => "prismatic",
            JointType::Fixed => "fixed",
        }
    }

    /// Returns the type of this keyword; `None` for other words.
    pub(super) fn parse(keyword: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.keyword() == keyword)
    }
}

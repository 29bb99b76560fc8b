//! The joint types of a URDF that a mechanism has.

/// How a joint moves.
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

    /// The word for it in a URDF, a table and a mechanism.
    pub(super) fn keyword(self) -> &'static str {
        match self {
            JointType::Revolute => "revolute",
            JointType::Continuous => "continuous",
            JointType::Prismatic => "prismatic",
            JointType::Fixed => "fixed",
        }
    }

    /// The type of this keyword; none for other words.
    pub(super) fn parse(keyword: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.keyword() == keyword)
    }
}

//! Methods that return loads of loops, contacts and joints.

use super::Method;

impl Method {
    /// Returns whether its results are the loads through the joints of the tree of links.
    pub fn loads_joints(self) -> bool {
        matches!(
            self,
            Method::JointReactions | Method::ActuatedJointReactions(_)
        )
    }

    /// Returns whether it returns loads of loops or contacts, at these or at the joints.
    pub fn has_loads(self) -> bool {
        self.loads_joints() || matches!(self, Method::Reactions | Method::ActuatedReactions(_))
    }
}

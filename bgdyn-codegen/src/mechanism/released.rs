//! The prescribed joints of a mechanism, and the mechanism in which they are free.

use super::{Joint, LinkId, Mechanism, PrescribedJoint};

impl Mechanism {
    /// Returns the joints whose motion is given at run time, in the order of the links.
    pub fn prescribed(&self) -> &[PrescribedJoint] {
        &self.prescribed
    }

    /// Returns the joint of a prescribed one.
    pub fn prescribed_joint(&self, prescribed: &PrescribedJoint) -> &Joint {
        &self.links[prescribed.link.0].joint
    }

    /// Returns the names of the prescribed joints.
    pub fn prescribed_names(&self) -> Vec<String> {
        let name = |p: &PrescribedJoint| self.prescribed_joint(p).name.clone();
        self.prescribed.iter().map(name).collect()
    }

    /// Returns whether the motion of the joint of a link is given at run time.
    pub fn is_prescribed(&self, link: LinkId) -> bool {
        self.prescribed.iter().any(|p| p.link == link)
    }

    /// Returns the mechanism in which the prescribed joints are free.
    pub fn released(&self) -> Self {
        let mut released = self.clone();
        released.prescribed.clear();
        released.number();
        released
    }
}

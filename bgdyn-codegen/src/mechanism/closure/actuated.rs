//! The joints with drives.

use bgdyn_runtime::Dd;

use crate::mechanism::CoordinateId;

/// The joints with drives of a mechanism with loops, in the order of the velocities of the open tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Actuated {
    /// Their velocities in the open tree.
    pub joints: Vec<CoordinateId>,
    /// Their largest efforts, each over the largest of all; all 1 if one of the joints has no limit.
    pub efforts: Vec<Dd>,
}

impl Actuated {
    /// Returns Aᵀ, the rows of S that belong to the actuated joints: their velocities are Aᵀ u, and the efforts along
    /// the independent velocities A P.
    pub fn rows<T: Clone>(&self, map: &[Vec<T>]) -> Vec<Vec<T>> {
        self.joints.iter().map(|j| map[j.0].clone()).collect()
    }
}

//! Joints whose velocities follow from others through loops and contacts, in a scene's state.
//!
//! Their positions are part of the state, their velocities are not.

use super::{DependentJoint, StateLayout};

impl StateLayout {
    /// Returns the joint of this name whose velocity follows from others.
    pub fn dependent_named(&self, name: &str) -> Option<&DependentJoint> {
        self.dependents.iter().find(|joint| joint.name == name)
    }

    /// Returns the names of the positions that are not the integrals of single velocities.
    pub fn coupled_names(&self) -> Vec<&str> {
        let coupled = self.coupled().into_iter();
        coupled.map(|p| self.positions[p].name.as_str()).collect()
    }

    /// Returns whether the rates of positions need a function of the scene: those of joints in loops, and of joints
    /// whose velocity alone follows others.
    pub fn needs_position_rates(&self) -> bool {
        let of_quasi_joint = |p: &usize| {
            let mut joints = self.quasi_joints.iter();
            joints.any(|joint| joint.positions.contains(p))
        };
        !self.dependents.is_empty() || self.coupled().iter().any(|p| !of_quasi_joint(p))
    }
}

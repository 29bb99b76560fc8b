//! The velocities of a mechanism that follow from others through loops and contacts.

use super::{CoordinateId, Mechanism, PositionId};

/// A velocity of the open tree that follows from the independent ones.
#[derive(Clone, Debug, PartialEq)]
pub struct DependentVelocity {
    /// Its name, as in the open tree.
    pub name: String,
    /// Its index in the open tree.
    pub velocity: CoordinateId,
    /// The position whose rate it is; `None` for a velocity in link axes.
    pub position: Option<PositionId>,
    /// Whether its unit is m/s, not rad/s.
    pub linear: bool,
    /// The keyword of its joint's type.
    pub kind: &'static str,
    /// The loop or the contact from which it follows, by its index.
    pub closes: usize,
}

impl Mechanism {
    /// Returns the names of the actuated joints of a mechanism with loops, in the order of the open tree; none if its
    /// file names none.
    pub fn actuated_names(&self) -> Vec<String> {
        let Some(actuated) = self.closure().and_then(|closure| closure.actuated.as_ref()) else {
            return Vec::new();
        };
        let of_tree = self.open().joint_names();
        let joints = actuated.joints.iter();
        joints.map(|j| of_tree[j.0].clone()).collect()
    }

    /// Returns the velocities that follow from others, in the order of the open tree.
    pub fn dependent_velocities(&self) -> Vec<DependentVelocity> {
        let Some(closure) = self.closure() else {
            return vec![];
        };
        let open = self.open();
        let names = open.joint_names();
        let mut all: Vec<CoordinateId> = closure.dependents().collect();
        all.sort();
        let dependent = |j: CoordinateId| {
            let joint = open.joint(j);
            let part = joint.degrees.part(j).unwrap_or_default();
            let own = joint.kind.motion.velocity_positions().into_iter().nth(part);
            DependentVelocity {
                name: names[j.0].clone(),
                velocity: j,
                position: own.flatten().map(|p| joint.degrees.positions[p]),
                linear: open.linear(j),
                kind: joint.kind.keyword,
                closes: closure.loop_of(j),
            }
        };
        all.into_iter().map(dependent).collect()
    }
}

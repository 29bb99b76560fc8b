//! Joints that follow others in a scene's state: their motion is a sum over those.

use bgdyn_runtime::Dd;

use super::{StateFollower, StateLayout};
use crate::unit::Dimension;

impl StateLayout {
    /// Returns the joint of this name that follows others.
    pub fn follower_named(&self, name: &str) -> Option<&StateFollower> {
        self.followers.iter().find(|follower| follower.name == name)
    }

    /// Returns the dimensions of position, velocity and effort of a coordinate, or of a joint that follows others.
    pub fn dimensions_of(&self, name: &str) -> Option<[Dimension; 3]> {
        match self.coordinate_named(name) {
            Some(j) => Some(self.coordinates[j].dimensions),
            None => {
                let follower = self.follower_named(name).map(|f| f.dimensions);
                follower.or(self.dependent_named(name).map(|d| d.dimensions))
            }
        }
    }

    /// Returns the dimension of a coordinate's position; an angle if no coordinate has this name.
    pub fn position_of(&self, name: &str) -> Dimension {
        self.dimensions_of(name)
            .map_or(Dimension::Angle, |[position, ..]| position)
    }

    /// Returns position and velocity of a coordinate, or of a joint that follows others, in a state; the position only
    /// if it has one.
    pub fn motion_of(&self, name: &str, q: &[Dd], v: &[Dd]) -> Option<(Option<Dd>, Dd)> {
        let at = |j: usize| (self.coordinates[j].position.map(|p| q[p]), v[j]);
        if let Some(j) = self.coordinate_named(name) {
            return Some(at(j));
        }
        let follower = self.follower_named(name)?;
        let positions = follower.positions.iter();
        let position = positions.fold(follower.offset, |sum, &(p, ratio)| q[p] * ratio + sum);
        let leaders = follower.leaders.iter();
        let velocity = leaders.fold(Dd::ZERO, |sum, &(j, ratio)| v[j] * ratio + sum);
        Some((Some(position), velocity))
    }

    /// Returns whose `motion` (slip, rate) a contact of this joint has, in words: its own, or that of its leader.
    pub fn motion_in_words(&self, joint: &str, motion: &str) -> String {
        match self
            .follower_named(joint)
            .map(|follower| &follower.leaders[..])
        {
            Some([(leader, _)]) => {
                let leader = &self.coordinates[*leader].name;
                format!("the {motion} of `{leader}`")
            }
            _ => format!("its {motion}"),
        }
    }
}

//! The type of a joint: its word in the spec, and the motion that it allows.

use super::compound::CompoundMotion;

/// The motion that a joint allows in the equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// None: the link is welded to its parent.
    None,
    /// Rotation about the axis by the coordinate, in radians.
    Rotation,
    /// Translation along the axis by the coordinate, in metres.
    Translation,
    /// Any other motion, described by its steps and its motion subspace.
    Compound(&'static CompoundMotion),
}

impl Motion {
    /// Returns the unit of the coordinate of a joint with one; "none" for other motions.
    pub fn unit(self) -> &'static str {
        match self {
            Motion::Rotation => "rad",
            Motion::Translation => "m",
            Motion::None | Motion::Compound(_) => "none",
        }
    }

    /// Returns the number of positions.
    pub fn nq(self) -> usize {
        match self {
            Motion::None => 0,
            Motion::Rotation | Motion::Translation => 1,
            Motion::Compound(motion) => motion.positions.len(),
        }
    }

    /// Returns the number of velocities.
    pub fn nv(self) -> usize {
        match self {
            Motion::None => 0,
            Motion::Rotation | Motion::Translation => 1,
            Motion::Compound(motion) => motion.velocities.len(),
        }
    }

    /// Returns, for each velocity, the index of the position whose rate it is; `None` for a quasi-velocity.
    pub fn velocity_positions(self) -> Vec<Option<usize>> {
        match self {
            Motion::Compound(motion) if !motion.manifold.is_empty() => {
                // The angle of a planar joint is the only position of such joints with a velocity as rate.
                let own = |suffix: &str| {
                    let mut all = motion.positions.iter();
                    all.position(|p| p.unit == "rad" && p.suffix == suffix)
                };
                motion.velocities.iter().map(|v| own(v.suffix)).collect()
            }
            _ => (0..self.nv()).map(Some).collect(),
        }
    }

    /// Returns whether it is a motion that is given at run time: that of a base, or of a prescribed joint.
    pub fn is_given(self) -> bool {
        matches!(self, Motion::Compound(motion) if motion.velocities.is_empty())
    }

    /// Returns whether the motion has an axis.
    pub fn has_axis(self) -> bool {
        match self {
            Motion::None => false,
            Motion::Rotation | Motion::Translation => true,
            Motion::Compound(motion) => motion.axial,
        }
    }
}

/// A word for a joint's `type` in the spec, and its meaning.
#[derive(Debug, PartialEq, Eq)]
pub struct JointType {
    /// The word in the spec.
    pub keyword: &'static str,
    /// The motion it allows; for a chain that of its last member.
    pub motion: Motion,
    /// Whether it can have `lower` and `upper` limits.
    pub position_limits: bool,
    /// For a joint that is two joints in series with a massless link between them: both, from the parent
    /// outward. Empty for any other joint.
    pub chain: &'static [ChainMember],
}

/// A joint of a chain.
#[derive(Debug, PartialEq, Eq)]
pub struct ChainMember {
    /// The end of its name, after the name of the whole joint and `_`; its key in `limits`.
    pub suffix: &'static str,
    /// Its type.
    pub kind: &'static JointType,
    /// Whether its axis is `axis2`.
    pub second_axis: bool,
}

impl JointType {
    /// Returns whether the joint has one velocity, so that it can mimic and be mimicked.
    pub fn one_degree(&self) -> bool {
        self.chain.is_empty() && self.motion.nv() == 1
    }

    /// Returns the ends of the names of its velocities and positions, each once; a single one has the
    /// joint's name.
    pub fn suffixes(&self) -> Vec<&'static str> {
        match self.motion {
            _ if !self.chain.is_empty() => self.chain.iter().map(|m| m.suffix).collect(),
            Motion::Compound(motion) if motion.velocities.len() > 1 => {
                let velocities = motion.velocities.iter().map(|v| v.suffix);
                let mut all: Vec<&str> = velocities.collect();
                let positions = motion.positions.iter().map(|p| p.suffix);
                all.extend(positions.filter(|p| motion.velocities.iter().all(|v| v.suffix != *p)));
                all
            }
            _ => Vec::new(),
        }
    }
}

//! The positions and velocities of a joint.

use bgdyn_runtime::Dd;

use super::id::{CoordinateId, LinkId, PositionId};
use super::joint::{Column, JointConstants, Motion};
use crate::math::Vec3;

/// The positions and velocities of a joint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Degrees {
    /// Its positions; those of the leader for a joint with `mimic`.
    pub positions: Vec<PositionId>,
    /// Its velocities; those of the leader for a joint with `mimic`.
    pub velocities: Vec<CoordinateId>,
    /// The leader, for a joint with `mimic`.
    pub mimic: Option<Mimic>,
    /// Advance along the axis of a helical joint, m/rad.
    pub advance: Dd,
    /// Whether its quaternion may have any length.
    pub any_length: bool,
}

/// The relation of a joint to another: position = ratio · q + offset, velocity = ratio · v.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mimic {
    /// The link of the other joint.
    pub leader: LinkId,
    /// Units of this joint per unit of the other.
    pub ratio: Dd,
    /// Position where the other joint's position is zero.
    pub offset: Dd,
}

impl Degrees {
    /// Returns the constants of the motion of a joint with this axis.
    pub fn constants(&self, axis: Vec3<Dd>) -> JointConstants {
        JointConstants {
            axis,
            advance: self.advance,
            any_length: self.any_length,
        }
    }

    /// Returns the columns of the motion subspace by coordinate, in link axes at the link's origin. For a
    /// joint with `mimic` they are per unit velocity of the leader.
    pub fn columns(&self, motion: Motion, axis: Vec3<Dd>) -> Vec<(CoordinateId, Column<Dd>)> {
        let zero = Vec3([Dd::ZERO; 3]);
        let own = match motion {
            Motion::None => Vec::new(),
            Motion::Rotation => vec![Column {
                angular: axis,
                linear: zero,
            }],
            Motion::Translation => vec![Column {
                angular: zero,
                linear: axis,
            }],
            Motion::Compound(compound) => compound.columns(&self.constants(axis)),
        };
        let ratio = self.mimic.map_or(Dd::ONE, |mimic| mimic.ratio);
        let scaled = own.into_iter().map(|column| Column {
            angular: column.angular.scale(ratio),
            linear: column.linear.scale(ratio),
        });
        self.velocities.iter().copied().zip(scaled).collect()
    }
}

impl Degrees {
    /// Returns the column of a motion about and along an axis, as factors of the axis: rad and m per unit
    /// velocity. `None` for other motions.
    pub fn axial(&self, motion: Motion) -> Option<(CoordinateId, [Dd; 2])> {
        let ratio = self.mimic.map_or(Dd::ONE, |mimic| mimic.ratio);
        let factors = match motion {
            Motion::Rotation => [ratio, Dd::ZERO],
            Motion::Translation => [Dd::ZERO, ratio],
            Motion::Compound(compound) if compound.axial => [ratio, ratio * self.advance],
            Motion::None | Motion::Compound(_) => return None,
        };
        Some((*self.velocities.first()?, factors))
    }
}

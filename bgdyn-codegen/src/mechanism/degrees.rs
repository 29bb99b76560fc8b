//! The positions and velocities of a joint.

use bgdyn_runtime::Dd;

use super::id::{CoordinateId, LinkId, PositionId};
use super::joint::{Column, JointConstants, Motion};
use crate::math::Vec3;

/// The positions and velocities of a joint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Degrees {
    /// Its positions; those of the joints it follows if its coupling has such.
    pub positions: Vec<PositionId>,
    /// Its velocities; those of the joints it follows if it is coupled.
    pub velocities: Vec<CoordinateId>,
    /// Its relation to other joints: `mimic`, or a constraint with constant coefficients.
    pub coupling: Option<Coupling>,
    /// Those of its velocities, by their index in its motion, that follow from those of other joints through loops or
    /// contacts.
    pub dependent: Vec<usize>,
    /// Advance along the axis of a helical joint, m/rad.
    pub advance: Dd,
    /// Whether its quaternion may have any length.
    pub any_length: bool,
}

/// A joint that another one follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leader {
    /// The link of the joint that is followed.
    pub link: LinkId,
    /// Units of the follower per unit of this joint.
    pub ratio: Dd,
}

/// The relation of a joint with one degree of freedom to others: position = Σ ratio · q + offset,
/// velocity = Σ ratio · v.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupling {
    /// The joints that its position follows; empty if it has a position of its own.
    pub positions: Vec<Leader>,
    /// Its position where those of the joints it follows are zero.
    pub offset: Dd,
    /// The joints that its velocity follows.
    pub velocities: Vec<Leader>,
}

impl Coupling {
    /// Returns the relation to one joint: position = ratio · q + offset.
    pub fn single(leader: Leader, offset: Dd) -> Self {
        Coupling {
            positions: vec![leader],
            offset,
            velocities: vec![leader],
        }
    }

    /// Returns whether the joint has no position of its own.
    pub fn of_positions(&self) -> bool {
        !self.positions.is_empty()
    }
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

    /// Returns whether it has positions of its own.
    pub fn own_positions(&self) -> bool {
        !self.coupling.as_ref().is_some_and(Coupling::of_positions)
    }

    /// Returns whether it has velocities of its own, at least one.
    pub fn own_velocities(&self) -> bool {
        self.coupling.is_none() && (self.dependent.is_empty() || !self.velocities.is_empty())
    }

    /// Returns whether some of its velocities are its own, and others follow from those of other joints.
    pub fn partly_dependent(&self) -> bool {
        !self.dependent.is_empty() && !self.velocities.is_empty()
    }

    /// Returns the index in its motion of a velocity of its own.
    pub fn part(&self, j: CoordinateId) -> Option<usize> {
        let own = self.velocities.iter().position(|known| *known == j)?;
        let all = 0..own + 1 + self.dependent.len();
        all.filter(|k| !self.dependent.contains(k)).nth(own)
    }

    /// Returns the factors from [`Degrees::positions`] to the position of a joint with one.
    pub fn position_ratios(&self) -> Vec<Dd> {
        let coupling = self.coupling.as_ref().filter(|c| c.of_positions());
        coupling.map_or(vec![Dd::ONE], |c| ratios(&c.positions))
    }

    /// Returns the position of a joint with one where [`Degrees::positions`] are zero.
    pub fn offset(&self) -> Dd {
        self.coupling.as_ref().map_or(Dd::ZERO, |c| c.offset)
    }

    /// Returns the factors from [`Degrees::velocities`] to the velocity of a joint with one.
    pub fn velocity_ratios(&self) -> Vec<Dd> {
        let coupling = self.coupling.as_ref();
        coupling.map_or(vec![Dd::ONE], |c| ratios(&c.velocities))
    }

    /// Returns the joint's positions, from the values of [`Degrees::positions`].
    pub fn positions_of(&self, value: impl Fn(&PositionId) -> Dd) -> Vec<Dd> {
        let values: Vec<Dd> = self.positions.iter().map(value).collect();
        match &self.coupling {
            None => values,
            Some(_) => vec![weighted(&values, &self.position_ratios(), self.offset())],
        }
    }

    /// Returns the joint's velocities, from the values of [`Degrees::velocities`].
    pub fn velocities_of(&self, value: impl Fn(&CoordinateId) -> Dd) -> Vec<Dd> {
        let values: Vec<Dd> = self.velocities.iter().map(value).collect();
        match &self.coupling {
            None => values,
            Some(_) => vec![weighted(&values, &self.velocity_ratios(), Dd::ZERO)],
        }
    }

    /// Returns the columns of the motion subspace by coordinate, in link axes at the link's origin. For a
    /// coupled joint they are per unit velocity of the joints that it follows.
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
        let velocities = self.velocities.iter().copied();
        let kept =
            |(k, column): (usize, Column<Dd>)| (!self.dependent.contains(&k)).then_some(column);
        let own: Vec<Column<Dd>> = own.into_iter().enumerate().filter_map(kept).collect();
        match (&self.coupling, own.as_slice()) {
            (Some(_), [column]) => {
                let scaled = self.velocity_ratios().into_iter().map(|ratio| Column {
                    angular: column.angular.scale(ratio),
                    linear: column.linear.scale(ratio),
                });
                velocities.zip(scaled).collect()
            }
            _ => velocities.zip(own).collect(),
        }
    }
}

impl Degrees {
    /// Returns the columns of a motion about and along an axis, as factors of the axis: rad and m per unit
    /// velocity. `None` for other motions.
    pub fn axial(&self, motion: Motion) -> Option<Vec<(CoordinateId, [Dd; 2])>> {
        let [angular, linear] = match motion {
            Motion::Rotation => [Dd::ONE, Dd::ZERO],
            Motion::Translation => [Dd::ZERO, Dd::ONE],
            Motion::Compound(compound) if compound.axial => [Dd::ONE, self.advance],
            Motion::None | Motion::Compound(_) => return None,
        };
        let velocities = self.velocities.iter().copied();
        let scaled = self.velocity_ratios().into_iter();
        Some(
            velocities
                .zip(scaled.map(|r| [r * angular, r * linear]))
                .collect(),
        )
    }
}

/// Returns Σ ratio · value + offset.
fn weighted(values: &[Dd], ratios: &[Dd], offset: Dd) -> Dd {
    let terms = values.iter().zip(ratios);
    terms.fold(offset, |sum, (x, ratio)| *ratio * *x + sum)
}

fn ratios(leaders: &[Leader]) -> Vec<Dd> {
    leaders.iter().map(|leader| leader.ratio).collect()
}

//! The directions in which coordinates move the bodies, carried from the base to the tips.
//!
//! A coordinate moves body i with the angular velocity z and the velocity w of its origin, in the axes of the body.
//! From the parent to the body: z' = Rᵀ z, w' = Rᵀ (w + z × p), with the origin p and the axes R of the body.

use bgdyn_runtime::Dd;

use super::super::frames::{BodyFrame, Frames};
use super::super::inverse_dynamics::BodyWrench;
use super::super::joint_columns::{ColumnDirection, JointColumn};
use super::super::motion::zero;
use crate::expr::{Builder, Expr};
use crate::math::Vec3;
use crate::mechanism::joint::Column;

/// An angular velocity and the velocity of a body's origin, in the axes of the body.
#[derive(Clone, Copy)]
pub(super) struct BodyTwist<'g> {
    /// ω, or z.
    pub angular: Vec3<Expr<'g>>,
    /// u, or w.
    pub linear: Vec3<Expr<'g>>,
}

impl<'g> From<&Column<Expr<'g>>> for BodyTwist<'g> {
    fn from(column: &Column<Expr<'g>>) -> Self {
        BodyTwist {
            angular: column.angular,
            linear: column.linear,
        }
    }
}

impl<'g> BodyTwist<'g> {
    fn zero(b: &'g Builder) -> Self {
        BodyTwist {
            angular: zero(b),
            linear: zero(b),
        }
    }

    fn plus(self, other: Self) -> Self {
        BodyTwist {
            angular: self.angular + other.angular,
            linear: self.linear + other.linear,
        }
    }

    /// Returns the power of a wrench per unit of the velocity: z · N + w · F.
    pub fn component(&self, wrench: &BodyWrench<'g>) -> Expr<'g> {
        self.angular.dot(wrench.moment) + self.linear.dot(wrench.force)
    }

    /// Returns the twist of a body from that of its parent, without its joint.
    fn outwards(&self, b: &'g Builder, frame: &BodyFrame<'g>) -> Self {
        let back = frame.twist.transpose().map(|x| b.constant(x));
        let angular = back * self.angular;
        let linear = back * self.linear + angular.cross(frame.position);
        BodyTwist {
            angular: frame.turn.apply_back(angular),
            linear: frame.turn.apply_back(linear),
        }
    }

    /// Returns the twist of a body for a rate of one of its joint's velocities.
    fn of_column(b: &'g Builder, column: &JointColumn, rate: Expr<'g>) -> Self {
        let mut twist = BodyTwist::zero(b);
        match column.direction {
            ColumnDirection::About(k) => twist.angular.0[k] = rate,
            ColumnDirection::Along(k) => twist.linear.0[k] = rate,
            ColumnDirection::Screw(pitch) => {
                twist.angular.0[2] = rate;
                twist.linear.0[2] = rate * pitch;
            }
        }
        twist
    }
}

/// The direction in which a coordinate moves a body.
#[derive(Clone, Copy)]
pub(super) struct CoordinateDirection<'g> {
    /// Index of the coordinate.
    pub coordinate: usize,
    /// The twist per unit of the velocity, without the factor.
    pub twist: BodyTwist<'g>,
    /// The factor: −1 where the body's axis is opposite to the joint's.
    pub factor: Dd,
}

/// Returns, for each body, the directions of the coordinates that move it, from the base outwards.
pub(super) fn directions<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
) -> Vec<Vec<CoordinateDirection<'g>>> {
    let mut all: Vec<Vec<CoordinateDirection<'g>>> = Vec::new();
    for frame in &frames.bodies {
        b.section(|| format!("{}: directions in which joints move it", frame.name));
        let inboard = frame.parent.map_or_else(Vec::new, |p| all[p].clone());
        let carried = inboard.into_iter().map(|direction| CoordinateDirection {
            twist: direction.twist.outwards(b, frame),
            ..direction
        });
        let mut found: Vec<CoordinateDirection<'g>> = carried.collect();
        for column in &frame.columns {
            let own = CoordinateDirection {
                coordinate: column.coordinate,
                twist: BodyTwist::of_column(b, column, b.number(1.0)),
                factor: column.effort,
            };
            add(b, &mut found, own);
        }
        all.push(found);
    }
    all
}

/// Adds a direction to that of the same coordinate, which also moves joints that follow it.
fn add<'g>(b: &'g Builder, found: &mut Vec<CoordinateDirection<'g>>, own: CoordinateDirection<'g>) {
    let same = found.iter_mut().find(|d| d.coordinate == own.coordinate);
    let Some(other) = same else {
        found.push(own);
        return;
    };
    let scaled = |direction: &CoordinateDirection<'g>| {
        let factor = b.constant(direction.factor);
        BodyTwist {
            angular: direction.twist.angular.scale(factor),
            linear: direction.twist.linear.scale(factor),
        }
    };
    *other = CoordinateDirection {
        twist: scaled(other).plus(scaled(&own)),
        factor: Dd::ONE,
        ..own
    };
}

/// Returns the twist of a body relative to its parent, for these rates of the coordinates.
pub(super) fn of_joint<'g>(
    b: &'g Builder,
    frame: &BodyFrame<'g>,
    rates: &[Expr<'g>],
) -> BodyTwist<'g> {
    let columns = frame.columns.iter();
    let of = |column: &JointColumn| {
        BodyTwist::of_column(b, column, rates[column.coordinate] * column.effort)
    };
    columns.map(of).fold(BodyTwist::zero(b), BodyTwist::plus)
}

/// Returns the twist of each body for these rates of the coordinates, and the velocity `given` of a body.
pub(super) fn twists<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    rates: &[Expr<'g>],
    given: impl Fn(&BodyFrame<'g>) -> Option<BodyTwist<'g>>,
) -> Vec<BodyTwist<'g>> {
    let mut all: Vec<BodyTwist<'g>> = Vec::new();
    for frame in &frames.bodies {
        b.section(|| format!("{}: ω and the velocity u of its origin", frame.name));
        let carried = frame
            .parent
            .map_or_else(|| BodyTwist::zero(b), |p| all[p].outwards(b, frame));
        let own = given(frame).unwrap_or_else(|| of_joint(b, frame, rates));
        all.push(carried.plus(own));
    }
    all
}

//! The velocities of a body's joint, and the components of wrenches and momenta in their directions.

use bgdyn_runtime::Dd;

use super::geometry::Body;
use crate::bond_graph::LinkFrame;
use crate::expr::Expr;
use crate::math::Vec3;
use crate::mechanism::Motion;
use crate::mechanism::joint::Twist;

/// The direction of a column of a motion subspace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ColumnDirection {
    /// About an axis of the frame.
    About(usize),
    /// Along an axis of the frame.
    Along(usize),
    /// About z, and this far along z per radian.
    Screw(Dd),
}

impl ColumnDirection {
    /// Returns the component of a moment and a force, or of an angular and a linear momentum.
    pub fn component<'g>(self, angular: Vec3<Expr<'g>>, linear: Vec3<Expr<'g>>) -> Expr<'g> {
        match self {
            ColumnDirection::About(k) => angular.0[k],
            ColumnDirection::Along(k) => linear.0[k],
            ColumnDirection::Screw(pitch) => angular.0[2] + linear.0[2] * pitch,
        }
    }
}

/// A column of the motion subspace of a body's joint: in the axes of the basis for a joint with an axis,
/// in the body's own axes for others.
#[derive(Clone, Debug)]
pub(super) struct JointColumn {
    /// The velocity: index of its coordinate.
    pub coordinate: usize,
    /// Name of the coordinate.
    pub name: String,
    /// Its direction.
    pub direction: ColumnDirection,
    /// Factor from the component in that direction to the joint's effort, and from the velocity to the
    /// rate in that direction.
    pub effort: Dd,
    /// Whether the joint follows others.
    pub follows: bool,
}

/// Returns the columns of a body's joint; `unit` is the unit of length of the plan.
pub(super) fn joint_columns(
    body: &Body,
    frame: &LinkFrame,
    names: impl Fn(usize) -> String,
    unit: Dd,
) -> Vec<JointColumn> {
    let sign = if body.opposite { -Dd::ONE } else { Dd::ONE };
    let ratios = frame.degrees.velocity_ratios();
    let each = |direction: ColumnDirection, factor: Dd| -> Vec<(ColumnDirection, Dd)> {
        let scaled = ratios.iter().map(|&ratio| (direction, factor * ratio));
        scaled.collect()
    };
    let per_length = Dd::ONE / unit;
    let pitch = frame.degrees.advance * per_length;
    let directions: Vec<(ColumnDirection, Dd)> = match body.motion {
        Motion::None => Vec::new(),
        Motion::Rotation => each(ColumnDirection::About(2), sign),
        Motion::Translation => each(ColumnDirection::Along(2), sign * per_length),
        Motion::Compound(motion) => (motion.velocities.iter())
            .flat_map(|part| match part.twist {
                Twist::Linear(k) => vec![(ColumnDirection::Along(k), per_length)],
                Twist::Angular(k) => vec![(ColumnDirection::About(k), Dd::ONE)],
                Twist::Screw => each(ColumnDirection::Screw(pitch), sign),
            })
            .collect(),
    };
    let velocities = frame.degrees.velocities.iter().zip(directions);
    velocities
        .map(|(j, (direction, effort))| JointColumn {
            coordinate: j.0,
            name: names(j.0),
            direction,
            effort,
            follows: !frame.degrees.own_velocities(),
        })
        .collect()
}

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
    /// Whether the joint mimics another one.
    pub mimics: bool,
}

/// Returns the columns of a body's joint; `unit` is the unit of length of the plan.
pub(super) fn joint_columns(
    body: &Body,
    frame: &LinkFrame,
    names: impl Fn(usize) -> String,
    unit: Dd,
) -> Vec<JointColumn> {
    let sign = if body.opposite { -Dd::ONE } else { Dd::ONE };
    let ratio = frame.degrees.mimic.map_or(Dd::ONE, |mimic| mimic.ratio);
    let per_length = Dd::ONE / unit;
    let pitch = frame.degrees.advance * per_length;
    let directions: Vec<(ColumnDirection, Dd)> = match body.motion {
        Motion::None => Vec::new(),
        Motion::Rotation => vec![(ColumnDirection::About(2), sign * ratio)],
        Motion::Translation => vec![(ColumnDirection::Along(2), sign * ratio * per_length)],
        Motion::Compound(motion) => (motion.velocities.iter())
            .map(|part| match part.twist {
                Twist::Linear(k) => (ColumnDirection::Along(k), per_length),
                Twist::Angular(k) => (ColumnDirection::About(k), Dd::ONE),
                Twist::Screw => (ColumnDirection::Screw(pitch), sign * ratio),
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
            mimics: frame.degrees.mimic.is_some(),
        })
        .collect()
}

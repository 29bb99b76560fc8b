//! Poses of the link frames: A_i(q), their origins and the joints' axes, in fixed axes.

use bgdyn_runtime::Dd;

use super::joint_motion::joint_positions;
use crate::bond_graph::{LinkFrame, Multibody};
use crate::expr::{Builder, Expr};
use crate::math::{Mat3, Vec3, rodrigues};
use crate::mechanism::joint::Column;
use crate::mechanism::{CoordinateId, LinkId, Motion};

/// Pose of every link frame.
pub(super) struct Placement<'g> {
    /// A_i: link axes in fixed axes.
    pub(super) rotations: Vec<Mat3<Expr<'g>>>,
    /// Origins of the link frames, m.
    pub(super) origins: Vec<Vec3<Expr<'g>>>,
    /// Unit vectors of the joints' axes.
    pub(super) axes: Vec<Vec3<Expr<'g>>>,
}

impl<'g> Placement<'g> {
    /// Computes the poses from the base to the tips.
    pub(super) fn new(b: &'g Builder, graph: &Multibody, q: &[Expr<'g>]) -> Self {
        let mut placed = Placement {
            rotations: Vec::new(),
            origins: Vec::new(),
            axes: Vec::new(),
        };
        for frame in &graph.frames {
            let mut rotation = frame.origin.rotation.map(|x| b.constant(x));
            let mut origin = b.vector(frame.origin.translation);
            if let Some(LinkId(p)) = frame.parent {
                origin = placed.point(p, origin);
                rotation = placed.rotations[p] * rotation;
            }
            let axis = rotation * b.vector(frame.axis);
            let own = joint_positions(b, frame, q);
            match frame.motion {
                Motion::None => {}
                Motion::Rotation => {
                    let angle = b.cos_sin(&own, Dd::ZERO);
                    rotation = rotation * rodrigues(frame.axis, angle, |x| b.constant(x));
                }
                Motion::Translation => origin = origin + axis.scale(own[0]),
                Motion::Compound(motion) => {
                    let (turned, shift) = motion.pose(&frame.constants(), &own, &b);
                    origin = origin + rotation * shift;
                    rotation = rotation * turned;
                }
            }
            placed.rotations.push(rotation);
            placed.origins.push(origin);
            placed.axes.push(axis);
        }
        placed
    }

    /// Returns axes and origin of a link; those of the world for `None`.
    pub(super) fn pose(
        &self,
        b: &'g Builder,
        link: Option<LinkId>,
    ) -> (Mat3<Expr<'g>>, Vec3<Expr<'g>>) {
        match link {
            Some(LinkId(i)) => (self.rotations[i], self.origins[i]),
            None => {
                let identity = |i, j| b.number(if i == j { 1.0 } else { 0.0 });
                (Mat3::from_fn(identity), Vec3([b.zero(); 3]))
            }
        }
    }

    /// Returns the columns of the motion subspace of link i's joint in fixed axes, at the link's origin.
    pub(super) fn columns(
        &self,
        b: &'g Builder,
        i: usize,
        frame: &LinkFrame,
    ) -> Vec<(CoordinateId, Column<Expr<'g>>)> {
        // The joint's own rotation does not change its axis.
        if let Some(columns) = frame.degrees.axial(frame.motion) {
            let of = |(j, factors): (CoordinateId, [Dd; 2])| {
                let [angular, linear] = factors.map(|k| self.axes[i].scale(b.constant(k)));
                (j, Column { angular, linear })
            };
            return columns.into_iter().map(of).collect();
        }
        let fixed = |v: Vec3<Dd>| self.rotations[i] * b.vector(v);
        let of = |(j, column): (CoordinateId, Column<Dd>)| {
            let (angular, linear) = (fixed(column.angular), fixed(column.linear));
            (j, Column { angular, linear })
        };
        frame.columns().into_iter().map(of).collect()
    }

    /// Returns a point of link i, given in its axes.
    pub(super) fn point(&self, i: usize, p: Vec3<Expr<'g>>) -> Vec3<Expr<'g>> {
        self.origins[i] + self.rotations[i] * p
    }
}

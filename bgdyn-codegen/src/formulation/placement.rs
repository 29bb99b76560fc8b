//! Poses of the link frames: A_i(q), their origins and the joints' axes, in fixed axes.

use bgdyn_runtime::Dd;

use crate::bond_graph::Multibody;
use crate::expr::{Builder, Expr};
use crate::math::{Mat3, Vec3, rodrigues};
use crate::mechanism::{LinkId, Motion};

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
            match (frame.motion, frame.coordinate) {
                (Motion::Rotation, Some(j)) => {
                    let angle = b.cos_sin(&[q[j.0]], Dd::ZERO);
                    rotation = rotation * rodrigues(frame.axis, angle, |x| b.constant(x));
                }
                (Motion::Translation, Some(j)) => origin = origin + axis.scale(q[j.0]),
                _ => {}
            }
            placed.rotations.push(rotation);
            placed.origins.push(origin);
            placed.axes.push(axis);
        }
        placed
    }

    /// Returns a point of link i, given in its axes.
    pub(super) fn point(&self, i: usize, p: Vec3<Expr<'g>>) -> Vec3<Expr<'g>> {
        self.origins[i] + self.rotations[i] * p
    }
}

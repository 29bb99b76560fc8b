//! Vectors of the bodies' axes in the world.

use super::super::frames::Frames;
use crate::expr::{Builder, Expr};
use crate::math::{Mat3, Vec3};

/// The axes in which a vector of a body is given.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum BodyAxes {
    /// Those of its basis.
    Basis,
    /// Its own.
    Own,
}

/// The axes of the bodies in the world.
pub(super) struct World<'a, 'g> {
    b: &'g Builder,
    frames: &'a Frames<'g>,
    /// Basis and own axes of each body.
    axes: Vec<(Mat3<Expr<'g>>, Mat3<Expr<'g>>)>,
    /// Number of joints from the base to each body.
    joints: Vec<usize>,
    /// The number of joints across which vectors are rotated one by one.
    one_by_one: usize,
}

impl<'a, 'g> World<'a, 'g> {
    pub fn new(b: &'g Builder, frames: &'a Frames<'g>, one_by_one: usize) -> Self {
        let mut axes: Vec<(Mat3<Expr<'g>>, Mat3<Expr<'g>>)> = Vec::new();
        let mut joints: Vec<usize> = Vec::new();
        for frame in &frames.bodies {
            b.section(|| format!("{}: its axes in the world", frame.name));
            let parent = frame.parent.map(|p| (&axes[p].0, &axes[p].1));
            let basis = frame.basis_in_world(b, parent);
            axes.push((basis, frame.turn.own_axes(&basis)));
            joints.push(1 + frame.parent.map_or(0, |p| joints[p]));
        }
        World {
            b,
            frames,
            axes,
            joints,
            one_by_one,
        }
    }

    /// Returns a vector of body j in the world.
    pub fn of(&self, j: usize, axes: BodyAxes, v: Vec3<Expr<'g>>) -> Vec3<Expr<'g>> {
        if self.joints[j] > self.one_by_one {
            return match axes {
                BodyAxes::Basis => self.axes[j].0 * v,
                BodyAxes::Own => self.axes[j].1 * v,
            };
        }
        let frame = &self.frames.bodies[j];
        let in_basis = match axes {
            BodyAxes::Basis => v,
            BodyAxes::Own => frame.turn.apply(v),
        };
        match frame.parent {
            Some(p) if frame.continues => self.of(p, BodyAxes::Basis, in_basis),
            parent => {
                let twisted = frame.twist.map(|x| self.b.constant(x)) * in_basis;
                parent.map_or(twisted, |p| self.of(p, BodyAxes::Own, twisted))
            }
        }
    }
}

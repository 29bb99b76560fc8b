//! What rigid contacts add to the sums: nothing on the junctions, but rows for the integrator.

use super::EffortSums;
use super::contact_motion::ContactMotion;
use crate::expr::Expr;
use crate::math::Vec3;

/// A rigid contact: its state and the rows of its Jacobian, along (x, y, normal).
#[derive(Clone, Debug)]
pub struct RigidRows<'g> {
    /// The index of its element.
    pub element: usize,
    /// g, m.
    pub gap: Expr<'g>,
    /// γ, m/s.
    pub velocity: [Expr<'g>; 3],
    /// μ
    pub friction: Expr<'g>,
    /// e
    pub restitution: Expr<'g>,
    /// The contact point, world axes.
    pub point: Vec3<Expr<'g>>,
    /// The directions x, y and normal, world axes.
    pub axes: [Vec3<Expr<'g>>; 3],
    /// ∂γ/∂v, for each coordinate of the links.
    pub rows: [Vec<Expr<'g>>; 3],
}

impl<'g> EffortSums<'g, '_> {
    /// Adds a rigid contact with these coefficients of friction and restitution.
    pub fn touch(&mut self, motion: &ContactMotion<'g>, friction: Expr<'g>, restitution: Expr<'g>) {
        let [x, y] = motion.along.unwrap_or_else(|| motion.tangents(self.b));
        let axes = [x, y, motion.normal];
        let columns = self.columns_of_contact(motion);
        self.rigid.push(RigidRows {
            element: self.at,
            gap: motion.gap,
            velocity: [x.dot(motion.slip), y.dot(motion.slip), motion.rate],
            friction,
            restitution,
            point: motion.point,
            axes,
            rows: axes.map(|axis| columns.iter().map(|&column| axis.dot(column)).collect()),
        });
    }

    /// Returns the rigid contacts, in the order of the elements.
    pub fn rigid_contacts(&self) -> &[RigidRows<'g>] {
        &self.rigid
    }
}

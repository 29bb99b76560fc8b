//! What rigid contacts add to the sums: nothing on the junctions, but rows for the integrator.

use super::EffortSums;
use super::contact_motion::ContactMotion;
use super::parts::RigidRows;
use crate::expr::Expr;

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

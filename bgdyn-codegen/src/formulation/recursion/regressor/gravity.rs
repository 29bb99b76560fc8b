//! Potential energy by the parameters of the bodies: V = −g · (m o + R h).

use super::base_parameter::bodies;
use super::columns::Columns;
use crate::expr::Expr;
use crate::math::Vec3;

impl<'g> Columns<'_, 'g> {
    /// Returns the potential energies of ones in the places of the parameters: gravity is carried into the axes of each
    /// body, and −g · o from origin to origin.
    pub(super) fn potential_energies(&self) -> Vec<Expr<'g>> {
        let b = self.b;
        // −g · o of each body, and gravity in its axes.
        let mut at: Vec<(Expr<'g>, Vec3<Expr<'g>>)> = Vec::new();
        for (j, frame) in self.frames.bodies.iter().enumerate() {
            let (height, gravity) = match frame.parent {
                None => {
                    let gravity = self.frames.gravity[j];
                    let offset = b.vector(self.geometry.bodies[j].offset);
                    (-gravity.dot(offset), gravity)
                }
                Some(p) => {
                    let back = frame.twist.transpose().map(|x| b.constant(x));
                    (at[p].0, back * at[p].1)
                }
            };
            let height = height - gravity.dot(frame.position);
            at.push((height, frame.turn.apply_back(gravity)));
        }
        let zero = b.zero();
        let of = |body: usize| {
            let (height, gravity) = at[body];
            let [x, y, z] = gravity.0.map(|g| -g);
            let own = [height, x, y, z, zero, zero, zero, zero, zero, zero];
            self.in_link_axes(body, &own.map(|energy| vec![energy]))
        };
        let bodies = bodies(self.graph, self.geometry).into_iter();
        bodies.flat_map(of).flatten().collect()
    }
}

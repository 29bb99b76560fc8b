//! The mass matrix from the momenta of composite bodies; potential energy from their first moments.

use super::bodies::Bodies;
use super::inertia::Inertia;
use crate::expr::Expr;
use crate::formulation::arguments::reflected;
use crate::math::Vec3;

impl<'g> Bodies<'_, 'g> {
    /// Returns the lower triangle of M. Entry (j, k) is the momentum of the composite body beyond joint j
    /// for a unit velocity j, along column k of a joint on the path to the base.
    pub(super) fn mass_matrix(&self) -> Vec<Vec<Expr<'g>>> {
        let b = self.b;
        let n = self.graph.coordinates.len();
        let mut mass: Vec<Vec<Expr<'g>>> = (0..n).map(|j| vec![b.zero(); j + 1]).collect();
        let composites = self.composites();
        for (i, body) in self.bodies.iter().enumerate() {
            let composite = &composites[i];
            for (index, (j, s)) in body.columns.iter().enumerate() {
                // p = m s + s × h, L = J s + h × s
                let linear = s.linear.scale(composite.mass) + s.angular.cross(composite.first);
                let angular = composite.tensor_times(s.angular) + composite.first.cross(s.linear);
                for (k, other) in &body.columns[..=index] {
                    let entry = other.angular.dot(angular) + other.linear.dot(linear);
                    let (row, column) = ((*j).max(*k), (*j).min(*k));
                    mass[row][column] = mass[row][column] + entry;
                }
                self.along_path(&mut mass, (*j, i), (linear, angular));
            }
        }
        for (i, body) in self.bodies.iter().enumerate() {
            for &(j, h) in &body.rotors {
                let zero = Vec3([b.zero(); 3]);
                for (k, s) in &body.columns {
                    add_twice(&mut mass, j, *k, s.angular.dot(h));
                }
                self.along_path(&mut mass, (j, i), (zero, h));
            }
        }
        for rotor in &self.graph.rotors {
            let j = rotor.coordinate.0;
            mass[j][j] = mass[j][j] + reflected(b, rotor);
        }
        mass
    }

    /// Adds the products of a momentum of velocity j at body i with the columns of the bodies that carry
    /// it.
    fn along_path(
        &self,
        mass: &mut [Vec<Expr<'g>>],
        (j, i): (usize, usize),
        (mut linear, mut angular): (Vec3<Expr<'g>>, Vec3<Expr<'g>>),
    ) {
        let mut body = &self.bodies[i];
        while let Some(p) = body.parent {
            linear = body.inward(self.b, linear);
            angular = body.inward(self.b, angular) + body.position.cross(linear);
            body = &self.bodies[p];
            for (k, s) in &body.columns {
                add_twice(mass, j, *k, s.angular.dot(angular) + s.linear.dot(linear));
            }
        }
    }

    /// Returns the inertia of each body with all bodies that it carries.
    fn composites(&self) -> Vec<Inertia<'g>> {
        let b = self.b;
        let mut composites: Vec<Inertia<'g>> = self.bodies.iter().map(|x| x.inertia).collect();
        for (i, body) in self.bodies.iter().enumerate().rev() {
            if let Some(p) = body.parent {
                let moved = composites[i]
                    .turned(body.turned)
                    .turned(body.fixed.map(|x| b.constant(x)))
                    .shifted(body.position);
                composites[p] = composites[p].plus(moved);
            }
        }
        composites
    }

    /// Returns V = −g · Σ m r.
    pub(super) fn potential_energy(&self) -> Expr<'g> {
        let b = self.b;
        let mut firsts: Vec<_> = self.bodies.iter().map(|x| x.inertia.first).collect();
        let mut masses: Vec<_> = self.bodies.iter().map(|x| x.inertia.mass).collect();
        let mut whole = self.fixed.first;
        for (i, body) in self.bodies.iter().enumerate().rev() {
            let moved = body.inward(b, firsts[i]) + body.position.scale(masses[i]);
            match body.parent {
                Some(p) => {
                    firsts[p] = firsts[p] + moved;
                    masses[p] = masses[p] + masses[i];
                }
                None => whole = whole + moved,
            }
        }
        -b.vector(self.graph.gravity).dot(whole)
    }
}

/// Adds an entry and its mirror image: one entry of the lower triangle, twice on the diagonal.
fn add_twice<'g>(mass: &mut [Vec<Expr<'g>>], j: usize, k: usize, entry: Expr<'g>) {
    let (row, column) = (j.max(k), j.min(k));
    mass[row][column] = mass[row][column] + entry;
    if j == k {
        mass[row][column] = mass[row][column] + entry;
    }
}

//! The mass matrix from composite bodies: all bodies outboard of a joint as one rigid body.

use nalgebra::storage::StorageMut;
use nalgebra::{Dim, Matrix, RealField};

use super::Textbook;

impl<T: RealField + Copy, const N: usize> Textbook<T, N> {
    /// Computes the mass matrix, into `m`.
    pub fn mass_matrix<D, S>(&mut self, q: &[T], m: &mut Matrix<T, D, D, S>)
    where
        D: Dim,
        S: StorageMut<T, D, D>,
    {
        self.composite = self.inertia;
        for i in 0..self.joints() {
            self.transform[i] = self.placed(i, q[i]);
        }
        m.fill(T::zero());
        for i in (0..self.joints()).rev() {
            if let Some(p) = self.parent[i] {
                let carried = self.composite[i].in_carrier(&self.transform[i]);
                self.composite[p] = self.composite[p].plus(&carried);
            }
            // The force that moves the composite body at the joint's unit acceleration; its components
            // along all inboard joints are entries of M.
            let mut force = self.composite[i].times(&self.joint[i].motion(T::one()));
            m[(i, i)] = self.joint[i].effort(&force);
            let mut at = i;
            while let Some(p) = self.parent[at] {
                force = self.transform[at].in_carrier(&force);
                let entry = self.joint[p].effort(&force);
                m[(i, p)] = entry;
                m[(p, i)] = entry;
                at = p;
            }
        }
    }
}

//! Recursive Newton–Euler algorithm: velocities and accelerations outboard, forces inboard.

use nalgebra::RealField;

use super::Textbook;

impl<T: RealField + Copy, const N: usize> Textbook<T, N> {
    /// Computes the joint efforts of a motion, into `tau`: N·m, N.
    pub fn inverse_dynamics(&mut self, q: &[T], v: &[T], a: &[T], tau: &mut [T]) {
        for i in 0..self.joints() {
            let x = self.placed(i, q[i]);
            let (rate, push) = (self.joint[i].motion(v[i]), self.joint[i].motion(a[i]));
            // v = X v_parent + S q̇, a = X a_parent + S q̈ + v × S q̇
            let (velocity, carried) = match self.parent[i] {
                Some(p) => (
                    x.in_body(&self.velocity[p]).plus(&rate),
                    x.in_body(&self.acceleration[p]),
                ),
                None => (rate, x.in_body(&self.base)),
            };
            let acceleration = carried.plus(&push).plus(&velocity.cross(&rate));
            // f = I a + v ×* I v
            let momentum = self.inertia[i].times(&velocity);
            let force = self.inertia[i].times(&acceleration);
            self.force[i] = force.plus(&velocity.cross_force(&momentum));
            self.transform[i] = x;
            self.velocity[i] = velocity;
            self.acceleration[i] = acceleration;
        }
        for i in (0..self.joints()).rev() {
            tau[i] = self.joint[i].effort(&self.force[i]);
            if let Some(p) = self.parent[i] {
                self.force[p] = self.force[p].plus(&self.transform[i].in_carrier(&self.force[i]));
            }
        }
    }

    /// Computes the bias force, into `tau`: everything except M a.
    pub fn bias(&mut self, q: &[T], v: &[T], tau: &mut [T]) {
        self.inverse_dynamics(q, v, &[T::zero(); N], tau);
    }

    /// Computes the efforts at rest, into `tau`.
    pub fn gravity(&mut self, q: &[T], tau: &mut [T]) {
        let zeros = [T::zero(); N];
        self.inverse_dynamics(q, &zeros, &zeros, tau);
    }
}

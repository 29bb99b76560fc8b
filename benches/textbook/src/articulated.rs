//! Forward dynamics by articulated bodies (Featherstone).

use nalgebra::{Matrix3, RealField};

use super::Textbook;
use super::spatial::{Force, Inertia, Motion, Transform};

/// A symmetric 6 × 6 inertia [tensor, cross; crossᵀ, mass] in 3 × 3 blocks.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArticulatedInertia<T: RealField + Copy> {
    tensor: Matrix3<T>,
    cross: Matrix3<T>,
    mass: Matrix3<T>,
}

impl<T: RealField + Copy> ArticulatedInertia<T> {
    pub fn zero() -> Self {
        ArticulatedInertia {
            tensor: Matrix3::zeros(),
            cross: Matrix3::zeros(),
            mass: Matrix3::zeros(),
        }
    }

    /// Returns the inertia of a rigid body.
    fn of(rigid: &Inertia<T>) -> Self {
        ArticulatedInertia {
            tensor: rigid.tensor,
            cross: rigid.moment.cross_matrix(),
            mass: Matrix3::from_diagonal_element(rigid.mass),
        }
    }

    fn plus(&self, other: &Self) -> Self {
        ArticulatedInertia {
            tensor: self.tensor + other.tensor,
            cross: self.cross + other.cross,
            mass: self.mass + other.mass,
        }
    }

    fn times(&self, m: &Motion<T>) -> Force<T> {
        Force {
            moment: self.tensor * m.angular + self.cross * m.linear,
            force: self.cross.tr_mul(&m.angular) + self.mass * m.linear,
        }
    }

    /// Returns the projection along a joint: I − U Uᵀ / d.
    fn released(&self, u: &Force<T>, pivot: T) -> Self {
        let (moment, force) = (u.moment / pivot, u.force / pivot);
        ArticulatedInertia {
            tensor: self.tensor - moment * u.moment.transpose(),
            cross: self.cross - moment * u.force.transpose(),
            mass: self.mass - force * u.force.transpose(),
        }
    }

    /// Returns the same in the parent's axes, about its origin.
    fn in_carrier(&self, x: &Transform<T>) -> Self {
        let turned = |m: &Matrix3<T>| x.rotation * m * x.rotation.transpose();
        let (tensor, cross, mass) = (
            turned(&self.tensor),
            turned(&self.cross),
            turned(&self.mass),
        );
        let p = x.origin.cross_matrix();
        // About the new origin moments increase by p × force.
        let shifted = cross + p * mass;
        ArticulatedInertia {
            tensor: tensor + p * cross.transpose() - shifted * p,
            cross: shifted,
            mass,
        }
    }
}

impl<T: RealField + Copy, const N: usize> Textbook<T, N> {
    /// Computes joint accelerations under efforts, into `a`: rad/s², m/s². A singular mass matrix gives
    /// numbers that are not finite.
    pub fn forward_dynamics(&mut self, q: &[T], v: &[T], tau: &[T], a: &mut [T]) {
        self.velocities(q, v);
        self.articulate(tau);
        for i in 0..self.joints() {
            let carried = self.parent[i].map_or(self.base, |p| self.acceleration[p]);
            // a' = X a_parent + c, q̈ = (u − Uᵀ a') / d, a = a' + S q̈
            let acceleration = self.transform[i].in_body(&carried).plus(&self.bias[i]);
            let u = &self.reaction[i];
            let held = u.moment.dot(&acceleration.angular) + u.force.dot(&acceleration.linear);
            a[i] = (self.effort[i] - held) / self.pivot[i];
            self.acceleration[i] = acceleration.plus(&self.joint[i].motion(a[i]));
        }
    }

    /// Outboard sweep: velocities, velocity products c = v × S q̇ and forces p = v ×* I v.
    fn velocities(&mut self, q: &[T], v: &[T]) {
        for i in 0..self.joints() {
            let x = self.placed(i, q[i]);
            let rate = self.joint[i].motion(v[i]);
            let velocity = match self.parent[i] {
                Some(p) => x.in_body(&self.velocity[p]).plus(&rate),
                None => rate,
            };
            let momentum = self.inertia[i].times(&velocity);
            self.bias[i] = velocity.cross(&rate);
            self.force[i] = velocity.cross_force(&momentum);
            self.articulated[i] = ArticulatedInertia::of(&self.inertia[i]);
            self.transform[i] = x;
            self.velocity[i] = velocity;
        }
    }

    /// Inboard sweep: U = I S, d = Sᵀ U, u = τ − Sᵀ p; the parent receives I − U Uᵀ/d and p + (I − U Uᵀ/d)
    /// c + U u/d.
    fn articulate(&mut self, tau: &[T]) {
        for i in (0..self.joints()).rev() {
            let inertia = self.articulated[i];
            let u = inertia.times(&self.joint[i].motion(T::one()));
            let pivot = self.joint[i].effort(&u);
            let effort = tau[i] - self.joint[i].effort(&self.force[i]);
            if let Some(p) = self.parent[i] {
                let released = inertia.released(&u, pivot);
                let share = effort / pivot;
                let pushed = Force {
                    moment: u.moment * share,
                    force: u.force * share,
                };
                let force = self.force[i].plus(&released.times(&self.bias[i]));
                let force = self.transform[i].in_carrier(&force.plus(&pushed));
                let carried = released.in_carrier(&self.transform[i]);
                self.articulated[p] = self.articulated[p].plus(&carried);
                self.force[p] = self.force[p].plus(&force);
            }
            self.reaction[i] = u;
            self.pivot[i] = pivot;
            self.effort[i] = effort;
        }
    }
}

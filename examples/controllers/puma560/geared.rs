//! An arm with the drives' rotors, which are added to the generated model because the spec does not have
//! them.
//!
//! A rotor of inertia J that rotates r times as fast as its joint adds the reflected inertia r²·J. In
//! joint coordinates this is a constant diagonal: M(q) + diag(r²J), with unchanged bias and gravity.

use bgdyn::nalgebra::{Cholesky, SMatrix, SVector};
use bgdyn::{Dynamics, Singular};

/// A model with reflected rotor inertias.
pub struct Geared<M, const N: usize> {
    /// The arm without drives.
    pub arm: M,
    /// r²·J of each joint, kg·m².
    pub rotors: SVector<f64, N>,
}

impl<M: Dynamics<f64, N, N>, const N: usize> Dynamics<f64, N, N> for Geared<M, N> {
    fn joint_names(&self) -> &'static [&'static str; N] {
        self.arm.joint_names()
    }

    fn inverse_dynamics(
        &self,
        q: &SVector<f64, N>,
        v: &SVector<f64, N>,
        a: &SVector<f64, N>,
    ) -> SVector<f64, N> {
        self.arm.inverse_dynamics(q, v, a) + self.rotors.component_mul(a)
    }

    fn mass_matrix(&self, q: &SVector<f64, N>) -> SMatrix<f64, N, N> {
        self.arm.mass_matrix(q) + SMatrix::from_diagonal(&self.rotors)
    }

    fn bias(&self, q: &SVector<f64, N>, v: &SVector<f64, N>) -> SVector<f64, N> {
        self.arm.bias(q, v)
    }

    fn gravity(&self, q: &SVector<f64, N>) -> SVector<f64, N> {
        self.arm.gravity(q)
    }

    /// Returns (M + diag(r²J))⁻¹ (tau − bias): the generated forward dynamics has no rotors.
    fn forward_dynamics(
        &self,
        q: &SVector<f64, N>,
        v: &SVector<f64, N>,
        tau: &SVector<f64, N>,
    ) -> Result<SVector<f64, N>, Singular> {
        let rest = tau - self.bias(q, v);
        match Cholesky::new(self.mass_matrix(q)) {
            Some(factor) => Ok(factor.solve(&rest)),
            None => Err(Singular::new(0, self.joint_names())),
        }
    }

    fn kinetic_energy(&self, q: &SVector<f64, N>, v: &SVector<f64, N>) -> f64 {
        self.arm.kinetic_energy(q, v) + 0.5 * v.dot(&self.rotors.component_mul(v))
    }

    fn potential_energy(&self, q: &SVector<f64, N>) -> f64 {
        self.arm.potential_energy(q)
    }

    fn neutral(&self) -> SVector<f64, N> {
        self.arm.neutral()
    }

    fn position_rates(&self, q: &SVector<f64, N>, v: &SVector<f64, N>) -> SVector<f64, N> {
        self.arm.position_rates(q, v)
    }

    fn normalize(&self, q: &SVector<f64, N>) -> SVector<f64, N> {
        self.arm.normalize(q)
    }

    fn sample(&self, u: &SVector<f64, N>) -> SVector<f64, N> {
        self.arm.sample(u)
    }

    fn integrate(&self, q: &SVector<f64, N>, dv: &SVector<f64, N>) -> SVector<f64, N> {
        self.arm.integrate(q, dv)
    }

    fn difference(&self, q1: &SVector<f64, N>, q0: &SVector<f64, N>) -> SVector<f64, N> {
        self.arm.difference(q1, q0)
    }
}

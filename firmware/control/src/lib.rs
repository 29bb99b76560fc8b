//! Computed torque, and its efforts beside the host's: the same source runs on the microcontroller in `f32` and on the host in `f64`.
#![no_std]
#![forbid(unsafe_code)]

pub mod check;

use bgdyn::nalgebra::SVector;
use bgdyn::{Dynamics, Scalar};

/// Desired and measured motion at one instant, and the efforts computed by the host.
///
/// SI units and radians, joint by joint.
#[derive(Clone, Copy, Debug)]
pub struct Record<T, const N: usize> {
    /// Desired positions.
    pub wanted_q: [T; N],
    /// Desired velocities.
    pub wanted_v: [T; N],
    /// Desired accelerations.
    pub wanted_a: [T; N],
    /// Measured positions.
    pub q: [T; N],
    /// Measured velocities.
    pub v: [T; N],
    /// Efforts, computed by the host in `f64`.
    pub tau: [T; N],
}

/// tau = ID(q, v, a_desired + Kd ė + Kp e), within the limits: every error decays independently with ë +
/// Kd ė + Kp e = 0.
#[derive(Clone, Copy, Debug)]
pub struct ComputedTorque<T, const N: usize> {
    /// Kp, 1/s².
    pub stiffness: T,
    /// Kd, 1/s.
    pub damping: T,
    /// Largest efforts: N·m, N.
    pub limits: SVector<T, N>,
}

impl<T: Scalar, const N: usize> ComputedTorque<T, N> {
    /// Computes one control step: joint efforts, N·m and N.
    #[inline(always)]
    pub fn effort<M: Dynamics<T, N, N>>(&self, model: &M, record: &Record<T, N>) -> SVector<T, N> {
        self.effort_by(record, |q, v, a| model.inverse_dynamics(q, v, a))
    }

    /// Computes the same by any inverse dynamics (q, v, a).
    #[inline(always)]
    pub fn effort_by(
        &self,
        record: &Record<T, N>,
        inverse_dynamics: impl FnOnce(&SVector<T, N>, &SVector<T, N>, &SVector<T, N>) -> SVector<T, N>,
    ) -> SVector<T, N> {
        let a = SVector::from_fn(|i, _| {
            let lag = record.wanted_q[i] + -record.q[i];
            let lag_rate = record.wanted_v[i] + -record.v[i];
            record.wanted_a[i] + self.stiffness * lag + self.damping * lag_rate
        });
        let (q, v) = (SVector::from(record.q), SVector::from(record.v));
        let tau = inverse_dynamics(&q, &v, &a);
        tau.zip_map(&self.limits, |effort, limit| effort.max(-limit).min(limit))
    }
}

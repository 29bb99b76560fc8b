//! The control laws: computed torque, and what it is compared with.

use bgdyn::Dynamics;

use super::Joints;
use super::cycle::Wanted;

/// Gains of the error's dynamics ë + Kd ė + Kp e = 0, the same for every joint.
#[derive(Clone, Copy, Debug)]
pub struct Gains {
    /// Kp, 1/s².
    pub stiffness: f64,
    /// Kd, 1/s.
    pub damping: f64,
}

impl Gains {
    /// Critically damped at the frequency `hertz`: Kp = ω², Kd = 2ω.
    pub fn critical(hertz: f64) -> Self {
        let omega = std::f64::consts::TAU * hertz;
        Gains {
            stiffness: omega * omega,
            damping: 2.0 * omega,
        }
    }
}

/// How joint efforts follow from the error e = q_wanted − q.
pub enum Law<const N: usize> {
    /// tau = ID(q, v, a_wanted + Kd ė + Kp e): inverse dynamics cancels what couples the joints, so
    /// that each error decays by itself, as if the arm were N separate unit masses.
    ComputedTorque,
    /// tau = g(q) + D (Kd ė + Kp e) with the same gains: every joint by itself, the mass matrix
    /// replaced by its diagonal D in the start pose, nothing known of the wanted acceleration.
    PdGravity(Joints<N>),
}

impl<const N: usize> Law<N> {
    /// The joint efforts in the measured state.
    pub fn effort<M: Dynamics<f64, N, N>>(
        &self,
        model: &M,
        gains: Gains,
        wanted: &Wanted<N>,
        q: &Joints<N>,
        v: &Joints<N>,
    ) -> Joints<N> {
        let error = model.difference(&wanted.q, q);
        let pull = error * gains.stiffness + (wanted.v - v) * gains.damping;
        match self {
            Law::ComputedTorque => model.inverse_dynamics(q, v, &(wanted.a + pull)),
            Law::PdGravity(inertia) => model.gravity(q) + inertia.component_mul(&pull),
        }
    }
}

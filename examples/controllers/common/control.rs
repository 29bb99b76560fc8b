//! The control laws: computed torque, and PD control with gravity compensation for comparison.

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
    /// Returns gains for critical damping at the frequency `hertz`: Kp = ω², Kd = 2ω.
    pub fn critical(hertz: f64) -> Self {
        let omega = std::f64::consts::TAU * hertz;
        Gains {
            stiffness: omega * omega,
            damping: 2.0 * omega,
        }
    }
}

/// The joint efforts as a function of the error e = q_desired − q.
pub enum Law<const N: usize> {
    /// tau = ID(q, v, a_desired + Kd ė + Kp e): inverse dynamics cancels the coupling of the joints, so
    /// that each error decays independently, as if the arm were N separate unit masses.
    ComputedTorque,
    /// tau = g(q) + D (Kd ė + Kp e) with the same gains: each joint independently, with the mass matrix
    /// replaced by its diagonal D in the start pose, and without the desired acceleration.
    PdGravity(Joints<N>),
}

impl<const N: usize> Law<N> {
    /// Returns the joint efforts in the measured state.
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

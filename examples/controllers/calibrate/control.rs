//! The control laws: computed torque, and the adaptive law of Slotine and Li (1987) for what the gripper holds.

use crate::cycle::Wanted;
use crate::load::{Load, LoadMap};
use crate::plant::PERIOD;
use crate::robot::ArmModel;
use crate::{JOINTS, Joints};

/// Frequency of both laws, rad/s: errors decay as (1 + ωt) exp(−ωt).
const OMEGA: f64 = std::f64::consts::TAU * 5.0;
/// Joints that are to move slower than this do not adapt, rad/s: dry friction at rest holds a load that no error shows.
const SLOW: f64 = 0.03;
/// Rate of the adaptation of a mass, kg²/(N·m).
const RATE: f64 = 5.0;
/// Length that makes first moments and tensors about the flange comparable with masses, m.
const LENGTH: f64 = 0.1;

/// Returns the sign of a wanted velocity, smoothed: 76 % of 1 at 5 mrad/s.
fn smooth_sign(v: f64) -> f64 {
    (v / 5e-3).tanh()
}

/// Returns the efforts of computed torque: the model's inverse dynamics at a = a_d + 2ω ė + ω² e, and friction at the
/// wanted velocities.
pub fn computed_torque(
    model: &ArmModel,
    wanted: &Wanted<JOINTS>,
    q: &Joints,
    v: &Joints,
) -> Joints {
    let pull = (wanted.q - q) * (OMEGA * OMEGA) + (wanted.v - v) * (2.0 * OMEGA);
    model.inertial_effort(q, v, &(wanted.a + pull)) + model.friction(&wanted.v, smooth_sign)
}

/// What the adaptive law follows in place of the wanted motion, and how far the arm is from it.
#[derive(Clone, Copy, Debug)]
pub struct Reference {
    /// v_r = v_d + ω (q_d − q), rad/s.
    pub v: Joints,
    /// a_r = a_d + ω (v_d − v), rad/s².
    pub a: Joints,
    /// s = v − v_r, rad/s.
    pub s: Joints,
}

impl Reference {
    /// Returns the reference for a wanted motion and measured positions and velocities.
    pub fn new(wanted: &Wanted<JOINTS>, q: &Joints, v: &Joints) -> Self {
        let reference = wanted.v + (wanted.q - q) * OMEGA;
        Reference {
            v: reference,
            a: wanted.a + (wanted.v - v) * OMEGA,
            s: v - reference,
        }
    }
}

/// The adaptive law for a load at the flange.
pub struct Adaptive {
    model: ArmModel,
    /// K.
    map: LoadMap,
    /// Γ, diagonal; 0 for a law that does not adapt.
    rates: Load,
    /// K_D, diagonal, N·m·s/rad.
    damping: Joints,
    /// p̂: what is known of the load.
    pub load: Load,
}

impl Adaptive {
    /// Returns the law for a model; `home` is where the inertias of its gains are taken.
    pub fn new(model: &ArmModel, home: &Joints, adapts: bool) -> Self {
        let lengths = [0, 1, 1, 1, 2, 2, 2, 2, 2, 2];
        let rate = if adapts { RATE } else { 0.0 };
        Adaptive {
            model: model.clone(),
            map: LoadMap::new(),
            rates: Load::from_fn(|k, _| rate * LENGTH.powi(2 * lengths[k])),
            damping: model.own_inertias(home) * OMEGA,
            load: Load::zeros(),
        }
    }

    /// Returns the efforts τ = Y(q, v, v_r, a_r) (π + K p̂) − K_D s, with rotors and friction, and learns from the
    /// errors: p̂ changes by −Γ Y_Fᵀ s.
    pub fn effort(&mut self, wanted: &Wanted<JOINTS>, q: &Joints, v: &Joints) -> Joints {
        let model = &self.model;
        let mut reference = Reference::new(wanted, q, v);
        let base = model.base + self.map.base(&self.load);
        let Reference { v: v_r, a: a_r, s } = reference;
        let effort = model.arm.adaptive_regressor(q, v, &v_r, &a_r) * base
            + model.numbers.rotor.component_mul(&a_r)
            + model.friction(&wanted.v, smooth_sign)
            - self.damping.component_mul(&s);
        let moves = wanted.v.map(|v| f64::from(u8::from(v.abs() > SLOW)));
        reference.s.component_mul_assign(&moves);
        self.load -= self.change(q, v, &reference) * PERIOD;
        effort
    }

    /// Returns Γ Y_Fᵀ s; Y_F has the ten columns of a payload at the flange, and is not formed.
    pub fn change(&self, q: &Joints, v: &Joints, reference: &Reference) -> Load {
        let Reference { v: v_r, a: a_r, s } = reference;
        let arm = &self.model.arm;
        let step = arm.payload_adaptive_step_flange(q, v, v_r, a_r, s);
        step.component_mul(&self.rates)
    }
}

//! What only a simulation knows: the true numbers of the arm, and the errors of a model against them.

use bgdyn::nalgebra::DVector;
use bgdyn::runtime::random::Random;
use bgdyn_identification::Identification;

use crate::Joints;
use crate::panda::JOINT_LIMITS;
use crate::panda_truth::PandaTruth;
use crate::plant::{OFFSETS, joined};
use crate::robot::{ArmModel, Numbers};
use crate::truth::{Coordinates, Input, State, Truth};

/// Random states at which efforts are compared.
const STATES: usize = 4000;
/// Largest acceleration of these, rad/s².
const ACCELERATION: f64 = 7.0;

/// Returns the efforts that the arm needs for accelerations, N·m.
fn true_effort(q: &Joints, v: &Joints, a: &Joints) -> Joints {
    let modes = v.map(|v| if v == 0.0 { 0.0 } else { v.signum() });
    let state = State::from_vectors(&joined(q, v), &modes);
    let [joint1, joint2, joint3, joint4, joint5, joint6, joint7] = (*a).into();
    let a = Coordinates {
        joint1,
        joint2,
        joint3,
        joint4,
        joint5,
        joint6,
        joint7,
    };
    let e = Truth::default().inverse(&state, &a, &Input::default(), 0.0);
    let of_arm = [
        e.joint1, e.joint2, e.joint3, e.joint4, e.joint5, e.joint6, e.joint7,
    ];
    Joints::from(of_arm) + Joints::from(OFFSETS)
}

/// Returns the true numbers. Those of joints follow from efforts at rest, with accelerations, and at two speeds.
pub fn true_numbers() -> Numbers {
    let arm = PandaTruth::<f64>::default();
    let zero = Joints::zeros();
    let of_joints = |v: f64, a: f64| -> Joints {
        let (v, a) = (Joints::repeat(v), Joints::repeat(a));
        true_effort(&zero, &v, &a) - arm.inverse_dynamics(&zero, &v, &a)
    };
    let offset = of_joints(0.0, 0.0);
    let (slow, fast) = (of_joints(1.0, 0.0), of_joints(2.0, 0.0));
    Numbers {
        bodies: arm.parameters(),
        rotor: of_joints(0.0, 1.0) - offset,
        viscous: fast - slow,
        coulomb: slow * 2.0 - fast - offset,
        offset,
    }
}

/// Errors of a model's efforts at random states of the whole work space, at the limits of positions and velocities and
/// with accelerations of up to 7 rad/s².
#[derive(Clone, Copy, Debug)]
pub struct EffortErrors {
    /// Root mean square of the errors of all joints over that of the efforts.
    pub share: f64,
    /// The same for each joint.
    pub by_joint: Joints,
}

/// Compares a model's efforts with those of the arm.
pub fn effort_errors(model: &ArmModel) -> EffortErrors {
    let mut random = Random(2);
    let (mut errors, mut sizes) = (Joints::zeros(), Joints::zeros());
    for _ in 0..STATES {
        let mut draw = |of: &dyn Fn(usize) -> [f64; 2]| {
            Joints::from_fn(|j, _| {
                let [low, high] = of(j);
                low + (high - low) * random.unit()
            })
        };
        let q = draw(&|j| [JOINT_LIMITS[j].lower, JOINT_LIMITS[j].upper]);
        let v = draw(&|j| [-JOINT_LIMITS[j].velocity, JOINT_LIMITS[j].velocity]);
        let a = draw(&|_| [-ACCELERATION, ACCELERATION]);
        let effort = true_effort(&q, &v, &a);
        let error = model.inertial_effort(&q, &v, &a) + model.friction(&v, f64::signum) - effort;
        errors += error.component_mul(&error);
        sizes += effort.component_mul(&effort);
    }
    EffortErrors {
        share: (errors.sum() / sizes.sum()).sqrt(),
        by_joint: errors.component_div(&sizes).map(f64::sqrt),
    }
}

/// Returns the errors of the base parameters that the log shows, in their deviations.
pub fn base_errors(found: &Identification, truth: &Numbers) -> Vec<f64> {
    let free: Vec<f64> = found.map.free.iter().map(|u| truth.get(*u)).collect();
    let truth = &found.map.map * DVector::from_vec(free);
    let base = found.base.iter().zip(truth.iter());
    base.filter(|(found, _)| found.seen)
        .map(|(found, truth)| (found.value - truth) / found.deviation)
        .collect()
}

/// Returns the share of the errors within so many deviations.
pub fn share_within(errors: &[f64], deviations: f64) -> f64 {
    let inside = errors.iter().filter(|e| e.abs() <= deviations).count();
    inside as f64 / errors.len() as f64
}

//! A satellite without external forces: under torques in its arm, and through a closed cycle of its arm, in
//! which the arm's motion is given and the base follows from the mass matrix or from inverse dynamics.

use bgdyn_runtime::manifold::{floating, spherical};
use bgdyn_runtime::{Dd, Dynamics, vector};
use bgdyn_sim::{Ode, Real};
use hard_cases_compiled::satellite_arm6::{NQ, NV, SatelliteArm6};
use nalgebra::SVector;

use crate::outcome::{Deviation, Outcome};
use crate::reference::larger;
use crate::{Extent, turning};

/// Number of velocities of the base.
const BASE: usize = 6;
/// Number of joints of the arm.
pub(crate) const ARM: usize = NV - BASE;

type Twist<T> = [T; BASE];

/// The arm's angles A_j (sin(2π t/T + 2π p_j) − sin(2π p_j)).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arm<T> {
    amplitudes: [T; ARM],
    /// 2π p_j
    phases: [T; ARM],
    /// sin(2π p_j)
    starts: [T; ARM],
    /// 2π/T, rad/s.
    pace: T,
}

impl<T: Real> Arm<T> {
    /// Returns the motion with these amplitudes, which have few decimals, phases, which are eighths of a
    /// turn, and period, s.
    pub fn new(amplitudes: &[f64], phases: &[f64], period: f64) -> Self {
        let turn = T::from_parts(std::f64::consts::TAU, 2.4492935982947064e-16);
        let phases: [T; ARM] = std::array::from_fn(|j| turn * T::from_f64(phases[j]));
        Arm {
            amplitudes: std::array::from_fn(|j| decimal(amplitudes[j])),
            phases,
            starts: phases.map(|phase| phase.sin_cos().0),
            pace: turn / T::from_f64(period),
        }
    }

    /// Returns angles, rates and accelerations at a time.
    fn at(&self, t: T) -> [[T; ARM]; 3] {
        let mut all = [[T::from_f64(0.0); ARM]; 3];
        for j in 0..ARM {
            let (size, pace) = (self.amplitudes[j], self.pace);
            let (sine, cosine) = (pace * t + self.phases[j]).sin_cos();
            all[0][j] = size * (sine - self.starts[j]);
            all[1][j] = size * pace * cosine;
            all[2][j] = -(size * pace * pace * sine);
        }
        all
    }
}

/// Returns a decimal with few digits to all digits of the scalar.
fn decimal<T: Real>(x: f64) -> T {
    let x: Dd = format!("{x}").parse().expect("a decimal");
    T::from_parts(x.to_f64(), (x - Dd::from_f64(x.to_f64())).to_f64())
}

/// Solves M x = b of a positive definite matrix, by elimination.
fn solved<T: Real>(mut m: [Twist<T>; BASE], mut b: Twist<T>) -> Twist<T> {
    for k in 0..BASE {
        for i in k + 1..BASE {
            let ratio = m[i][k] / m[k][k];
            let row = m[k];
            for (entry, above) in m[i].iter_mut().zip(row) {
                *entry = *entry - ratio * above;
            }
            b[i] = b[i] - ratio * b[k];
        }
    }
    for k in (0..BASE).rev() {
        for j in k + 1..BASE {
            b[k] = b[k] - m[k][j] * b[j];
        }
        b[k] = b[k] / m[k][k];
    }
    b
}

/// The satellite's model with the given motion of its arm.
pub(crate) struct Cycle<T> {
    arm: Arm<T>,
    model: SatelliteArm6<T>,
}

impl<T: Real> Cycle<T> {
    pub fn new(arm: Arm<T>) -> Self {
        let model = SatelliteArm6::default();
        Cycle { arm, model }
    }

    /// Returns all positions.
    fn positions(&self, base: [T; 7], angles: [T; ARM]) -> SVector<T, NQ> {
        SVector::from_fn(|i, _| if i < 7 { base[i] } else { angles[i - 7] })
    }

    /// Returns the base's rows of the mass matrix: those of the base, and those times the arm's rates.
    fn momentum(&self, q: &SVector<T, NQ>, rates: [T; ARM]) -> ([Twist<T>; BASE], Twist<T>) {
        let m = self.model.mass_matrix(q);
        let own = std::array::from_fn(|i| std::array::from_fn(|j| m[(i, j)]));
        let zero = T::from_f64(0.0);
        let arm = std::array::from_fn(|i| {
            let terms = rates.iter().enumerate();
            terms.fold(zero, |sum, (j, &rate)| sum + m[(i, BASE + j)] * rate)
        });
        (own, arm)
    }

    /// Returns the base's velocity at a time for zero momentum: M_bb v_b = −M_bj q̇_j.
    pub fn velocity(&self, t: T) -> Twist<T> {
        let [angles, rates, _] = self.arm.at(t);
        let q = self.positions(floating::neutral(), angles);
        let (own, arm) = self.momentum(&q, rates);
        solved(own, arm.map(|x| -x))
    }

    /// Returns the base's acceleration at a time for zero efforts on the base: M_bb a_b = −h_b, where h_b are
    /// the base's efforts of inverse dynamics without an acceleration of the base.
    fn acceleration(&self, t: T, base: [T; 7], twist: Twist<T>) -> Twist<T> {
        let [angles, rates, accelerations] = self.arm.at(t);
        let q = self.positions(base, angles);
        let v = SVector::from_fn(|i, _| if i < BASE { twist[i] } else { rates[i - BASE] });
        let zero = T::from_f64(0.0);
        let rest = |i: usize| {
            if i < BASE {
                zero
            } else {
                accelerations[i - BASE]
            }
        };
        let a = SVector::from_fn(|i, _| rest(i));
        let efforts = self.model.inverse_dynamics(&q, &v, &a);
        let (own, _) = self.momentum(&q, rates);
        solved(own, std::array::from_fn(|i| -efforts[i]))
    }

    /// Returns the base's momentum in link axes, linear and angular about the link's origin; and the largest
    /// sum of the sizes of the terms that make it, of each.
    pub fn momenta(&self, t: T, twist: Twist<T>) -> ([f64; 2], [f64; 2]) {
        let [angles, rates, _] = self.arm.at(t);
        let q = self.positions(floating::neutral(), angles);
        let v = SVector::from_fn(|i, _| if i < BASE { twist[i] } else { rates[i - BASE] });
        momenta(&self.model, &q, &v)
    }

    /// Returns positions and velocities of base and arm, as the columns of the file.
    pub fn columns(&self, t: T, base: [T; 7], twist: Twist<T>) -> Vec<T> {
        let [angles, rates, _] = self.arm.at(t);
        [&base[..], &angles, &twist, &rates].concat()
    }
}

/// Returns the linear and the angular part of the first six rows of M v, and for each the largest Σ |M_ij v_j|.
fn momenta<T: Real>(
    model: &impl Dynamics<T, NQ, NV>,
    q: &SVector<T, NQ>,
    v: &SVector<T, NV>,
) -> ([f64; 2], [f64; 2]) {
    let m = model.mass_matrix(q);
    let (mut most, mut size) = ([0.0_f64; 2], [0.0_f64; 2]);
    for i in 0..BASE {
        let terms = (0..NV).map(|j| m[(i, j)] * v[j]);
        let sum = terms.clone().fold(T::from_f64(0.0), |sum, x| sum + x);
        let sizes: f64 = terms.map(|x| x.to_f64().abs()).sum();
        most[i / 3] = larger(most[i / 3], sum.to_f64().abs());
        size[i / 3] = size[i / 3].max(sizes);
    }
    (most, size)
}

/// The base's pose as an equation, with the velocity of zero momentum.
pub(crate) struct ByMomentum<'a, T>(pub &'a Cycle<T>);

impl<T: Real> Ode for ByMomentum<'_, T> {
    type State = SVector<T, 7>;
    type Error = ();

    fn rates(&self, t: T, y: &SVector<T, 7>) -> Result<SVector<T, 7>, ()> {
        let [base] = y.data.0;
        Ok(vector(floating::position_rates(base, self.0.velocity(t))))
    }

    fn project(&self, _: T, y: &mut SVector<T, 7>) -> Result<bool, ()> {
        Ok(project(y.as_mut_slice()))
    }
}

/// The base's pose and velocity as an equation, with the acceleration of zero efforts.
pub(crate) struct ByEfforts<'a, T>(pub &'a Cycle<T>);

impl<T: Real> Ode for ByEfforts<'_, T> {
    type State = SVector<T, 13>;
    type Error = ();

    fn rates(&self, t: T, y: &SVector<T, 13>) -> Result<SVector<T, 13>, ()> {
        let (base, twist) = halves(y);
        let moved = floating::position_rates(base, twist);
        let acceleration = self.0.acceleration(t, base, twist);
        let rate = |i: usize| if i < 7 { moved[i] } else { acceleration[i - 7] };
        Ok(SVector::from_fn(|i, _| rate(i)))
    }

    fn project(&self, _: T, y: &mut SVector<T, 13>) -> Result<bool, ()> {
        Ok(project(y.as_mut_slice()))
    }
}

/// Returns pose and velocity of the base.
pub(crate) fn halves<T: Real>(y: &SVector<T, 13>) -> ([T; 7], Twist<T>) {
    let pose = std::array::from_fn(|i| y[i]);
    (pose, std::array::from_fn(|i| y[7 + i]))
}

/// Scales the quaternion of a pose to length 1.
fn project<T: Real>(y: &mut [T]) -> bool {
    let unit = spherical::normalize([y[3], y[4], y[5], y[6]]);
    y[3..7].copy_from_slice(&unit);
    true
}

/// From rest under torques in the arm: the file's samples, and momenta that remain zero, to 1e-12 of what
/// they are made of.
pub(crate) fn satellite_torques(_: Extent) -> Vec<Outcome> {
    let (reference, states, motion) = turning::satellite_motion();
    let model = SatelliteArm6::<f64>::default();
    let at = |y: &Vec<f64>| {
        let q = SVector::from_column_slice(&y[..NQ]);
        momenta(&model, &q, &SVector::from_column_slice(&y[NQ..]))
    };
    let found: Vec<_> = states.iter().map(at).collect();
    let mut outcomes = vec![motion];
    for (k, name) in ["linear", "angular"].into_iter().enumerate() {
        let size = found
            .iter()
            .fold(0.0_f64, |most, (_, size)| most.max(size[k]));
        let rows = reference.times.iter().zip(&found);
        let deviations = rows.map(|(&t, (momentum, _))| Deviation {
            t,
            measured: momentum[k] / size,
            allowed: 1e-12,
        });
        let what = format!("{name} momentum, relative; dop853 at 1e-13");
        outcomes.push(Outcome::worst("satellite_torques", "15", &what, deviations));
    }
    outcomes
}

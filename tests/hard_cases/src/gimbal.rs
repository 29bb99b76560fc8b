//! Tests bodies on two massless rings, near states with parallel outer and inner axes: forward dynamics
//! against Euler's equations. M's condition number is proportional to 1/angle², but its inverse is a
//! product in which nothing cancels. The limit is bar 12's 16 eps, or the effect of rounding the
//! arguments.

use bgdyn_runtime::Dd;

use crate::bars::{Digits, Found, Hard, Reference, Subject};
use crate::literal::Literal;
use crate::outcome::{Outcome, Worst};
use crate::rng::Rng;
use crate::vectors::{Vector, cross};
use crate::{Extent, State};
use hard_cases_compiled::{Compiled, model, spec};

/// A body on a fixed point, by its angles about z, x, z.
struct Euler {
    literal: Literal,
    /// Moments about the fixed point.
    inertia: [[Dd; 3]; 3],
}

fn times(m: &[[Dd; 3]; 3], x: Vector) -> Vector {
    m.map(|row| row[0] * x[0] + row[1] * x[1] + row[2] * x[2])
}

/// Returns m⁻¹ x of a symmetric matrix, by Cramer's rule.
fn divided(m: &[[Dd; 3]; 3], x: Vector) -> Vector {
    let minors = [cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])];
    let determinant = times(&minors, m[0])[0];
    times(&minors, x).map(|entry| entry / determinant)
}

impl Euler {
    /// Reads the spec of this name: mass 2, centre of mass and tensor about it as given.
    fn new(name: &str, com: [f64; 3], tensor: [[f64; 3]; 3]) -> Euler {
        let com = com.map(dd);
        let mut inertia = tensor.map(|row| row.map(dd));
        let square = com[0] * com[0] + com[1] * com[1] + com[2] * com[2];
        for (i, row) in inertia.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                let own = if i == j { square } else { Dd::ZERO };
                *entry += Dd::from_f64(2.0) * (own - com[i] * com[j]);
            }
        }
        Euler {
            literal: Literal::new(spec(name)),
            inertia,
        }
    }

    /// Solves I ω̇ + ω × I ω = N, where the efforts are N along the joints' axes and ω̇ is that of the
    /// angles.
    fn accelerations(&self, q: Vector, v: Vector, tau: Vector) -> Vec<Dd> {
        let (sin, cos) = q[1].sin_cos();
        let (s, c) = q[2].sin_cos();
        let across = (tau[0] - tau[2] * cos) / sin;
        let moment = [tau[1] * c + across * s, across * c - tau[1] * s, tau[2]];
        let omega = [
            v[0] * sin * s + v[1] * c,
            v[0] * sin * c - v[1] * s,
            v[0] * cos + v[2],
        ];
        let gyro = cross(omega, times(&self.inertia, omega));
        let rest = [0, 1, 2].map(|i| moment[i] - gyro[i]);
        let turned = divided(&self.inertia, rest);
        // The part of ω̇ without accelerations of the angles.
        let drift = [
            v[0] * (cos * v[1] * s + sin * c * v[2]) - v[1] * s * v[2],
            v[0] * (cos * v[1] * c - sin * s * v[2]) - v[1] * c * v[2],
            -(v[0] * sin * v[1]),
        ];
        let w = [0, 1, 2].map(|i| turned[i] - drift[i]);
        let yaw = (w[0] * s + w[1] * c) / sin;
        vec![yaw, w[0] * c - w[1] * s, w[2] - yaw * cos]
    }
}

/// Returns the exact decimal of the spec.
fn dd(x: f64) -> Dd {
    format!("{x}").parse().expect("a decimal")
}

impl Reference for Euler {
    fn inverse(&self, s: &State) -> Vec<Dd> {
        self.literal.inverse(s)
    }

    fn mass(&self, s: &State) -> Vec<Dd> {
        self.literal.mass(s)
    }

    fn bias(&self, s: &State) -> Vec<Dd> {
        self.literal.bias(s)
    }

    fn gravity(&self, s: &State) -> Vec<Dd> {
        self.literal.gravity(s)
    }

    fn forward_off(&self, s: &State, argument: usize, joint: usize, factor: Dd) -> Vec<Dd> {
        let all = |x: &[f64]| [x[0], x[1], x[2]].map(Dd::from_f64);
        let mut arguments = [all(&s.q), all(&s.v), all(&s.tau)];
        arguments[argument][joint] *= factor;
        let [q, v, tau] = arguments;
        self.accelerations(q, v, tau)
    }
}

/// Checks bar 1; if rounding the accelerations alone changes τ by more, because their efforts almost
/// cancel in M q̈, the limit is that change: near gimbal lock two rings rotate about almost one axis.
fn inverse_dynamics<T: Digits>(hard: &Hard, subject: &impl Subject<T>, reference: &Euler) -> Found {
    let found = hard.inverse_dynamics::<T>(subject, reference);
    let rounding = hard.rounded_accelerations::<T>();
    Found {
        allowed: found.allowed.max(rounding),
        ..found
    }
}

fn close<T: Digits + Compiled>(
    worst: &mut Worst,
    name: &str,
    case: &str,
    reference: &Euler,
    s: &State,
    condition: f64,
) {
    let hard = Hard::new::<T>(reference, s, Some(condition));
    let at = format!("q = {:?}", s.q);
    let subject = model::<T>(name);
    let mut found = vec![
        inverse_dynamics::<T>(&hard, &subject, reference),
        hard.mass_matrix::<T>(&subject, reference),
    ];
    match Subject::<T>::forward(&subject, &hard.state) {
        Some(a) => found.extend([
            hard.backward::<T>(&a, reference),
            hard.forward::<T>(&a, reference),
        ]),
        None => found.push(Found::new("12", "refused", 1.0, 0.0)),
    }
    worst.add(case, T::MARK, &at, found);
}

/// Tilts of 1e-2 to 1e-12 rad, to both sides of parallel and of opposite axes.
pub(crate) fn near_lock(extent: Extent) -> Vec<Outcome> {
    let round = Euler::new(
        "gimbal_round",
        [0.0; 3],
        [[1.5, 0.0, 0.0], [0.0, 1.5, 0.0], [0.0, 0.0, 2.0]],
    );
    let skew = Euler::new(
        "gimbal_skew",
        [0.1, 0.2, 0.3],
        [[1.0, 0.1, -0.05], [0.1, 1.1, 0.0], [-0.05, 0.0, 1.2]],
    );
    let mut outcomes = vec![];
    // No condition number is known if M is singular within its rounding: 16 eps for the round body, whose
    // inertia does not affect the small terms; 32 eps, as for inverse dynamics, for any other.
    for (name, case, reference, condition) in [
        ("gimbal_round", "gimbal near lock, round body", &round, 0.0),
        ("gimbal_skew", "gimbal near lock, any body", &skew, 16.0),
    ] {
        let mut worst = Worst::default();
        let mut rng = Rng::new(19);
        for exponent in 2..=12 {
            for _ in 0..extent.of(3000, 20) {
                let mut some = |size: f64| (0..3).map(|_| rng.within(size)).collect::<Vec<f64>>();
                let mut s = State {
                    q: some(3.0),
                    v: some(2.0),
                    a: some(3.0),
                    tau: some(20.0),
                    parameters: vec![],
                };
                let sign = if rng.chance(0.5) { 1.0 } else { -1.0 };
                s.q[1] = sign * 10_f64.powi(-exponent) * (1.0 + rng.unit());
                close::<f64>(&mut worst, name, case, reference, &s, condition);
                close::<f32>(&mut worst, name, case, reference, &s, condition);
            }
        }
        outcomes.extend(worst.finish());
    }
    outcomes
}

//! Bars for what is generated, in one state of a mechanism: errors of a scalar against the evaluator
//! in double-double at the same arguments, beside what they may be.

use std::f64::consts::FRAC_PI_2;

use bgdyn_codegen::function::Function;
use bgdyn_codegen::mechanism::Motion;
use bgdyn_codegen::method::Method;
use bgdyn_runtime::{Dd, Scalar};
use nalgebra::DMatrix;

use super::rng::Rng;
use super::{Robot, State, full};

/// Scalars under test.
pub trait Digits: Scalar<Refused = Option<usize>> {
    const EPS: f64;
    fn to_f64(self) -> f64;
}
impl Digits for f64 {
    const EPS: f64 = f64::EPSILON;
    fn to_f64(self) -> f64 {
        self
    }
}
impl Digits for f32 {
    const EPS: f64 = f32::EPSILON as f64;
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
}

/// The methods of a mechanism as they are generated.
pub struct Generated {
    pub inverse: Function,
    pub mass: Function,
    pub bias: Function,
    pub gravity: Function,
    pub forward: Function,
}

impl Generated {
    pub fn new(robot: &Robot) -> Self {
        Generated {
            inverse: robot.chosen(Method::InverseDynamics),
            mass: robot.chosen(Method::MassMatrix),
            bias: robot.chosen(Method::Bias),
            gravity: robot.chosen(Method::Gravity),
            forward: robot.chosen(Method::ForwardDynamics),
        }
    }
}

pub fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

pub fn apart(x: &[f64], y: &[f64]) -> f64 {
    let off: Vec<f64> = x.iter().zip(y).map(|(x, y)| x - y).collect();
    norm(&off)
}

fn values<T: Digits>(f: &Function, s: &State) -> Vec<f64> {
    s.value::<T>(f).into_iter().map(T::to_f64).collect()
}

pub fn fine(f: &Function, s: &State) -> Vec<Dd> {
    s.value(f)
}

/// The difference of two results in double-double, rounded.
fn off(x: &[f64], y: &[Dd]) -> Vec<f64> {
    x.iter()
        .zip(y)
        .map(|(&x, &y)| (Dd::from_f64(x) - y).to_f64())
        .collect()
}

pub fn rounded(x: &[Dd]) -> Vec<f64> {
    x.iter().map(|x| x.to_f64()).collect()
}

/// One state of a mechanism and its sizes.
pub struct Hard {
    pub what: String,
    pub n: usize,
    /// Arguments as the scalar has them.
    pub state: State,
    pub mass: Vec<Vec<f64>>,
    pub bias: Vec<f64>,
    /// ‖M‖, ‖M⁻¹‖
    pub most: f64,
    pub inverse: f64,
}

impl Hard {
    /// The case with its arguments rounded to T. `cond` is the condition number of M, where M in
    /// `f64` is not to tell it.
    pub fn new<T: Digits>(
        what: String,
        generated: &Generated,
        state: &State,
        cond: Option<f64>,
    ) -> Self {
        let round = |x: &[f64]| x.iter().map(|&x| T::from_f64(x).to_f64()).collect();
        let state = State {
            q: round(&state.q),
            v: round(&state.v),
            a: round(&state.a),
            tau: round(&state.tau),
            parameters: state.parameters.clone(),
        };
        let n = state.q.len();
        let mass = full(&rounded(&fine(&generated.mass, &state)), n);
        let moments = DMatrix::from_fn(n, n, |i, j| mass[i][j]).symmetric_eigenvalues();
        let most = moments.max();
        Hard {
            what,
            n,
            bias: rounded(&fine(&generated.bias, &state)),
            state,
            mass,
            most,
            inverse: cond.map_or(1.0 / moments.min(), |cond| cond / most),
        }
    }

    pub fn within(&self, bar: &str, off: f64, allowed: f64) {
        assert!(
            off <= allowed,
            "{}, bar {bar}: {off:e}, allowed {allowed:e}",
            self.what
        );
    }

    /// Σ_j |M_ij||x_j| for each i.
    fn weighed(&self, x: &[f64]) -> Vec<f64> {
        let row = |row: &Vec<f64>| row.iter().zip(x).map(|(m, x)| (m * x).abs()).sum();
        self.mass.iter().map(row).collect()
    }

    /// Inverse dynamics: ‖τ − τ_ref‖ ≤ 32 eps (‖M q̈‖ + ‖c‖ + ‖g‖).
    fn inverse_dynamics<T: Digits>(&self, generated: &Generated) {
        let s = &self.state;
        let found = values::<T>(&generated.inverse, s);
        let exact = fine(&generated.inverse, s);
        let g = rounded(&fine(&generated.gravity, s));
        let moved = apart(&rounded(&exact), &self.bias);
        let size = moved + apart(&self.bias, &g) + norm(&g);
        self.within("1", norm(&off(&found, &exact)), 32.0 * T::EPS * size);
    }

    /// ‖M − M_ref‖ ≤ 8 n eps ‖M‖; its symmetry is built in.
    fn mass_matrix<T: Digits>(&self, generated: &Generated) {
        let found = values::<T>(&generated.mass, &self.state);
        let exact = fine(&generated.mass, &self.state);
        let rows = full(&off(&found, &exact), self.n);
        let whole: Vec<f64> = rows.into_iter().flatten().collect();
        let allowed = 8.0 * self.n as f64 * T::EPS * self.most;
        self.within("4", norm(&whole), allowed);
    }

    /// Forward dynamics, backward: each joint's effort is met to 8 n eps of its terms. Forward:
    /// error ≤ (16 + cond M) eps ‖q̈‖; but where rounding the arguments alone changes q̈ by more
    /// than that, which is where efforts and bias all but balance, four times what it changes.
    fn forward_dynamics<T: Digits>(&self, generated: &Generated) {
        let s = &self.state;
        let found = values::<T>(&generated.forward, s);
        let exact = fine(&generated.forward, s);
        let moved = State {
            a: found.clone(),
            ..s.clone()
        };
        let met = off(&s.tau, &fine(&generated.inverse, &moved));
        let terms = self.weighed(&found);
        for i in 0..self.n {
            let size = terms[i] + s.tau[i].abs() + self.bias[i].abs();
            let allowed = 8.0 * self.n as f64 * T::EPS * size;
            self.within("2", met[i].abs(), allowed);
        }
        let (error, bar) = (norm(&off(&found, &exact)), self.forward_bar::<T>(&exact));
        if error > bar {
            let rounding = self.rounding::<T>(&generated.forward);
            assert!(
                rounding > bar,
                "{}, bar 3: {error:e}, allowed {bar:e}",
                self.what
            );
            self.within("3, rounded arguments", error, 4.0 * rounding);
        }
    }

    /// (16 + cond M) eps ‖q̈‖
    pub fn forward_bar<T: Digits>(&self, exact: &[Dd]) -> f64 {
        (16.0 + self.most * self.inverse) * T::EPS * norm(&rounded(exact))
    }

    /// How far forward dynamics moves where each argument is rounded, by half an eps of itself:
    /// the sum over all of them.
    pub fn rounding<T: Digits>(&self, forward: &Function) -> f64 {
        let exact = fine(forward, &self.state);
        let slightly = Dd::ONE + Dd::from_f64(T::EPS / 2.0);
        let mut sum = 0.0;
        for j in 0..self.n {
            for argument in 0..3 {
                let mut inputs = self.state.inputs::<Dd>();
                let x = match argument {
                    0 => &mut inputs.q[j],
                    1 => &mut inputs.v[j],
                    _ => &mut inputs.u[j],
                };
                *x *= slightly;
                let (moved, refused) = forward.evaluate(inputs);
                assert_eq!(refused, None, "{}", self.what);
                let by: Vec<f64> = moved
                    .iter()
                    .zip(&exact)
                    .map(|(x, y)| (*x - *y).to_f64())
                    .collect();
                sum += norm(&by);
            }
        }
        sum
    }

    /// ‖FD(ID(q̈)) − q̈‖ ≤ 8 n eps ‖M⁻¹‖ (‖M‖‖q̈‖ + ‖h‖)
    fn back_and_forth<T: Digits>(&self, generated: &Generated) {
        let state = State {
            tau: values::<T>(&generated.inverse, &self.state),
            ..self.state.clone()
        };
        let found = values::<T>(&generated.forward, &state);
        let size = self.most * norm(&state.a) + norm(&self.bias);
        let allowed = 8.0 * self.n as f64 * T::EPS * self.inverse * size;
        self.within("5", apart(&found, &state.a), allowed);
    }

    /// The error of a way to forward dynamics.
    pub fn forward_error<T: Digits>(&self, forward: &Function) -> f64 {
        let found = values::<T>(forward, &self.state);
        norm(&off(&found, &fine(forward, &self.state)))
    }

    /// Bars 1 to 5. Where cond M is beyond the scalar's digits, M is singular to within rounding:
    /// forward dynamics may say so instead.
    pub fn all<T: Digits>(&self, generated: &Generated) {
        self.inverse_dynamics::<T>(generated);
        self.mass_matrix::<T>(generated);
        let (_, refused) = generated.forward.evaluate(self.state.inputs::<T>());
        if refused.is_some() {
            let cond = self.most * self.inverse;
            assert!(cond * T::EPS >= 1.0, "{}: refused at {cond:e}", self.what);
            return;
        }
        self.forward_dynamics::<T>(generated);
        self.back_and_forth::<T>(generated);
    }
}

/// A state anywhere, with efforts of some twenty units or those of its own accelerations; in half
/// of them every joint is a quarter turn, or a hair more, from zero or from another.
pub fn near_aligned(rng: &mut Rng, robot: &Robot) -> State {
    let motions = robot.motions();
    let mut state = State::random(rng, &motions);
    state.parameters = (robot.mechanism.parameters().iter())
        .map(|p| p.default.to_f64())
        .collect();
    if rng.chance(0.5) {
        let off = *rng.pick(&[0.0, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2]);
        for (q, motion) in state.q.iter_mut().zip(&motions) {
            if *motion == Motion::Rotation && rng.chance(0.8) {
                *q = f64::from(rng.below(4) as u32) * FRAC_PI_2 + off;
            }
        }
    }
    state
}

/// The state with the efforts that its accelerations take.
pub fn driven(state: &State, generated: &Generated) -> State {
    let efforts: Vec<Dd> = state.value(&generated.inverse);
    State {
        tau: efforts.iter().map(|x| x.to_f64()).collect(),
        ..state.clone()
    }
}

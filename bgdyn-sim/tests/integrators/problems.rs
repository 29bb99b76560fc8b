//! Equations with known solutions, and helper functions.

use bgdyn_runtime::{Dd, Scalar, matrix, vector};
use bgdyn_sim::{Integrator, Jacobian, Ode, Real, Solver, StateVector};
use nalgebra::SVector;

/// Nonlinear, driven by time, with a position and its velocity first:
/// q̇ = v, v̇ = −q w (1 + t²), ẋ = x v, ẇ = −2 t w² from (1, 0, 1, 1), whose solution is
/// cos t, −sin t, exp(cos t − 1), 1/(1 + t²).
pub struct Known {
    /// Whether it provides its slopes.
    pub slopes: bool,
}

/// The solution of [`Known`].
pub fn known<T: Real>(t: T) -> SVector<T, 4> {
    let one = T::from_f64(1.0);
    let (sin, cos) = t.sin_cos();
    vector([cos, -sin, (cos - one).exp(), one / (one + t * t)])
}

impl<T: Real> Equation<T, 4> for Known {
    fn rates(&self, t: T, y: &SVector<T, 4>) -> SVector<T, 4> {
        let [one, two] = [1.0, 2.0].map(T::from_f64);
        let [q, v, x, w] = y.data.0[0];
        vector([v, -(q * w * (one + t * t)), x * v, -(two * t * w * w)])
    }

    fn jacobian(&self, t: T, y: &SVector<T, 4>) -> Option<Jacobian<SVector<T, 4>>> {
        let [zero, one, two] = [0.0, 1.0, 2.0].map(T::from_f64);
        let [q, v, x, w] = y.data.0[0];
        let grows = one + t * t;
        let state = matrix([
            [zero, -(w * grows), zero, zero],
            [one, zero, x, zero],
            [zero, zero, v, zero],
            [zero, -(q * grows), zero, -(two * two * t * w)],
        ]);
        let time = vector([zero, -(two * t * q * w), zero, -(two * w * w)]);
        self.slopes.then_some(Jacobian { state, time })
    }

    fn positions(&self) -> usize {
        1
    }
}

/// An equation whose rates always exist.
pub trait Equation<T: Real, const N: usize> {
    fn rates(&self, t: T, y: &SVector<T, N>) -> SVector<T, N>;

    fn jacobian(&self, _: T, _: &SVector<T, N>) -> Option<Jacobian<SVector<T, N>>> {
        None
    }

    fn positions(&self) -> usize {
        0
    }
}

/// An [`Equation`] as an [`Ode`].
pub struct As<'a, E, T, const N: usize>(pub &'a E, pub std::marker::PhantomData<T>);

/// An [`Equation`] as an [`Ode`].
pub fn ode<T, E, const N: usize>(equation: &E) -> As<'_, E, T, N> {
    As(equation, std::marker::PhantomData)
}

impl<T: Real, E: Equation<T, N>, const N: usize> Ode for As<'_, E, T, N> {
    type State = SVector<T, N>;
    type Error = ();

    fn rates(&self, t: T, y: &SVector<T, N>) -> Result<SVector<T, N>, ()> {
        Ok(self.0.rates(t, y))
    }

    fn jacobian(&self, t: T, y: &SVector<T, N>) -> Option<Result<Jacobian<SVector<T, N>>, ()>> {
        self.0.jacobian(t, y).map(Ok)
    }

    fn positions(&self) -> usize {
        self.0.positions()
    }
}

/// y' = −k (y − cos t), which converges from any start to (k² cos t + k sin t)/(1 + k²).
pub struct Driven {
    pub k: f64,
}

impl Driven {
    pub fn settled(&self, t: f64) -> f64 {
        let k = self.k;
        (k * k * t.cos() + k * t.sin()) / (1.0 + k * k)
    }
}

impl Equation<f64, 1> for Driven {
    fn rates(&self, t: f64, y: &SVector<f64, 1>) -> SVector<f64, 1> {
        vector([-self.k * (y[0] - t.cos())])
    }

    fn jacobian(&self, t: f64, _: &SVector<f64, 1>) -> Option<Jacobian<SVector<f64, 1>>> {
        Some(Jacobian {
            state: matrix([[-self.k]]),
            time: vector([-self.k * t.sin()]),
        })
    }
}

/// Returns the state after `n` equal steps from t = 0 to `end`.
pub fn fixed<O: Ode, M: Integrator<O::State>>(
    method: M,
    ode: &O,
    start: O::State,
    end: f64,
    n: u32,
) -> O::State
where
    <O::State as StateVector>::Scalar: Real,
{
    let number = <O::State as StateVector>::Scalar::from_f64;
    let mut solver = Solver::new(method, number(0.0), start);
    for _ in 0..n {
        solver
            .advance(ode, number(end) / number(n.into()))
            .expect("the step succeeds");
    }
    solver.y().clone()
}

/// Returns the largest distance between two states.
pub fn distance<Y: StateVector>(a: &Y, b: &Y) -> f64
where
    Y::Scalar: Real,
{
    let pairs = a.entries().iter().zip(b.entries());
    pairs
        .map(|(&a, &b)| (a - b).abs().to_f64())
        .fold(0.0, f64::max)
}

/// Returns the slope of log₂ error over successive halvings of the step, fitted by least squares.
pub fn slope(errors: &[f64]) -> f64 {
    let n = errors.len() as f64;
    let mean = errors.iter().map(|e| e.log2()).sum::<f64>() / n;
    let middle = (n - 1.0) / 2.0;
    let (mut above, mut below) = (0.0, 0.0);
    for (i, error) in errors.iter().enumerate() {
        let x = i as f64 - middle;
        above -= x * (error.log2() - mean);
        below += x * x;
    }
    above / below
}

/// Converts to double-double.
pub fn dd(x: f64) -> Dd {
    Dd::from_f64(x)
}

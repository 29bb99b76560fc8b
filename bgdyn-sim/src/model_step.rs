//! The classical Runge–Kutta method of order 4 on a mechanism (Kutta 1901).
//!
//! Positions advance by the mechanism's `integrate`.

use bgdyn_runtime::{Dynamics, Scalar};
use nalgebra::SVector;

/// Positions and velocities of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<T: Scalar, const NQ: usize, const NV: usize> {
    /// Positions: rad, m.
    pub q: SVector<T, NQ>,
    /// Velocities: rad/s, m/s.
    pub v: SVector<T, NV>,
}

/// Returns x + k·y.
fn plus_scaled<T: Scalar, const N: usize>(
    x: &SVector<T, N>,
    k: T,
    y: &SVector<T, N>,
) -> SVector<T, N> {
    x.zip_map(y, |x, y| x + k * y)
}

/// Returns the state after moving from `s` with the rates (v, a) for the time `h`.
fn moved<M, T, const NQ: usize, const NV: usize>(
    model: &M,
    s: &State<T, NQ, NV>,
    rates: (&SVector<T, NV>, &SVector<T, NV>),
    h: T,
) -> State<T, NQ, NV>
where
    M: Dynamics<T, NQ, NV>,
    T: Scalar,
{
    State {
        q: model.integrate(&s.q, &rates.0.map(|v| h * v)),
        v: plus_scaled(&s.v, h, rates.1),
    }
}

/// Takes one step of length `h`, s, from time `t` under the joint efforts `tau(t, state)`.
///
/// # Errors
/// If the mass matrix is singular at one of the four stages.
pub fn rk4_step<M, T, const NQ: usize, const NV: usize>(
    model: &M,
    t: T,
    s: &State<T, NQ, NV>,
    h: T,
    mut tau: impl FnMut(T, &State<T, NQ, NV>) -> SVector<T, NV>,
) -> Result<State<T, NQ, NV>, T::Singular<NV>>
where
    M: Dynamics<T, NQ, NV>,
    T: Scalar,
{
    let mut acceleration = |t: T, s: &State<T, NQ, NV>| {
        let effort = tau(t, s);
        model.forward_dynamics(&s.q, &s.v, &effort)
    };
    let half = h * T::from_f64(0.5);
    let a1 = acceleration(t, s)?;
    let s2 = moved(model, s, (&s.v, &a1), half);
    let a2 = acceleration(t + half, &s2)?;
    let s3 = moved(model, s, (&s2.v, &a2), half);
    let a3 = acceleration(t + half, &s3)?;
    let s4 = moved(model, s, (&s3.v, &a3), h);
    let a4 = acceleration(t + h, &s4)?;
    // (k₁ + 2 k₂ + 2 k₃ + k₄) / 6
    let mean = |k1: &SVector<T, NV>, k2, k3, k4| {
        let middle: SVector<T, NV> = plus_scaled(k2, T::from_f64(1.0), k3);
        let ends = plus_scaled(k1, T::from_f64(1.0), k4);
        let sixth = T::from_f64(1.0) / T::from_f64(6.0);
        plus_scaled(&ends, T::from_f64(2.0), &middle).map(|x| x * sixth)
    };
    let (v, a) = (mean(&s.v, &s2.v, &s3.v, &s4.v), mean(&a1, &a2, &a3, &a4));
    Ok(moved(model, s, (&v, &a), h))
}

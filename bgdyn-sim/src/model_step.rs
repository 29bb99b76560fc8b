//! The classical Runge–Kutta method of order 4 on a mechanism (Kutta 1901).
//!
//! Stages advance positions by their rates q̇ = N(q) v, in which velocities in link axes and those of constraints need
//! not commute. At the end quaternions are scaled to length 1, loops closed and wheels put on their planes.

use bgdyn_runtime::step::State;
use bgdyn_runtime::{Dynamics, Scalar};
use nalgebra::SVector;

/// Returns x + k·y.
fn plus_scaled<T: Scalar, const N: usize>(
    x: &SVector<T, N>,
    k: T,
    y: &SVector<T, N>,
) -> SVector<T, N> {
    x.zip_map(y, |x, y| x + k * y)
}

/// Returns the state after moving from `s` with these rates for the time `h`.
fn moved<T: Scalar, const NQ: usize, const NV: usize>(
    s: &State<T, NQ, NV>,
    rates: &State<T, NQ, NV>,
    h: T,
) -> State<T, NQ, NV> {
    State {
        q: plus_scaled(&s.q, h, &rates.q),
        v: plus_scaled(&s.v, h, &rates.v),
    }
}

/// Returns (k₁ + 2 k₂ + 2 k₃ + k₄) / 6.
fn mean<T: Scalar, const N: usize>(k: [&SVector<T, N>; 4]) -> SVector<T, N> {
    let middle = plus_scaled(k[1], T::from_f64(1.0), k[2]);
    let ends = plus_scaled(k[0], T::from_f64(1.0), k[3]);
    let sixth = T::from_f64(1.0) / T::from_f64(6.0);
    plus_scaled(&ends, T::from_f64(2.0), &middle).map(|x| x * sixth)
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
    let mut rates = |t: T, s: &State<T, NQ, NV>| {
        let effort = tau(t, s);
        let v = model.forward_dynamics(&s.q, &s.v, &effort)?;
        let q = model.position_rates(&s.q, &s.v);
        Ok(State { q, v })
    };
    let half = h * T::from_f64(0.5);
    let k1 = rates(t, s)?;
    let k2 = rates(t + half, &moved(s, &k1, half))?;
    let k3 = rates(t + half, &moved(s, &k2, half))?;
    let k4 = rates(t + h, &moved(s, &k3, h))?;
    let mean = State {
        q: mean([&k1.q, &k2.q, &k3.q, &k4.q]),
        v: mean([&k1.v, &k2.v, &k3.v, &k4.v]),
    };
    let State { q, v } = moved(s, &mean, h);
    // No displacement: that only closes loops.
    let none = SVector::from_element(T::from_f64(0.0));
    let q = model.integrate(&model.normalize(&q), &none);
    Ok(State { q, v })
}

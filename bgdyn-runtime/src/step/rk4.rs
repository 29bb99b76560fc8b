//! The classical Runge–Kutta method of order 4 (Kutta 1901), on the groups of the joints (Munthe-Kaas 1999).
//!
//! The unknown is the displacement u from the first position: q = integrate(q₀, u) with u̇ = Λ(u) v,
//! Λ(u) v = v + ½ \[u, v\] + 1/12 \[u, \[u, v\]\], the inverse derivative of the exponential up to terms of order u⁴, which an
//! order of 4 permits. Where q̇ = v all brackets are zero, and the method is the classical one.

use nalgebra::{SMatrix, SVector};

use super::products::{multiple_of_one, plus, product, transposed_product};
use super::tangent::{bracket, integration_maps};
use super::{Linearizable, State, Step, StepBlocks, Tangent};
use crate::{Dynamics, JointGroups, Scalar};

/// Steps of the classical Runge–Kutta method, of order 4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rk4<T> {
    /// Length of a step h, s.
    pub step: T,
}

/// Derivatives of a step of Runge–Kutta 4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rk4Blocks<T: Scalar, const NV: usize> {
    /// ∂q⁺ along the tangent by q, v and u.
    pub q: [SMatrix<T, NV, NV>; 3],
    /// ∂v⁺ by q, v and u.
    pub v: [SMatrix<T, NV, NV>; 3],
}

/// Shares of a step at which the rates of stages 2, 3 and 4 are evaluated.
const SHARES: [f64; 3] = [0.5, 0.5, 1.0];
/// Weights of the rates, in sixths.
const WEIGHTS: [f64; 4] = [1.0, 2.0, 2.0, 1.0];

/// Rates at a stage: u̇ and v̇.
#[derive(Clone, Copy)]
struct Rates<T: Scalar, const NV: usize> {
    u: SVector<T, NV>,
    v: SVector<T, NV>,
}

/// Derivatives of a vector by q, v and u.
type ByAll<T, const NV: usize> = [SMatrix<T, NV, NV>; 3];

/// Derivatives of the displacement and of the velocity, or of their rates, by q, v and u.
#[derive(Clone, Copy)]
struct Slopes<T: Scalar, const NV: usize> {
    u: ByAll<T, NV>,
    v: ByAll<T, NV>,
}

/// Returns a + k b.
fn all_plus<T: Scalar, const NV: usize>(a: &ByAll<T, NV>, k: T, b: &ByAll<T, NV>) -> ByAll<T, NV> {
    let [a0, a1, a2] = a;
    let [b0, b1, b2] = b;
    [plus(a0, k, b0), plus(a1, k, b1), plus(a2, k, b2)]
}

/// Returns m a.
fn all_times<T: Scalar, const NV: usize>(m: &SMatrix<T, NV, NV>, a: &ByAll<T, NV>) -> ByAll<T, NV> {
    a.each_ref().map(|a| product(m, a))
}

/// Returns Λ(u) v.
fn displacement_rate<M: JointGroups, T: Scalar, const NV: usize>(
    u: &SVector<T, NV>,
    v: &SVector<T, NV>,
) -> SVector<T, NV> {
    if M::QUASI_JOINTS.is_empty() {
        return *v;
    }
    let of_u = bracket(M::QUASI_JOINTS, u);
    let once = product(&of_u, v);
    let twice = product(&of_u, &once);
    let twelfth = T::from_f64(1.0) / T::from_f64(12.0);
    plus(&plus(v, T::from_f64(0.5), &once), twelfth, &twice)
}

/// Returns ∂Λ(u)v/∂u and ∂Λ(u)v/∂v: −½ \[v, ·\] − 1/12 (\[\[u, v\], ·\] + \[u, \[v, ·\]\]), and Λ(u).
fn displacement_rate_slopes<M: JointGroups, T: Scalar, const NV: usize>(
    u: &SVector<T, NV>,
    v: &SVector<T, NV>,
) -> [SMatrix<T, NV, NV>; 2] {
    let (one, half) = (T::from_f64(1.0), T::from_f64(0.5));
    let twelfth = one / T::from_f64(12.0);
    let [of_u, of_v] = [u, v].map(|x| bracket(M::QUASI_JOINTS, x));
    let of_both = bracket(M::QUASI_JOINTS, &product(&of_u, v));
    let second = plus(&of_both, one, &product(&of_u, &of_v));
    let by_u = plus(&of_v.map(|x| -(half * x)), -twelfth, &second);
    let by_v = plus(
        &plus(&multiple_of_one(one), half, &of_u),
        twelfth,
        &product(&of_u, &of_u),
    );
    [by_u, by_v]
}

/// What a stage starts from: its displacement and state.
struct Stage<T: Scalar, const NQ: usize, const NV: usize> {
    u: SVector<T, NV>,
    state: State<T, NQ, NV>,
}

impl<T: Scalar> Rk4<T> {
    /// Returns the length of a step up to a stage after the first.
    fn up_to(&self, share: f64) -> T {
        self.step * T::from_f64(share)
    }

    /// Returns the weight of a stage in the step, s.
    fn weight(&self, weight: f64) -> T {
        self.step * (T::from_f64(weight) / T::from_f64(6.0))
    }

    /// Returns the stages, and the displacement and velocity after the step. Calls `see` with each stage.
    fn walk<M, const NQ: usize, const NV: usize>(
        &self,
        model: &M,
        from: &State<T, NQ, NV>,
        tau: &SVector<T, NV>,
        mut see: impl FnMut(usize, &Stage<T, NQ, NV>) -> Result<(), T::Singular<NV>>,
    ) -> Result<Rates<T, NV>, T::Singular<NV>>
    where
        M: Dynamics<T, NQ, NV> + JointGroups,
    {
        let none = SVector::repeat(T::from_f64(0.0));
        let mut sum = Rates { u: none, v: from.v };
        let mut stage = Stage {
            u: none,
            state: *from,
        };
        for (i, &weight) in WEIGHTS.iter().enumerate() {
            see(i, &stage)?;
            let State { q, v } = &stage.state;
            let rates = Rates {
                u: displacement_rate::<M, T, NV>(&stage.u, v),
                v: model.forward_dynamics(q, v, tau)?,
            };
            let weight = self.weight(weight);
            sum.u = plus(&sum.u, weight, &rates.u);
            sum.v = plus(&sum.v, weight, &rates.v);
            if let Some(&share) = SHARES.get(i) {
                let h = self.up_to(share);
                let u = rates.u.map(|x| h * x);
                let q = model.integrate(&from.q, &u);
                let v = plus(&from.v, h, &rates.v);
                stage = Stage {
                    u,
                    state: State { q, v },
                };
            }
        }
        Ok(sum)
    }

    /// Returns the slopes of the rates at a stage, from those of its displacement and velocity.
    fn rate_slopes<M, const NQ: usize, const NV: usize>(
        model: &M,
        stage: &Stage<T, NQ, NV>,
        tau: &SVector<T, NV>,
        slopes: &Slopes<T, NV>,
    ) -> Result<Slopes<T, NV>, T::Singular<NV>>
    where
        M: Linearizable<T, NQ, NV>,
    {
        let one = T::from_f64(1.0);
        let State { q, v } = &stage.state;
        let [by_q, by_v, by_tau] = model.forward_dynamics_derivatives(q, v, tau)?;
        let moved = moved_slopes::<M, T, NV>(&stage.u, &slopes.u);
        let mut of_v = all_plus(&all_times(&by_q, &moved), one, &all_times(&by_v, &slopes.v));
        let [_, _, by_effort] = &mut of_v;
        *by_effort = plus(by_effort, one, &by_tau);
        let of_u = if M::QUASI_JOINTS.is_empty() {
            slopes.v
        } else {
            let [by_u, by_v] = displacement_rate_slopes::<M, T, NV>(&stage.u, v);
            all_plus(
                &all_times(&by_u, &slopes.u),
                one,
                &all_times(&by_v, &slopes.v),
            )
        };
        Ok(Slopes { u: of_u, v: of_v })
    }
}

/// Returns the derivatives of integrate(q, u) along the tangent by q, v and u, from those of the displacement.
fn moved_slopes<M: JointGroups, T: Scalar, const NV: usize>(
    u: &SVector<T, NV>,
    slopes: &ByAll<T, NV>,
) -> ByAll<T, NV> {
    let one = T::from_f64(1.0);
    let (mut moved, carried) = if M::QUASI_JOINTS.is_empty() {
        (*slopes, multiple_of_one(one))
    } else {
        let [carried, by_u] = integration_maps(M::QUASI_JOINTS, u);
        (all_times(&by_u, slopes), carried)
    };
    let [by_q, _, _] = &mut moved;
    *by_q = plus(by_q, one, &carried);
    moved
}

impl<M, T, const NQ: usize, const NV: usize> Step<M, T, NQ, NV> for Rk4<T>
where
    M: Linearizable<T, NQ, NV>,
    T: Scalar,
{
    type Blocks = Rk4Blocks<T, NV>;

    fn next(
        &self,
        model: &M,
        from: &State<T, NQ, NV>,
        tau: &SVector<T, NV>,
    ) -> Result<State<T, NQ, NV>, T::Singular<NV>> {
        let moved = self.walk(model, from, tau, |_, _| Ok(()))?;
        Ok(State {
            q: model.integrate(&from.q, &moved.u),
            v: moved.v,
        })
    }

    fn linear(
        &self,
        model: &M,
        from: &State<T, NQ, NV>,
        tau: &SVector<T, NV>,
    ) -> Result<Rk4Blocks<T, NV>, T::Singular<NV>> {
        let zero = SMatrix::repeat(T::from_f64(0.0));
        let start = Slopes {
            u: [zero; 3],
            v: [zero, multiple_of_one(T::from_f64(1.0)), zero],
        };
        let (mut slopes, mut sum) = (start, start);
        let moved = self.walk(model, from, tau, |i, stage| {
            let rates = Self::rate_slopes(model, stage, tau, &slopes)?;
            let weight = self.weight(WEIGHTS.get(i).copied().unwrap_or(0.0));
            sum.u = all_plus(&sum.u, weight, &rates.u);
            sum.v = all_plus(&sum.v, weight, &rates.v);
            let h = self.up_to(SHARES.get(i).copied().unwrap_or(0.0));
            slopes.u = all_plus(&start.u, h, &rates.u);
            slopes.v = all_plus(&start.v, h, &rates.v);
            Ok(())
        })?;
        Ok(Rk4Blocks {
            q: moved_slopes::<M, T, NV>(&moved.u, &sum.u),
            v: sum.v,
        })
    }
}

impl<T: Scalar, const NV: usize> StepBlocks<T, NV> for Rk4Blocks<T, NV> {
    fn forward(&self, from: &Tangent<T, NV>, tau: &SVector<T, NV>) -> Tangent<T, NV> {
        let one = T::from_f64(1.0);
        let change = |[by_q, by_v, by_tau]: &ByAll<T, NV>| {
            let state = plus(&product(by_q, &from.q), one, &product(by_v, &from.v));
            plus(&state, one, &product(by_tau, tau))
        };
        Tangent {
            q: change(&self.q),
            v: change(&self.v),
        }
    }

    fn adjoint(&self, next: &Tangent<T, NV>) -> (Tangent<T, NV>, SVector<T, NV>) {
        let [qq, qv, qu] = self.q.each_ref().map(|m| transposed_product(m, &next.q));
        let [vq, vv, vu] = self.v.each_ref().map(|m| transposed_product(m, &next.v));
        let one = T::from_f64(1.0);
        let from = Tangent {
            q: plus(&qq, one, &vq),
            v: plus(&qv, one, &vv),
        };
        (from, plus(&qu, one, &vu))
    }

    fn dense(&self) -> [[SMatrix<T, NV, NV>; 3]; 2] {
        [self.q, self.v]
    }
}

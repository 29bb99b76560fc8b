//! Motions under given efforts, and the search along the laws of a sweep.

use bgdyn_runtime::step::{Linearizable, State, Step};
use nalgebra::SVector;

use super::cost::Cost;
use super::problem::Problem;
use super::{Ilqr, Motion, Promise};
use crate::real::Real;

/// Shares of the step that a search tries: 1 … 2⁻⁹.
const SHARES: usize = 10;
/// The part of the promised decrease that is enough.
const ENOUGH: f64 = 0.1;

/// Fills a motion from its first state under `efforts(k, state)`, moved into the limits.
#[inline]
pub(super) fn roll_out<M, C, T, const NQ: usize, const NV: usize, const N: usize>(
    problem: &Problem<'_, M, C, T, NV>,
    first: &State<T, NQ, NV>,
    motion: &mut Motion<T, NQ, NV, N>,
    mut efforts: impl FnMut(usize, &State<T, NQ, NV>) -> SVector<T, NV>,
) -> Result<(), T::Singular<NV>>
where
    M: Linearizable<T, NQ, NV>,
    C: Cost<M, T, NQ, NV>,
    T: Real,
{
    let Problem {
        model, cost, step, ..
    } = problem;
    let mut state = *first;
    let mut sum = T::from_f64(0.0);
    for (k, node) in motion.nodes.iter_mut().enumerate() {
        node.state = state;
        node.tau = problem.limited(efforts(k, &state));
        sum = sum + cost.node(model, k, &state, &node.tau);
        state = step.next(*model, &state, &node.tau)?;
    }
    motion.end = state;
    motion.cost = sum + cost.end(model, &state);
    Ok(())
}

impl<T: Real, const NQ: usize, const NV: usize, const N: usize> Ilqr<T, NQ, NV, N> {
    /// Follows the laws with the whole step, a half … until the cost falls enough; returns the share, or `None` if no
    /// share is good. Motions through singular positions are not taken.
    pub(super) fn search<M, C>(
        &mut self,
        problem: &Problem<'_, M, C, T, NV>,
        promise: &Promise<T>,
    ) -> Option<T>
    where
        M: Linearizable<T, NQ, NV>,
        C: Cost<M, T, NQ, NV>,
    {
        let mut share = T::from_f64(1.0);
        for _ in 0..SHARES {
            let cost = self.follow(problem, share);
            let wanted = T::from_f64(ENOUGH) * promise.decrease(share);
            // Promises may be wrong, and costs infinite or NaN: the comparison is then false.
            if cost
                .is_some_and(|cost| wanted > T::from_f64(0.0) && self.motion.cost - cost >= wanted)
            {
                core::mem::swap(&mut self.motion, &mut self.trial);
                return Some(share);
            }
            share = share * T::from_f64(0.5);
        }
        None
    }

    /// Fills the trial with the motion under the laws: u = u_k + share · step − K δ(q, v). Returns its cost.
    fn follow<M, C>(&mut self, problem: &Problem<'_, M, C, T, NV>, share: T) -> Option<T>
    where
        M: Linearizable<T, NQ, NV>,
        C: Cost<M, T, NQ, NV>,
    {
        let (nodes, laws) = (&self.motion.nodes, &self.laws);
        let first = nodes.first().map_or(self.motion.end, |node| node.state);
        let followed = roll_out(problem, &first, &mut self.trial, |k, state| {
            let (node, law) = (&nodes[k], &laws[k]);
            let q = problem.model.difference(&state.q, &node.state.q);
            SVector::from_fn(|i, _| {
                let [by_q, by_v] = &law.gain[i];
                let sum = share.mul_add(law.step[i], node.tau[i]);
                (0..NV).fold(sum, |sum, j| {
                    let v = state.v[j] - node.state.v[j];
                    (-by_v[j]).mul_add(v, (-by_q[j]).mul_add(q[j], sum))
                })
            })
        });
        followed.ok().map(|()| self.trial.cost)
    }
}

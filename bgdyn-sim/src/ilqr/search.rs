//! The search along the laws of a sweep.

use bgdyn_runtime::step::Linearizable;
use nalgebra::SVector;

use super::Ilqr;
use super::cost::Cost;
use super::motion::roll_out;
use super::problem::Problem;
use super::sweep::Promise;
use crate::real::Real;

/// Shares of the step that a search tries: 1 … 2⁻⁹.
const SHARES: usize = 10;
/// The part of the promised decrease that is enough.
const ENOUGH: f64 = 0.1;

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

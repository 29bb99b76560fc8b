//! Motions under given efforts.

use bgdyn_runtime::step::{Linearizable, State, Step};
use nalgebra::SVector;

use super::cost::Cost;
use super::problem::Problem;
use crate::real::Real;

/// A state and the efforts that follow.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node<T: Real, const NQ: usize, const NV: usize> {
    pub(super) state: State<T, NQ, NV>,
    pub(super) tau: SVector<T, NV>,
}

/// A motion of N steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion<T: Real, const NQ: usize, const NV: usize, const N: usize> {
    pub(super) nodes: [Node<T, NQ, NV>; N],
    pub(super) end: State<T, NQ, NV>,
    pub(super) cost: T,
}

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

//! The gradient of the cost by the efforts, as a chain of adjoint steps.

use bgdyn_runtime::step::{Linearizable, Step, StepBlocks, Tangent};
use nalgebra::SVector;

use super::Ilqr;
use super::cost::{Cost, Quadratic};
use super::motion::Node;
use super::problem::{NoLaw, Problem};
use crate::real::Real;

/// Returns a part of the first derivatives of a cost.
fn part<T: Real, const NV: usize>(part: [T; NV]) -> SVector<T, NV> {
    SVector::from_column_slice(&part)
}

/// Returns a + b.
fn plus<T: Real, const NV: usize>(a: &SVector<T, NV>, b: &SVector<T, NV>) -> SVector<T, NV> {
    a.zip_map(b, |a, b| a + b)
}

impl<T: Real, const NQ: usize, const NV: usize, const N: usize> Ilqr<T, NQ, NV, N> {
    /// Returns the derivatives of the cost of the motion by the efforts of each node, from the adjoints of the steps: what
    /// is left of the condition for an optimum. It is zero there for efforts within their limits, not negative at the least
    /// effort and not positive at the largest.
    ///
    /// # Errors
    /// [`NoLaw::Singular`].
    pub fn gradient<M, C>(
        &self,
        problem: &Problem<'_, M, C, T, NV>,
    ) -> Result<[SVector<T, NV>; N], NoLaw<T::Singular<NV>>>
    where
        M: Linearizable<T, NQ, NV>,
        C: Cost<M, T, NQ, NV>,
    {
        let mut gradient = [SVector::repeat(T::from_f64(0.0)); N];
        let mut sum = Quadratic::zero();
        problem
            .cost
            .add_end(problem.model, &self.motion.end, &mut sum);
        let [q, v, _] = sum.slope.map(part);
        let mut after = Tangent { q, v };
        let nodes = self.motion.nodes.iter().zip(&mut gradient).enumerate();
        for (k, (Node { state, tau }, slope)) in nodes.rev() {
            let blocks = problem.step.linear(problem.model, state, tau);
            let blocks = blocks.map_err(|error| NoLaw::Singular { node: k, error })?;
            let mut sum = Quadratic::zero();
            problem
                .cost
                .add_node(problem.model, k, state, tau, &mut sum);
            let [q, v, u] = sum.slope.map(part);
            let (before, by_tau) = blocks.adjoint(&after);
            after = Tangent {
                q: plus(&q, &before.q),
                v: plus(&v, &before.v),
            };
            *slope = plus(&u, &by_tau);
        }
        Ok(gradient)
    }
}

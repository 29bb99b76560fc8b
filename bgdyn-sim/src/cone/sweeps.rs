//! Sweeps over the contacts: each in turn is solved for the latest impulses of the others, the nonlinear Gauss–Seidel
//! method (Jean 1999; Acary and Brogliato 2008, chapter 13).

use super::one_contact::OneContact;
use super::problem::{ContactProblem, Vec3};
use crate::real::Real;

/// The contacts of a problem, prepared for sweeps.
#[derive(Clone, Debug)]
pub(super) struct Sweeps<T, const K: usize>([OneContact<T>; K]);

impl<T: Real, const K: usize> Sweeps<T, K> {
    /// Prepares every contact.
    pub(super) fn new(problem: &ContactProblem<'_, T, K>) -> Self {
        Sweeps(core::array::from_fn(|c| {
            OneContact::new(problem.friction[c], &problem.delassus[c][c])
        }))
    }

    /// Solves each active contact once, and goes the given share of the way to its solution.
    pub(super) fn sweep(&self, problem: &ContactProblem<'_, T, K>, p: &mut [Vec3<T>; K], share: T) {
        let whole = share == T::from_f64(1.0);
        for c in (0..K).filter(|&c| problem.active[c]) {
            let velocity = problem.velocity(c, p, Some(c));
            let solved = self.0[c].solve(&velocity);
            p[c] = if whole {
                solved
            } else {
                core::array::from_fn(|i| share.mul_add(solved[i] - p[c][i], p[c][i]))
            };
        }
    }
}

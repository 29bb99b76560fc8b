//! What is to be solved, and how solving it can end.

use core::fmt;

use bgdyn_runtime::step::SemiImplicit;
use nalgebra::SVector;

use crate::real::Real;

/// A model, a cost, and the limits of the efforts.
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a, M, C, T: Real, const NV: usize> {
    /// The model.
    pub model: &'a M,
    /// The cost of a motion.
    pub cost: &'a C,
    /// The discrete step from node to node.
    pub step: SemiImplicit<T>,
    /// The least and the largest efforts of each joint, N·m, N; `None` if there are no limits. A joint without a drive has
    /// equal limits.
    pub limits: Option<[SVector<T, NV>; 2]>,
}

impl<M, C, T: Real, const NV: usize> Problem<'_, M, C, T, NV> {
    /// Returns how far the efforts can change.
    #[inline]
    pub(super) fn room(&self, tau: &SVector<T, NV>) -> Option<[[T; NV]; 2]> {
        let limits = self.limits.as_ref()?;
        Some(
            limits
                .each_ref()
                .map(|limit| core::array::from_fn(|i| limit[i] - tau[i])),
        )
    }

    /// Returns the nearest efforts within the limits.
    #[inline]
    pub(super) fn limited(&self, tau: SVector<T, NV>) -> SVector<T, NV> {
        match &self.limits {
            None => tau,
            Some([lower, upper]) => SVector::from_fn(|i, _| tau[i].max(lower[i]).min(upper[i])),
        }
    }
}

/// What an iteration has done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Iteration<T> {
    /// The cost has fallen.
    Moved {
        /// The new cost.
        cost: T,
        /// The share of the laws' steps that was taken: 1, 1/2, 1/4 …
        share: T,
    },
    /// The motion is as before.
    Ended(Ending),
}

/// Why iterations ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The promised decrease is no larger than the tolerance.
    Converged,
    /// No step lowers the cost by a tenth of what is promised. The tolerance is below the rounding errors of the cost, or
    /// derivatives are not those of the cost.
    Stalled,
    /// The number of iterations is used up.
    Iterations,
}

/// The outcome of [`Ilqr::solve`](super::Ilqr::solve).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution<T> {
    /// Cost of the motion.
    pub cost: T,
    /// Number of iterations that have lowered the cost.
    pub iterations: usize,
    /// Why it ended.
    pub end: Ending,
}

/// Why there is no law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoLaw<E> {
    /// The mass matrix is singular at a node.
    Singular {
        /// Number of the node.
        node: usize,
        /// The error of the model.
        error: E,
    },
    /// The second derivatives by the efforts are not positive definite at a node, also with damping: the cost does not
    /// grow with some effort, or a number is not finite.
    Indefinite {
        /// Number of the node.
        node: usize,
    },
}

impl<E: fmt::Debug> fmt::Display for NoLaw<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Singular { node, error } => {
                write!(f, "node {node} has no accelerations: {error:?}")
            }
            Self::Indefinite { node } => write!(
                f,
                "the second derivatives of the cost by the efforts of node {node} are not positive definite; \
                 a cost of every effort that is not held by equal limits helps"
            ),
        }
    }
}

impl<E: fmt::Debug> core::error::Error for NoLaw<E> {}

//! When the velocities of a step have settled.

use bgdyn_runtime::Scalar;

use super::middle::NEGLIGIBLE;
use crate::real::Real;

/// So many changes that do not fall any more end the iteration: impulses of redundant contacts have rounding errors of
/// their own, which levers and small inertias multiply. They may be up to √ε of the velocities.
const STALLS: usize = 2;

/// Changes that fall by less than this factor are slow.
const SLOW: f64 = 0.02;

/// The changes of the velocities from one evaluation of the rates to the next, in units of what is neglected.
#[derive(Clone, Copy, Debug)]
pub(super) struct Convergence {
    /// The number of changes.
    count: usize,
    /// The last change, and the last two ratios of a change to the one before.
    last: f64,
    ratios: [f64; 2],
    /// How many changes did not fall.
    stalls: usize,
    /// √ε of the velocities.
    rough: f64,
}

impl Convergence {
    /// Returns the state without changes, for a scalar.
    pub(super) fn new<T: Real>() -> Self {
        let epsilon = T::EPSILON.to_f64();
        Convergence {
            count: 0,
            last: f64::INFINITY,
            ratios: [1.0; 2],
            stalls: 0,
            rough: Scalar::sqrt(epsilon) / (NEGLIGIBLE * epsilon),
        }
    }

    /// Notes a change.
    pub(super) fn note(&mut self, change: f64) {
        let ratio = change / self.last;
        (self.count, self.last) = (self.count + 1, change);
        self.ratios = [self.ratios[1], ratio];
        if ratio > 0.5 {
            self.stalls += 1;
        }
    }

    /// Begins to count changes that do not fall anew, as the equations have changed.
    pub(super) fn restart(&mut self) {
        self.stalls = 0;
    }

    /// Returns the last change; infinity before the first.
    pub(super) fn last(&self) -> f64 {
        self.last
    }

    /// Returns whether the velocities still change by more than √ε.
    pub(super) fn is_rough(&self) -> bool {
        self.last > self.rough
    }

    /// Returns whether what is left of the changes is negligible, or they do not fall any more. What is left is that of a
    /// geometric series with the slower of the last two ratios (Hairer and Wanner 1996, section IV.8).
    pub(super) fn is_reached(&self) -> bool {
        let slower = self.ratios[0].max(self.ratios[1]);
        let left = self.last * slower / (1.0 - slower);
        let settled = self.stalls >= STALLS && self.last < self.rough;
        self.last <= 1.0 || (slower < 1.0 && left <= 1.0) || settled
    }

    /// Returns whether substitution is slow, or does not converge. The second change has impulses that the first had not: it
    /// does not tell. Nor do small changes: rough impulses have errors of their own.
    pub(super) fn is_slow(&self) -> bool {
        self.count > 2 && self.ratios[1] > SLOW && self.is_rough()
    }
}

//! Convergence test of an iteration, down to the level of rounding errors.

use bgdyn_runtime::{Scalar, StateVector};

use crate::failure::Reason;
use crate::real::{Of, Real, finite};

/// Largest number of iterations.
const MAX_ITERATIONS: usize = 100;
/// Largest permitted next change, in units of rounding. The neglected change has the same sign in every
/// step, so its effect on the energy accumulates, unlike that of rounding.
const NEGLIGIBLE_CHANGE: f64 = 1e-5;
/// Number of consecutive changes that may fail to decrease.
const STALLS: usize = 2;

/// Tests the convergence of an iteration for the displacements of a step's stages.
///
/// Changes are measured in units of rounding, relative to each component's own size and to the largest
/// component: the value of a component at rest can consist of rounding errors of other components, and
/// stiff rates multiply the rounding errors of their arguments. The iteration ends if the predicted next
/// change is a negligible part of a unit, or if neither measure decreases any more and the changes are not
/// larger than rounding.
pub(super) struct ConvergenceMonitor<Y> {
    /// h |J| |y|, the size that the rounding error of the rates is relative to; zero for unknown slopes.
    rates: Y,
    iterations: usize,
    /// The smallest changes so far, in both measures.
    own: f64,
    overall: f64,
    stalls: usize,
}

impl<Y: StateVector> ConvergenceMonitor<Y>
where
    Of<Y>: Real,
{
    pub(super) fn new(rates: Y) -> Self {
        ConvergenceMonitor {
            rates,
            iterations: 0,
            own: f64::INFINITY,
            overall: f64::INFINITY,
            stalls: 0,
        }
    }

    /// Returns whether the displacements `z` from `y`, after the last changes `changes`, are the solution.
    pub(super) fn ends<E, const S: usize>(
        &mut self,
        y: &Y,
        z: &[Y; S],
        changes: &[Y; S],
    ) -> Result<bool, Reason<E>> {
        if !z.iter().all(finite) {
            return Err(Reason::NotFinite);
        }
        self.iterations += 1;
        let (own, overall, of_rates) = self.sizes(y, z, changes);
        // Predicts the next change from the last two.
        let falls = if self.own.is_finite() {
            own / self.own
        } else {
            1.0
        };
        if own == 0.0 || own * falls < NEGLIGIBLE_CHANGE {
            return Ok(true);
        }
        if own < self.own || overall < self.overall {
            self.stalls = 0;
        } else {
            self.stalls += 1;
        }
        self.own = self.own.min(own);
        self.overall = self.overall.min(overall);
        // Rates whose slopes are unknown may lose a third of their digits.
        let third = Of::<Y>::from_f64(-1.0 / 3.0);
        let digits = (Of::<Y>::EPSILON.ln() * third).exp().to_f64();
        let rounding = self.overall.min(of_rates) < 64.0 || self.own < digits;
        let settled = self.stalls >= 2 * STALLS && self.overall < digits;
        let over = self.stalls >= STALLS || self.iterations >= MAX_ITERATIONS;
        if over && (rounding || settled) {
            return Ok(true);
        }
        if self.iterations >= MAX_ITERATIONS || self.stalls > 5 * STALLS {
            return Err(Reason::NoConvergence {
                iterations: self.iterations,
                change: overall,
            });
        }
        Ok(false)
    }

    /// Returns the largest change in units of rounding, relative to the size of its own component, to the
    /// largest size, and to the size of the rates' arguments.
    fn sizes<const S: usize>(&self, y: &Y, z: &[Y; S], changes: &[Y; S]) -> (f64, f64, f64) {
        let part = |x: &Y, c: usize| x.entries()[c].abs().to_f64();
        let largest = |of: &[Y; S], c| of.iter().fold(0.0_f64, |most, x| most.max(part(x, c)));
        let n = y.entries().len();
        let size = |c| part(y, c) + largest(z, c);
        let most = (0..n).map(size).fold(0.0, f64::max);
        let unit = Of::<Y>::EPSILON.to_f64();
        let (mut own, mut overall, mut of_rates) = (0.0_f64, 0.0_f64, 0.0_f64);
        for c in 0..n {
            let change = largest(changes, c) / unit;
            if change > 0.0 {
                let size = size(c).max(unit * most);
                own = own.max(change / size);
                overall = overall.max(change / most);
                of_rates = of_rates.max(change / (size + part(&self.rates, c)));
            }
        }
        (own, overall, of_rates)
    }
}

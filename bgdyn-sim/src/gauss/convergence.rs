//! Convergence test of an iteration, down to the level of rounding.

use bgdyn_runtime::{Scalar, StateVector};

use crate::failure::Reason;
use crate::real::{Of, Real, finite};

/// Iterations at the most.
const MAX_ITERATIONS: usize = 100;
/// What the next change may be, in units of rounding. It has the same sign step after step: what it
/// leaves of the energy adds up, which rounding does not.
const NEGLIGIBLE_CHANGE: f64 = 1e-5;
/// Times in a row that the changes may fail to become smaller.
const STALLS: usize = 2;

/// Monitors an iteration for the displacements of a step's stages.
///
/// Changes are measured in units of rounding, of each component by itself and of all by the largest
/// one: a component at rest may hold nothing but the rounding of others, and stiff rates multiply the
/// rounding of what they come from. The iteration ends where the
/// next change would be no part of a unit to speak of, or where neither measure becomes smaller
/// any more and what changes is no more than rounding.
pub(super) struct ConvergenceMonitor<Y> {
    /// What the rounding of the rates is a part of: h |J| |y|, as far as the slopes are known.
    rates: Y,
    iterations: usize,
    /// The smallest changes so far.
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

    /// Whether the displacements `z` from `y`, just changed by `changes`, are the solution.
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
        // The next change, going by the last two.
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
        // A third of the digits is what rates may lose whose slopes are not known.
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

    /// The largest change in units of rounding: of its own component's size, of the largest one's, and
    /// of what the rates come from.
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

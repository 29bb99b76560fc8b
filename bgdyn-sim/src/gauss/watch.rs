//! When an iteration has done what rounding lets it do.

use bgdyn_runtime::Scalar;

use crate::failure::Reason;
use crate::space::{Of, Real, Space, finite};

/// Iterations at the most.
const MOST: usize = 100;
/// What the next change may be, in units of rounding. It has the same sign step after step: what it
/// leaves of the energy adds up, which rounding does not.
const LEFT: f64 = 1e-5;
/// Times in a row that the changes may fail to become smaller.
const STALLS: usize = 2;

/// Watches an iteration for the displacements of a step's stages.
///
/// Changes are measured in units of rounding, of each component by itself and of all by the largest
/// one: a component at rest may hold nothing but the rounding of others. The iteration ends where the
/// next change would be no part of a unit to speak of, or where neither measure becomes smaller
/// any more and what changes is no more than rounding.
pub(super) struct Watch {
    iterations: usize,
    /// The smallest changes so far.
    own: f64,
    overall: f64,
    stalls: usize,
}

impl Watch {
    pub(super) fn new() -> Self {
        Watch {
            iterations: 0,
            own: f64::INFINITY,
            overall: f64::INFINITY,
            stalls: 0,
        }
    }

    /// Whether the displacements `z` from `y`, just changed by `changes`, are the solution.
    pub(super) fn ends<Y: Space, E, const S: usize>(
        &mut self,
        y: &Y,
        z: &[Y; S],
        changes: &[Y; S],
    ) -> Result<bool, Reason<E>>
    where
        Of<Y>: Real,
    {
        if !z.iter().all(finite) {
            return Err(Reason::NotFinite);
        }
        self.iterations += 1;
        let (own, overall) = sizes(y, z, changes);
        // The next change, going by the last two.
        let falls = if self.own.is_finite() {
            own / self.own
        } else {
            1.0
        };
        if own == 0.0 || own * falls < LEFT {
            return Ok(true);
        }
        if own < self.own || overall < self.overall {
            self.stalls = 0;
        } else {
            self.stalls += 1;
        }
        self.own = self.own.min(own);
        self.overall = self.overall.min(overall);
        let third = Of::<Y>::from_f64(-1.0 / 3.0);
        let rounding = (Of::<Y>::EPSILON.ln() * third).exp().to_f64();
        if self.stalls >= STALLS && (self.overall < 64.0 || self.own < rounding) {
            return Ok(true);
        }
        if self.iterations >= MOST || self.stalls > 5 * STALLS {
            return Err(Reason::NoConvergence {
                iterations: self.iterations,
                change: overall,
            });
        }
        Ok(false)
    }
}

/// The largest change in units of rounding: of its own component's size, and of the largest one's.
fn sizes<Y: Space, const S: usize>(y: &Y, z: &[Y; S], changes: &[Y; S]) -> (f64, f64)
where
    Of<Y>: Real,
{
    let largest = |of: &[Y; S], c: usize| {
        of.iter()
            .fold(0.0_f64, |most, x| most.max(x.entries()[c].abs().to_f64()))
    };
    let n = y.entries().len();
    let size = |c: usize| y.entries()[c].abs().to_f64() + largest(z, c);
    let most = (0..n).map(size).fold(0.0, f64::max);
    let unit = Of::<Y>::EPSILON.to_f64();
    let (mut own, mut overall) = (0.0_f64, 0.0_f64);
    for c in 0..n {
        let change = largest(changes, c);
        if change > 0.0 {
            own = own.max(change / (unit * size(c).max(unit * most)));
            overall = overall.max(change / (unit * most));
        }
    }
    (own, overall)
}

//! Extrapolation of the modified midpoint rule.

use bgdyn_runtime::{Scalar, StateVector};

use crate::failure::Reason;
use crate::integrator::{Integrator, IntegratorInfo, Start, Step};
use crate::ode::Ode;
use crate::real::{Of, Real, largest};

/// The method of Gragg, Bulirsch and Stoer with `K` rows, of order 2K: the modified midpoint rule with 2,
/// 4, … 2K substeps, extrapolated to a substep of length zero (Gragg 1965; Hairer, Nørsett, Wanner,
/// Solving Ordinary Differential Equations I, II.9).
///
/// Its coefficients are integers, so that only the scalar limits its accuracy: it computes references in
/// double-double. The steps are fixed, or controlled by the difference of the last two extrapolations. The
/// dense output is Hermite's cubic, of order 3.
#[derive(Clone, Copy, Debug, Default)]
pub struct Extrapolation<const K: usize>;

/// The extrapolation method of order 12.
pub type Extrapolation12 = Extrapolation<6>;

impl<const K: usize> Extrapolation<K> {
    /// Returns the change over a step of length h with `substeps` substeps.
    fn midpoint<O: Ode>(
        ode: &O,
        (t, y): (Of<O::State>, &O::State),
        first: &O::State,
        h: Of<O::State>,
        substeps: u32,
    ) -> Result<O::State, Reason<O::Error>> {
        let number = |n: u32| Of::<O::State>::from_f64(n.into());
        let part = h / number(substeps);
        let mut last = y.zero();
        let mut now = first.times(part);
        for i in 1..substeps {
            let there = y.plus(number(1), &now);
            let rates = ode.rates(t + part * number(i), &there);
            let next = last.plus(number(2) * part, &rates.map_err(Reason::Singular)?);
            (last, now) = (now, next);
        }
        Ok(now)
    }
}

impl<Y: StateVector, const K: usize> Integrator<Y> for Extrapolation<K>
where
    Of<Y>: Real,
{
    /// The difference of the last two extrapolations.
    type Stages = Y;

    fn info(&self) -> IntegratorInfo {
        const { assert!(1 < K && K < 10, "two to nine rows") }
        let name = [
            "extrapolation4",
            "extrapolation6",
            "extrapolation8",
            "extrapolation10",
            "extrapolation12",
            "extrapolation14",
            "extrapolation16",
            "extrapolation18",
        ][K - 2];
        IntegratorInfo {
            name,
            order: 2 * K as u32,
            estimate: Some(2 * K as u32 - 1),
            looks: 4,
            reads_jacobian: false,
        }
    }

    fn step<O: Ode<State = Y>>(
        &self,
        ode: &O,
        from: &Start<'_, Y, Y>,
        h: Of<Y>,
    ) -> Result<Step<Y, Y>, Reason<O::Error>> {
        let number = |n: usize| Of::<Y>::from_f64(n as f64);
        let first = ode.rates(from.t, from.y).map_err(Reason::Singular)?;
        // The last diagonal of the Aitken–Neville scheme.
        let mut row: [Y; K] = core::array::from_fn(|_| from.y.zero());
        for j in 0..K {
            let substeps = 2 * (j as u32 + 1);
            let mut best = Self::midpoint(ode, (from.t, from.y), &first, h, substeps)?;
            for k in 1..=j {
                // (n_j/n_{j−k})² − 1 with n_j = 2(j + 1)
                let (n, m) = ((j + 1) * (j + 1), (j + 1 - k) * (j + 1 - k));
                let difference = best.plus(-number(1), &row[k - 1]);
                let better = best.plus(number(m) / number(n - m), &difference);
                row[k - 1] = best;
                best = better;
            }
            row[j] = best;
        }
        Ok(Step {
            h,
            change: row[K - 1].clone(),
            stages: row[K - 1].plus(-number(1), &row[K - 2]),
        })
    }

    fn error(&self, step: &Step<Y, Y>, scale: &Y) -> Option<Of<Y>> {
        Some(largest(&step.stages, scale))
    }
}

//! Evaluates the stages of explicit Runge–Kutta methods.

use bgdyn_runtime::StateVector;

use crate::coefficient::Words;
use crate::failure::Reason;
use crate::integrator::Start;
use crate::ode::{Ode, ScalarOf};
use crate::real::Of;

/// A stage: its time c, and the weights a of the rates of earlier stages.
pub(crate) struct Stage {
    pub(crate) c: Words,
    pub(crate) a: &'static [Words],
}

/// Returns Σ wⱼ kⱼ.
pub(crate) fn combined<Y: StateVector>(weights: &[Words], rates: &[Y]) -> Y {
    let mut terms = weights.iter().zip(rates).filter(|(w, _)| !w.is_zero());
    let Some((w, k)) = terms.next() else {
        return rates[0].zero();
    };
    let mut sum = k.times(w.to());
    for (w, k) in terms {
        sum.add(w.to(), k);
    }
    sum
}

/// Computes the rates at these stages, after those in `rates`: kᵢ = f(t + cᵢh, y + h Σ aᵢⱼ kⱼ).
pub(crate) fn fill<O: Ode>(
    ode: &O,
    (t, y): (ScalarOf<O>, &O::State),
    h: ScalarOf<O>,
    stages: &[Stage],
    rates: &mut [O::State],
) -> Result<(), Reason<O::Error>> {
    let done = rates.len() - stages.len();
    for (i, stage) in stages.iter().enumerate() {
        let (before, after) = rates.split_at_mut(done + i);
        let mut there = combined(stage.a, before);
        for (x, &y) in there.entries_mut().iter_mut().zip(y.entries()) {
            *x = y + h * *x;
        }
        let k = ode.rates(t + stage.c.to::<ScalarOf<O>>() * h, &there);
        after[0] = k.map_err(Reason::Singular)?;
    }
    Ok(())
}

/// Computes the rates at all stages of a step; `stages` lists all but the first. The rates at the first
/// stage are `known` if the previous step ended with them.
pub(crate) fn all<O: Ode, S, const N: usize>(
    ode: &O,
    from: &Start<'_, O::State, S>,
    known: Option<&O::State>,
    h: Of<O::State>,
    stages: &[Stage],
) -> Result<[O::State; N], Reason<O::Error>> {
    let first = match known {
        Some(rates) => rates.clone(),
        None => ode.rates(from.t, from.y).map_err(Reason::Singular)?,
    };
    let mut rates = [(); N].map(|()| first.clone());
    fill(ode, (from.t, from.y), h, stages, &mut rates)?;
    Ok(rates)
}

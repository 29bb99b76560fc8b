//! Integrates plants from sample to sample.

use bgdyn_sim::{FixedModes, HybridState, Integrator, Plant, Solver, StateVector, Tolerance};

/// Returns the states of a plant without events at some times, s, with step control.
///
/// # Panics
/// If the run fails.
pub(crate) fn controlled<P, M>(
    method: M,
    tolerance: Tolerance<f64>,
    plant: &P,
    begin: &HybridState<P::State, P::Modes>,
    times: &[f64],
) -> Vec<P::State>
where
    P: Plant<State: StateVector<Scalar = f64>>,
    M: Integrator<P::State>,
{
    let modes = &begin.modes;
    let held = FixedModes { plant, modes };
    let mut solver = Solver::new(method, begin.t, begin.y.clone()).with_tolerance(tolerance);
    let to = |&t: &f64| {
        let reached = solver.advance_to(&held, t);
        reached.unwrap_or_else(|failure| panic!("at {} s, before {t} s", failure.t));
        solver.y().clone()
    };
    times.iter().map(to).collect()
}

/// Returns the states of a plant without events at some times, s, with fixed steps of `h`, s, of which the
/// times are multiples.
///
/// # Panics
/// If the run fails.
pub(crate) fn fixed<P, M>(
    method: M,
    h: f64,
    plant: &P,
    begin: &HybridState<P::State, P::Modes>,
    times: &[f64],
) -> Vec<P::State>
where
    P: Plant<State: StateVector<Scalar = f64>>,
    M: Integrator<P::State>,
{
    let modes = &begin.modes;
    let held = FixedModes { plant, modes };
    let mut solver = Solver::new(method, begin.t, begin.y.clone());
    let to = |&t: &f64| {
        while solver.t() < t - 0.5 * h {
            let step = solver.advance(&held, h);
            step.unwrap_or_else(|failure| panic!("at {} s, before {t} s", failure.t));
        }
        assert!((solver.t() - t).abs() < 1e-12, "{t} s is no multiple");
        solver.y().clone()
    };
    times.iter().map(to).collect()
}

/// Returns the same tolerance for all components, absolute and relative.
pub(crate) fn alike(tolerance: f64) -> Tolerance<f64> {
    Tolerance {
        absolute: tolerance,
        relative: tolerance,
    }
}

/// Returns a relative tolerance, with a small absolute one, because some components are small.
pub(crate) fn relative(tolerance: f64) -> Tolerance<f64> {
    Tolerance {
        absolute: 1e-4 * tolerance,
        relative: tolerance,
    }
}

/// Returns some quantities of each state.
pub(crate) fn of<Y>(states: &[Y], quantities: impl Fn(&Y) -> Vec<f64>) -> Vec<Vec<f64>> {
    states.iter().map(quantities).collect()
}

//! How much a change of the state grows along a motion.

use bgdyn_runtime::{FixedVector, HybridSystem};
use bgdyn_sim::{Dop853, FixedModes, Run, ScenePlant, Solver, StateVector};

use crate::follow::alike;

/// A change that rounding does not hide.
const NUDGE: f64 = 1e-11;

/// Returns, for each sample of a motion, the largest growth of a change of one component at any sample
/// before, largest component to largest component; at least 1.
pub(crate) fn since_any<S: HybridSystem<f64>>(
    scene: &S,
    states: &[Vec<f64>],
    times: &[f64],
) -> Vec<f64> {
    let (plant, begin) = (&ScenePlant::new(scene), Run::begin(scene));
    let modes = &begin.modes;
    let held = FixedModes { plant, modes };
    let mut most = vec![1.0_f64; times.len()];
    for (from, state) in states.iter().enumerate() {
        for changed in 0..state.len() {
            let mut y = S::State::from_entries(|i| state[i]);
            y.entries_mut()[changed] += NUDGE;
            let solver = Solver::new(Dop853, times[from], y);
            let mut solver = solver.with_tolerance(alike(1e-13));
            for k in from + 1..times.len() {
                solver.advance_to(&held, times[k]).expect("it turns");
                let off = solver.y().entries().iter().zip(&states[k]);
                let off = off.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                most[k] = most[k].max(off / NUDGE);
            }
        }
    }
    most
}

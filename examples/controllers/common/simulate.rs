//! The simulation: a controller at 1 kHz, and an arm that moves between its calls.

use bgdyn::Dynamics;
use bgdyn_sim::{State, rk4_step};

use super::control::Law;
use super::cycle::Wanted;
use super::{Cell, Joints};

/// Time between two calls of the controller, s.
pub const PERIOD: f64 = 1e-3;
/// Number of Runge–Kutta steps of the plant in that time.
const SUBSTEPS: u32 = 4;

/// The state at a call of the controller.
pub struct Sample<const N: usize> {
    /// Time, s.
    pub t: f64,
    /// Desired motion.
    pub wanted: Wanted<N>,
    /// Actual positions.
    pub q: Joints<N>,
    /// Efforts of the drives.
    pub tau: Joints<N>,
    /// Whether a drive was limited.
    pub saturated: bool,
}

impl<const N: usize> Sample<N> {
    /// Returns the error of joint `i`.
    pub fn error(&self, i: usize) -> f64 {
        self.wanted.q[i] - self.q[i]
    }
}

/// Simulates one cycle under `law`, with a sample for each call of the controller and one at the end.
///
/// The drives hold their efforts constant between two calls, within the spec's limits. Sensors are exact
/// and there is no friction: the plant differs from the model by the part only. It is attached and
/// released without an impact: the state is continuous, only the equations change.
pub fn simulate<G, C, E, L, const N: usize>(
    cell: &Cell<G, C, E, L, N>,
    law: &Law<N>,
) -> Result<Vec<Sample<N>>, String>
where
    C: Dynamics<f64, N, N>,
    E: Dynamics<f64, N, N>,
    L: Dynamics<f64, N, N>,
{
    let calls = (cell.cycle.seconds() / PERIOD).round() as usize;
    let (taken, released) = cell.cycle.carried();
    let limits = Joints::from_fn(|i, _| cell.machine.joint(i).limits.effort);
    let mut state = State {
        q: cell.cycle.start,
        v: Joints::zeros(),
    };
    let mut samples = Vec::with_capacity(calls + 1);
    for call in 0..=calls {
        let t = call as f64 * PERIOD;
        let wanted = cell.cycle.at(t);
        let asked = law.effort(&cell.model, cell.gains, &wanted, &state.q, &state.v);
        let tau = asked.zip_map(&limits, |tau, limit| tau.clamp(-limit, limit));
        samples.push(Sample {
            t,
            wanted,
            q: state.q,
            tau,
            saturated: tau != asked,
        });
        let middle = t + 0.5 * PERIOD;
        state = if taken < middle && middle < released {
            period(&cell.loaded, t, &state, &tau)
        } else {
            period(&cell.empty, t, &state, &tau)
        }?;
    }
    Ok(samples)
}

/// The plant's motion from one call of the controller to the next.
fn period<P: Dynamics<f64, N, N>, const N: usize>(
    plant: &P,
    t: f64,
    start: &State<f64, N, N>,
    tau: &Joints<N>,
) -> Result<State<f64, N, N>, String> {
    let h = PERIOD / f64::from(SUBSTEPS);
    let mut state = *start;
    for step in 0..SUBSTEPS {
        state = rk4_step(plant, t + f64::from(step) * h, &state, h, |_, _| *tau)
            .map_err(|singular| format!("at {t:.3} s: {singular}"))?;
    }
    Ok(state)
}

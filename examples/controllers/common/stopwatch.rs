//! Measures the time of a call: 1024 states, the median of several passes over all of them.

use std::hint::black_box;
use std::time::Instant;

use bgdyn::Dynamics;

use super::Joints;
use super::machine::Machine;

/// Number of states.
pub const STATES: usize = 1024;
/// Number of timed passes; odd, so that there is a median.
pub const PASSES: usize = 15;
/// Number of times each pass visits all states, so that a pass is long compared with the clock's
/// resolution.
const ROUNDS: usize = 8;

/// A method's name and its nanoseconds per call.
pub type Times = [(&'static str, f64); 4];

struct Inputs<const N: usize> {
    q: Joints<N>,
    v: Joints<N>,
    /// Accelerations or efforts.
    x: Joints<N>,
}

/// Times the methods a controller or a simulator calls.
pub fn time<M: Dynamics<f64, N, N>, const N: usize>(model: &M, machine: &Machine<N>) -> Times {
    let states = spread_states(machine);
    [
        (
            "inverse_dynamics",
            median(&states, |s| model.inverse_dynamics(&s.q, &s.v, &s.x)),
        ),
        ("mass_matrix", median(&states, |s| model.mass_matrix(&s.q))),
        ("bias", median(&states, |s| model.bias(&s.q, &s.v))),
        (
            "forward_dynamics",
            median(&states, |s| model.forward_dynamics(&s.q, &s.v, &s.x)),
        ),
    ]
}

/// Returns the median over the passes of the time per call, ns. Inputs and results are opaque to the
/// compiler, so that every call is executed completely.
fn median<R, const N: usize>(states: &[Inputs<N>], call: impl Fn(&Inputs<N>) -> R) -> f64 {
    let pass = || {
        let start = Instant::now();
        for _ in 0..ROUNDS {
            for state in states {
                black_box(call(black_box(state)));
            }
        }
        start.elapsed().as_secs_f64() * 1e9 / (ROUNDS * states.len()) as f64
    };
    pass(); // warms up the caches and the clock
    let mut times: Vec<f64> = (0..PASSES).map(|_| pass()).collect();
    times.sort_by(f64::total_cmp);
    times[PASSES / 2]
}

/// Returns positions within the joints' ranges, speeds within their limits, the rest within ±10.
fn spread_states<const N: usize>(machine: &Machine<N>) -> Vec<Inputs<N>> {
    let mut share = evenly_spread();
    let mut within = move |low: f64, high: f64| low + (high - low) * share();
    (0..STATES)
        .map(|_| Inputs {
            q: Joints::from_fn(|i, _| {
                let bgdyn::runtime::Limits {
                    lower: low,
                    upper: high,
                    ..
                } = machine.limits[i];
                within(low, high)
            }),
            v: Joints::from_fn(|i, _| {
                let speed = machine.limits[i].velocity;
                within(-speed, speed)
            }),
            x: Joints::from_fn(|_, _| within(-10.0, 10.0)),
        })
        .collect()
}

/// Returns numbers that fill [0, 1) uniformly, the same ones in every run: multiples of the golden ratio.
fn evenly_spread() -> impl FnMut() -> f64 {
    let mut k = 0.0_f64;
    move || {
        k += 1.0;
        (0.618_033_988_749_894_9 * k).fract()
    }
}

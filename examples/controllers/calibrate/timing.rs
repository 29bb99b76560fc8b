//! The time of a step of the adaptive law: the shortest of several passes over the states of a run.

use std::hint::black_box;
use std::time::Instant;

use crate::Joints;
use crate::acts::Carried;
use crate::control::{Adaptive, Reference};
use crate::robot::ArmModel;

/// Timed passes.
pub const PASSES: usize = 101;

/// Returns the time of a step of the law for a load, Γ Y_Fᵀ s, at the states of a run, ns.
pub fn step_time(model: &ArmModel, run: &Carried) -> f64 {
    let law = Adaptive::new(model, &run.samples[0].q, true);
    let states: Vec<(Joints, Joints, Reference)> = run
        .samples
        .iter()
        .map(|s| {
            let reference = Reference::new(&s.wanted, &s.measured, &s.velocity);
            (s.measured, s.velocity, reference)
        })
        .collect();
    shortest(&states, |(q, v, r)| law.change(q, v, r))
}

/// Returns the shortest time of a call over the passes, ns: another program on the machine only makes passes longer.
fn shortest<S, R>(states: &[S], call: impl Fn(&S) -> R) -> f64 {
    let pass = || {
        let start = Instant::now();
        for state in states {
            black_box(call(black_box(state)));
        }
        start.elapsed().as_secs_f64() * 1e9 / states.len() as f64
    };
    (0..PASSES).map(|_| pass()).fold(f64::INFINITY, f64::min)
}

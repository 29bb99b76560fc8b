//! Runs many copies of one plant on all cores; the results do not depend on the number of threads.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;
use std::vec::Vec;

use bgdyn_runtime::Scalar;

use crate::audit::Audit;
use crate::failure::Failure;
use crate::integrator::Integrator;
use crate::plant::Plant;
use crate::real::{Of, Real};
use crate::run::{HybridState, Run};

/// Returns the default number of parallel runs: the number of cores.
pub fn cores() -> NonZeroUsize {
    thread::available_parallelism().unwrap_or(NonZeroUsize::MIN)
}

/// Applies `work` to each input, on the given number of threads; the results are in the order of the
/// inputs.
///
/// Each result depends on its input alone, so it is the same bit for bit for any number of threads.
/// `watch` is called on the calling thread with the number of finished inputs.
///
/// # Panics
/// If `work` panics.
pub fn batch<I: Sync, R: Send>(
    inputs: &[I],
    threads: NonZeroUsize,
    work: impl Fn(&I) -> R + Sync,
    mut watch: impl FnMut(usize),
) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let (send, receive) = mpsc::channel();
    let mut results: Vec<Option<R>> = inputs.iter().map(|_| None).collect();
    thread::scope(|scope| {
        for _ in 0..threads.get().min(inputs.len()) {
            let (send, next, work) = (send.clone(), &next, &work);
            scope.spawn(move || {
                loop {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    let Some(input) = inputs.get(i) else { break };
                    if send.send((i, work(input))).is_err() {
                        break;
                    }
                }
            });
        }
        drop(send);
        for (done, (i, result)) in receive.iter().enumerate() {
            results[i] = Some(result);
            watch(done + 1);
        }
    });
    // The scope panics if a thread does, so every result exists.
    results.into_iter().flatten().collect()
}

/// Number and length of the steps of a run of a batch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FixedSteps<T> {
    /// Length of a step, s; with a tolerance, the time between two evaluations of the outputs.
    pub step: T,
    /// Number of steps.
    pub steps: usize,
}

/// The results of a run of a batch.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome<P: Plant, Y>
where
    P::Modes: PartialEq,
{
    /// State and modes at the end of the run.
    pub end: HybridState<P::State, P::Modes>,
    /// The observed values at the end.
    pub last: Y,
    /// The smallest of each observed value, over the ends of all steps.
    pub low: Y,
    /// The largest of each observed value.
    pub high: Y,
    /// The energy account.
    pub audit: Audit<P::Entries>,
    /// The reason for an early end.
    pub failure: Option<Failure<P::State, P::Error>>,
}

/// Runs to the end and records the extremes of the values that `look` returns:
/// [`crate::ScenePlant::output`], or the state itself. The outcome of a failed run is that of its last
/// successful step.
pub fn outcome<P, M, Y>(
    mut run: Run<P, M>,
    steps: FixedSteps<Of<P::State>>,
    look: impl Fn(&P, Of<P::State>, &P::State, &P::Modes) -> Y,
) -> Outcome<P, Y>
where
    P: Plant,
    P::Modes: PartialEq,
    M: Integrator<P::State>,
    Of<P::State>: Real,
    Y: AsRef<[Of<P::State>]> + AsMut<[Of<P::State>]> + Clone,
{
    let see = |run: &Run<P, M>| look(run.plant(), run.t(), run.y(), run.modes());
    let mut failure = run.resolve_stiction().err();
    let mut last = see(&run);
    let (mut low, mut high) = (last.clone(), last.clone());
    for _ in 0..steps.steps {
        failure = failure.or_else(|| run.step(steps.step).err());
        if failure.is_some() {
            break;
        }
        last = see(&run);
        let extremes = low.as_mut().iter_mut().zip(high.as_mut());
        for ((low, high), &x) in extremes.zip(last.as_ref()) {
            *low = Scalar::min(*low, x);
            *high = Scalar::max(*high, x);
        }
    }
    Outcome {
        end: HybridState {
            t: run.t(),
            y: run.y().clone(),
            modes: run.modes().clone(),
        },
        last,
        low,
        high,
        audit: run.audit(),
        failure,
    }
}

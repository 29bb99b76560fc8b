//! Runs many copies of one plant on all cores, with results that do not depend on their number.

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

/// How many runs go at once where nothing else is said: as many as the machine has cores.
pub fn cores() -> NonZeroUsize {
    thread::available_parallelism().unwrap_or(NonZeroUsize::MIN)
}

/// Does something with each input, on so many threads; the results stand in the inputs' order.
///
/// Each result is what `work` makes of its input alone, so it is the same bit for bit whatever the
/// number of threads. `watch` hears, on the calling thread, how many are done.
///
/// # Panics
/// Where `work` panics.
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
    // A thread that panicked has ended the scope.
    results.into_iter().flatten().collect()
}

/// How far a run of a batch goes, and by which steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Course<T> {
    /// Length of a step, s; with a tolerance, time between two looks at the outputs.
    pub step: T,
    /// How many steps.
    pub steps: usize,
}

/// What is kept of a run of a batch.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome<P: Plant, Y>
where
    P::Modes: PartialEq,
{
    /// Where it ended.
    pub end: HybridState<P::State, P::Modes>,
    /// The values looked at, at the end.
    pub last: Y,
    /// The least of each, over the ends of all steps.
    pub low: Y,
    /// The largest of each.
    pub high: Y,
    /// Where the energy went.
    pub audit: Audit<P::Entries>,
    /// Why it ended early, if it did.
    pub failure: Option<Failure<P::State, P::Error>>,
}

/// Takes a run to its end, with the extremes of what `look` sees: [`crate::ScenePlant::output`], or the
/// state itself. A run that cannot go on is kept as far as it went.
pub fn outcome<P, M, Y>(
    mut run: Run<P, M>,
    course: Course<Of<P::State>>,
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
    for _ in 0..course.steps {
        failure = failure.or_else(|| run.step(course.step).err());
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

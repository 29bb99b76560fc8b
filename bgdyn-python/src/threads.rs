//! Shares a computation among threads, which end if a signal comes.

use std::thread;
use std::time::Duration;

use crate::interrupt::Interrupt;

/// Number of looks at a thread that is not finished without a pause: most end soon after this one.
const LOOKS: usize = 200;

/// The pause between two later looks.
const PAUSE: Duration = Duration::from_micros(200);

/// Computes each part by `one`: the first in this thread, each other in a thread of its own. Returns the results in the
/// order of the parts. The function that `one` receives returns whether the computation shall end.
pub fn in_threads<P: Send, R: Send>(
    parts: Vec<P>,
    interrupt: &Interrupt,
    one: impl Fn(P, &dyn Fn() -> bool) -> R + Sync,
) -> Vec<R> {
    let one = &one;
    thread::scope(|scope| {
        let mut parts = parts.into_iter();
        let own = parts.next();
        let others: Vec<_> = parts
            .map(|part| scope.spawn(move || one(part, &|| interrupt.came())))
            .collect();
        let own = own.map(|part| one(part, &|| interrupt.ask()));
        let mut found: Vec<R> = own.into_iter().collect();
        for thread in others {
            let mut looks = 0..LOOKS;
            while !thread.is_finished() {
                interrupt.ask();
                match looks.next() {
                    Some(_) => thread::yield_now(),
                    None => thread::sleep(PAUSE),
                }
            }
            match thread.join() {
                Ok(one) => found.push(one),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        found
    })
}

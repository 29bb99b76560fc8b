//! Ends computations at Ctrl-C. Python runs the handlers of signals in its main thread, between its own instructions. A
//! computation without the interpreter's lock has none of these: it asks from time to time whether a signal came.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use bgdyn_codegen::engine::{CallArguments, Callable, Engine, Status};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::tape::Tape;
use pyo3::prelude::*;

/// Time between two questions of a thread.
const INTERVAL: Duration = Duration::from_millis(30);

/// Number of calls of a scene's functions between two looks at the clock.
const CALLS: u32 = 16;

thread_local! {
    /// When this thread asked last.
    static ASKED: Cell<Option<Instant>> = const { Cell::new(None) };
    /// Number of calls of functions of the run that this thread computes; `None` outside of runs.
    static IN_RUN: Cell<Option<u32>> = const { Cell::new(None) };
}

/// Runs the handlers of the signals that came, unless this thread did so a short time ago.
///
/// # Errors
/// What a handler raises: `KeyboardInterrupt`.
fn ask() -> PyResult<()> {
    let now = Instant::now();
    if ASKED.get().is_some_and(|last| now - last < INTERVAL) {
        return Ok(());
    }
    ASKED.set(Some(now));
    // While the interpreter ends, nothing can be asked.
    Python::try_attach(|py| py.check_signals()).unwrap_or(Ok(()))
}

/// Whether a computation, in one thread or several, shall end.
#[derive(Debug, Default)]
pub struct Interrupt {
    came: AtomicBool,
    error: Mutex<Option<PyErr>>,
}

impl Interrupt {
    /// Returns whether the computation shall end, as far as it is known.
    pub fn came(&self) -> bool {
        self.came.load(Ordering::Relaxed)
    }

    /// Asks for signals, and returns whether the computation shall end: for the thread that called from Python.
    pub fn ask(&self) -> bool {
        if !self.came()
            && let Err(error) = ask()
        {
            *self.error.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
            self.came.store(true, Ordering::Relaxed);
        }
        self.came()
    }

    /// Returns whether the computation came to its end.
    ///
    /// # Errors
    /// What the handler of a signal raised.
    pub fn finished(self) -> PyResult<()> {
        let error = self.error.into_inner();
        match error.unwrap_or_else(PoisonError::into_inner) {
            Some(error) => Err(error),
            None => Ok(()),
        }
    }
}

/// Computes runs of scenes whose functions are prepared by [`Interruptible`].
///
/// # Errors
/// What the handler of a signal raised.
pub fn interruptible<R>(runs: impl FnOnce() -> R) -> PyResult<R> {
    IN_RUN.set(Some(0));
    let ended = catch_unwind(AssertUnwindSafe(runs));
    IN_RUN.set(None);
    ended.or_else(|cause| match cause.downcast::<PyErr>() {
        Ok(error) => Err(*error),
        Err(panic) => resume_unwind(panic),
    })
}

/// Tapes that ask for signals. An integrator knows no end but those of its run: they leave it by unwinding, without a
/// panic's message.
#[derive(Debug)]
pub struct Interruptible;

impl Engine for Interruptible {
    fn name(&self) -> &'static str {
        Tape.name()
    }

    fn prepare(&self, function: &Function) -> Box<dyn Callable> {
        Box::new(Asking(Tape.prepare(function)))
    }
}

/// A function that asks for signals before its calls.
#[derive(Debug)]
struct Asking(Box<dyn Callable>);

impl Callable for Asking {
    fn engine(&self) -> &'static str {
        self.0.engine()
    }

    fn results(&self) -> usize {
        self.0.results()
    }

    fn call(&self, from: &CallArguments<'_>, out: &mut [f64]) -> Status {
        if let Some(calls) = IN_RUN.get() {
            IN_RUN.set(Some(calls.wrapping_add(1)));
            if calls.is_multiple_of(CALLS)
                && let Err(error) = ask()
            {
                resume_unwind(Box::new(error));
            }
        }
        self.0.call(from, out)
    }
}

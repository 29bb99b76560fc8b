//! Machine code for functions that turn out to be called often: the tape computes the first calls.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use bgdyn_codegen::engine::{CallArguments, Callable, Engine, Status};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::tape::Tape;

use crate::jit::Jit;

/// The engine for runs of unknown length: a function is computed by the tape at first, and by machine code from a given
/// call on. Bits do not depend on it.
#[derive(Clone, Debug)]
pub struct OftenCalled {
    jit: Jit,
    calls: usize,
}

impl OftenCalled {
    /// Returns the engine that makes a function's code after this number of its calls.
    pub fn after(calls: usize, jit: Jit) -> Self {
        OftenCalled { jit, calls }
    }
}

impl Engine for OftenCalled {
    fn name(&self) -> &'static str {
        "machine code for functions that are called often"
    }

    fn prepare(&self, function: &Function) -> Box<dyn Callable> {
        Box::new(Counted {
            tape: Tape.prepare(function),
            calls: AtomicUsize::new(0),
            code: OnceLock::new(),
            function: function.clone(),
            engine: self.clone(),
        })
    }
}

/// A function whose calls are counted until it has machine code.
#[derive(Debug)]
struct Counted {
    tape: Box<dyn Callable>,
    calls: AtomicUsize,
    code: OnceLock<Box<dyn Callable>>,
    function: Function,
    engine: OftenCalled,
}

impl Counted {
    /// Returns what computes the next call.
    fn next(&self) -> &dyn Callable {
        if let Some(code) = self.code.get() {
            return &**code;
        }
        // Threads that arrive while the code is made wait for it.
        match self.calls.fetch_add(1, Ordering::Relaxed) < self.engine.calls {
            true => &*self.tape,
            false => &**self
                .code
                .get_or_init(|| self.engine.jit.prepare(&self.function)),
        }
    }
}

impl Callable for Counted {
    /// That of the last call.
    fn engine(&self) -> &'static str {
        self.code.get().unwrap_or(&self.tape).engine()
    }

    fn results(&self) -> usize {
        self.tape.results()
    }

    fn call(&self, from: &CallArguments<'_>, out: &mut [f64]) -> Status {
        self.next().call(from, out)
    }
}

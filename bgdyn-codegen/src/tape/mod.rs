//! An engine without a compiler: functions as tapes.
//!
//! A tape is a list of instructions over a dense array of values. A function is unrolled to one list
//! (`unrolled.rs`), ordered into runs of one operation (`order.rs`), and its operands become indices
//! ([`Program`]). Signs, blocks, columns and dead nodes are resolved once, not in each call. The results have
//! the bits of [`Function::evaluate`]. Other engines read the unrolled list ([`Unrolled`]).

mod code;
mod operation;
mod order;
mod program;
mod run;
mod unrolled;

use std::cell::RefCell;

pub use operation::Operation;
pub use program::Program;
pub use unrolled::{ArgumentArray, Instruction, Unrolled, ValueSource};

use crate::engine::{CallArguments, Callable, Engine, Status};
use crate::function::Function;

/// The engine that prepares tapes in `f64`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tape;

/// The name of the engine.
const NAME: &str = "tape";

impl Engine for Tape {
    fn name(&self) -> &'static str {
        NAME
    }

    fn prepare(&self, function: &Function) -> Box<dyn Callable> {
        let program = Program::new(function);
        Box::new(TapeCall {
            constants: program.constants(),
            program,
        })
    }
}

thread_local! {
    /// Memory for the values of a call. Each thread has its own.
    static VALUES: RefCell<Vec<f64>> = const { RefCell::new(Vec::new()) };
}

/// A tape with its constants.
#[derive(Debug)]
struct TapeCall {
    program: Program,
    constants: Vec<f64>,
}

impl Callable for TapeCall {
    fn engine(&self) -> &'static str {
        NAME
    }

    fn results(&self) -> usize {
        self.program.results()
    }

    fn call(&self, from: &CallArguments<'_>, out: &mut [f64]) -> Status {
        let refused =
            VALUES.with_borrow_mut(|values| self.program.call(&self.constants, values, from, out));
        Status::of(refused, out)
    }
}

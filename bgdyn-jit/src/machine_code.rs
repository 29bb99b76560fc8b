//! A function as machine code.

use bgdyn_codegen::engine::{CallArguments, Callable, Status};
use bgdyn_codegen::tape::{ArgumentArray, Unrolled};
use cranelift_codegen::Context;
use cranelift_codegen::control::ControlPlane;
use cranelift_codegen::isa::TargetIsa;

use crate::code_memory::{Code, CodeMemory};
use crate::refusal::Refusal;
use crate::translation::translate;

/// The name of the engine.
pub(crate) const NAME: &str = "machine code";

/// A function as machine code. Its memory is freed when it is dropped.
#[derive(Debug)]
pub struct MachineCode {
    code: CodeMemory,
    /// Computes the states that the code leaves to it.
    tape: Box<dyn Callable>,
}

/// Makes machine code of a list of instructions.
pub(crate) fn made(
    list: &Unrolled,
    isa: &dyn TargetIsa,
    fused: bool,
) -> Result<CodeMemory, Refusal> {
    let mut context = Context::for_function(translate(list, isa, fused));
    let compiled = context
        .compile(isa, &mut ControlPlane::default())
        .map_err(|e| Refusal::Compiler(e.inner.to_string()))?;
    if !compiled.buffer.relocs().is_empty() {
        // An operation for which this processor has no instruction: Cranelift would call a library.
        let why = "an operation has no instruction on this processor";
        return Err(Refusal::Compiler(why.into()));
    }
    let code = Code {
        bytes: compiled.code_buffer(),
        arguments: list.arguments,
        results: list.results.len(),
    };
    CodeMemory::new(&code).map_err(Refusal::Memory)
}

impl MachineCode {
    /// Returns a function from its code; `tape` computes the same function.
    pub(crate) fn new(code: CodeMemory, tape: Box<dyn Callable>) -> Self {
        MachineCode { code, tape }
    }

    /// Calls the code alone, and returns whether it computed the results. It leaves to the tape what is rare: angles beyond
    /// the limit of the kernel of sines, refused pivots, results that are not finite or have no finite sum.
    ///
    /// # Panics
    /// As [`Callable::call`].
    pub fn call_alone(&self, from: &CallArguments<'_>, out: &mut [f64]) -> bool {
        self.code.call(ArgumentArray::all(from), out)
    }

    /// Returns the size of the code with its constants, in bytes.
    pub fn bytes(&self) -> usize {
        self.code.len()
    }
}

impl Callable for MachineCode {
    fn engine(&self) -> &'static str {
        NAME
    }

    fn results(&self) -> usize {
        self.code.results()
    }

    fn call(&self, from: &CallArguments<'_>, out: &mut [f64]) -> Status {
        match self.call_alone(from, out) {
            true => Status::Done,
            false => self.tape.call(from, out),
        }
    }
}

//! The engine that makes machine code of every function.

use std::fmt;
use std::sync::Arc;

use bgdyn_codegen::engine::{Callable, Engine};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::tape::{Tape, Unrolled};
use cranelift_codegen::isa::TargetIsa;

use crate::code_memory::CodeMemory;
use crate::host::{self, Registers};
use crate::machine_code::{MachineCode, NAME, made};
use crate::refusal::{MOST_INSTRUCTIONS, Refusal};

/// Up to so many instructions the search for registers takes at most a tenth of a second.
const SEARCHED: usize = 4_000;

/// The engine that makes machine code for the processor that runs.
#[derive(Clone)]
pub struct Jit {
    /// For functions up to `searched` instructions, and for longer ones.
    short: Arc<dyn TargetIsa>,
    long: Arc<dyn TargetIsa>,
    searched: usize,
    /// Whether a product and a sum are rounded once.
    fused: bool,
}

impl Jit {
    /// Returns the engine with the bits of `f64` in this build.
    ///
    /// # Errors
    /// The reason why machine code cannot be had here: the processor, the operating system, or refused memory.
    pub fn new() -> Result<Self, Refusal> {
        Jit::with(bgdyn_runtime::kernel::FUSES)
    }

    /// Returns the engine with fused operations: the bits of a build for this processor (`-C target-cpu=native`), however
    /// this one was built. States that are left to the tape have the bits of this build.
    ///
    /// # Errors
    /// As [`Jit::new`], and if the processor has no fused operations.
    pub fn fused() -> Result<Self, Refusal> {
        match host::can_fuse() {
            true => Jit::with(true),
            false => Err(Refusal::Host("the processor has no fused operations")),
        }
    }

    fn with(fused: bool) -> Result<Self, Refusal> {
        let jit = Jit {
            short: host::isa(Registers::Searched)?,
            long: host::isa(Registers::InOnePass)?,
            searched: SEARCHED,
            fused,
        };
        // Memory may be refused: better now than by every function.
        let nothing = jit.made(&Unrolled::default())?;
        match nothing.call(Default::default(), &mut []) {
            true => Ok(jit),
            false => Err(Refusal::Host("a function without results failed")),
        }
    }

    /// Returns the engine that makes all code in the shortest time, as it otherwise does for functions of more than 4,000
    /// instructions: registers are given in one pass, many times as fast, and the code takes up to four times as long.
    #[must_use]
    pub fn making_quickly(self) -> Self {
        Jit {
            searched: 0,
            ..self
        }
    }

    fn made(&self, list: &Unrolled) -> Result<CodeMemory, Refusal> {
        let is_short = list.instructions.len() <= self.searched;
        let isa = if is_short { &self.short } else { &self.long };
        made(list, &**isa, self.fused)
    }

    /// Makes machine code for a function.
    ///
    /// # Errors
    /// The reason why there is none: its size, or what Cranelift or the operating system says.
    pub fn compile(&self, function: &Function) -> Result<MachineCode, Refusal> {
        let list = Unrolled::new(function);
        let instructions = list.instructions.len();
        if instructions > MOST_INSTRUCTIONS {
            return Err(Refusal::TooLarge { instructions });
        }
        let code = self.made(&list)?;
        Ok(MachineCode::new(code, Tape.prepare(function)))
    }
}

impl fmt::Debug for Jit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let target = self.short.triple().to_string();
        f.debug_struct("Jit")
            .field("target", &target)
            .field("fused", &self.fused)
            .finish()
    }
}

impl Engine for Jit {
    fn name(&self) -> &'static str {
        NAME
    }

    fn prepare(&self, function: &Function) -> Box<dyn Callable> {
        match self.compile(function) {
            Ok(code) => Box::new(code),
            Err(_) => Tape.prepare(function),
        }
    }
}

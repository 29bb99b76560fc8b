//! An engine that makes machine code at run time, by Cranelift.
//!
//! A function's unrolled list of instructions ([`bgdyn_codegen::tape::Unrolled`]) becomes one block of SSA values
//! (`translation.rs`), with the runtime's kernel of sines written into it (`pairs.rs`), and Cranelift makes code of it for
//! the processor that runs (`host.rs`). A call has the bits of [`Function::evaluate`], as that of the
//! [tape](bgdyn_codegen::tape) has.
//!
//! The code has no branch for what is rare. An angle beyond the limit of the kernel, a refused pivot, or a result that is
//! not finite sets the word that it returns, and the tape computes that state once more: it knows what happened.
//!
//! Where machine code cannot be had, [`Jit::new`] or [`Jit::compile`] give the reason, and [`Engine::prepare`] leaves the
//! function to the tape; [`Callable::engine`] tells which of them computes.
//!
//! ```
//! use bgdyn_codegen::engine::{CallArguments, Engine};
//! use bgdyn_codegen::{method::Method, options::Options, selection};
//! use bgdyn_jit::Jit;
//!
//! let spec = std::fs::read_to_string("../specs/double_pendulum.yaml").expect("the spec");
//! let (mechanism, _faults) = bgdyn_codegen::read(&spec, Some("double_pendulum"));
//! let mechanism = mechanism.expect("sound");
//! let gravity = selection::function(&mechanism, Method::Gravity, &Options::default()).expect("known");
//! let engine = Jit::new().expect("machine code can be had here");
//! let gravity = engine.prepare(&gravity);
//! let at = CallArguments { q: &[0.0, 0.0], ..CallArguments::default() };
//! println!("{}: {:?}", gravity.engine(), gravity.value(&at));
//! ```

mod code_memory;
mod elementary;
mod host;
mod machine_code;
mod often_called;
mod pairs;
mod refusal;
mod sines;
mod translation;

use std::fmt;
use std::sync::Arc;

use bgdyn_codegen::engine::{Callable, Engine};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::tape::{Tape, Unrolled};
use cranelift_codegen::isa::TargetIsa;

pub use machine_code::MachineCode;
pub use often_called::OftenCalled;
pub use refusal::{MOST_INSTRUCTIONS, Refusal};

use code_memory::CodeMemory;
use host::Registers;
use machine_code::{NAME, made};

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

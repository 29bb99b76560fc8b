//! An engine that makes machine code at run time, by Cranelift.
//!
//! A function's unrolled list of instructions ([`bgdyn_codegen::tape::Unrolled`]) becomes one block of SSA values
//! (`translation.rs`), with the runtime's kernel of sines written into it (`pairs.rs`), and Cranelift makes code of it for
//! the processor that runs (`host.rs`). A call has the bits of [`evaluate`](bgdyn_codegen::function::Function::evaluate), as that of the
//! [tape](bgdyn_codegen::tape) has.
//!
//! The code has no branch for what is rare. An angle beyond the limit of the kernel, a refused pivot, or a result that is
//! not finite sets the word that it returns, and the tape computes that state once more: it knows what happened.
//!
//! Where machine code cannot be had, [`Jit::new`] or [`Jit::compile`] give the reason, and
//! [`prepare`](bgdyn_codegen::engine::Engine::prepare) leaves the function to the tape;
//! [`engine`](bgdyn_codegen::engine::Callable::engine) tells which of them computes. [`OftenCalled`] makes code of those
//! functions only that are called often.
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
mod jit;
mod machine_code;
mod often_called;
mod pairs;
mod refusal;
mod sines;
mod translation;

pub use jit::Jit;
pub use machine_code::MachineCode;
pub use often_called::OftenCalled;
pub use refusal::{MOST_INSTRUCTIONS, Refusal};

//! Why there is no machine code.

use std::error::Error;
use std::{fmt, io};

/// Functions with more instructions are left to the tape: their code would be some megabytes, far more than a processor
/// keeps at hand.
pub const MOST_INSTRUCTIONS: usize = 50_000;

/// The reason why there is no machine code.
#[derive(Debug)]
pub enum Refusal {
    /// The processor or the operating system.
    Host(&'static str),
    /// The function has more than [`MOST_INSTRUCTIONS`].
    TooLarge {
        /// Their number.
        instructions: usize,
    },
    /// Cranelift's reason.
    Compiler(String),
    /// The operating system gives no memory for code.
    Memory(io::Error),
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refusal::Host(why) => f.write_str(why),
            Refusal::TooLarge { instructions } => write!(
                f,
                "{instructions} instructions are more than {MOST_INSTRUCTIONS}"
            ),
            Refusal::Compiler(why) => write!(f, "Cranelift: {why}"),
            Refusal::Memory(why) => write!(f, "no memory for machine code: {why}"),
        }
    }
}

impl Error for Refusal {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Refusal::Memory(why) => Some(why),
            _ => None,
        }
    }
}

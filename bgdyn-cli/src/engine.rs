//! The engines that compute functions for the commands.

use std::collections::BTreeMap;

use anyhow::{Result, anyhow};
use bgdyn_codegen::engine::{Callable, Engine};
use bgdyn_codegen::tape::Tape;
use clap::{Args, ValueEnum};

use crate::output::tell;

/// The words of the option.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum EngineName {
    /// The tape at first, machine code for functions that are called often
    #[default]
    Auto,
    /// Machine code, made at run time
    Jit,
    /// Lists of operations
    Tape,
}

/// The option `--engine`.
#[derive(Args)]
pub(crate) struct EngineChoice {
    /// What computes the functions. The numbers do not depend on it
    #[arg(
        long,
        value_enum,
        value_name = "NAME",
        default_value_t,
        hide_possible_values = true,
        long_help = "What computes the functions: `jit`, machine code made at run time; `tape`, lists of operations; `auto`, the tape at first, and machine code, where it can be had, from the ten thousandth call of a function. The numbers do not depend on it"
    )]
    engine: EngineName,
}

impl EngineChoice {
    /// Returns the engine.
    ///
    /// # Errors
    /// If machine code is asked for, and cannot be had: why.
    pub(crate) fn engine(&self) -> Result<Box<dyn Engine>> {
        match self.engine {
            EngineName::Tape => Ok(Box::new(Tape)),
            EngineName::Jit => machine_code().map_err(|why| anyhow!("no machine code: {why}")),
            EngineName::Auto => Ok(often_called()),
        }
    }

    /// Says what computed a function, unless nobody asked and it is the tape.
    pub(crate) fn tell(&self, function: &dyn Callable) {
        let name = function.engine();
        if self.engine != EngineName::Auto || name != Tape.name() {
            tell(&format!("bgdyn: computed by {name}\n"));
        }
    }
}

/// About so many calls of a function take on the tape the time in which its machine code is made.
#[cfg(feature = "jit")]
const PAYS: usize = 10_000;

/// Returns the engine that makes machine code of functions after [`PAYS`] calls, or the tape where there is no machine code.
#[cfg(feature = "jit")]
pub(crate) fn often_called() -> Box<dyn Engine> {
    match bgdyn_jit::Jit::new() {
        Ok(jit) => Box::new(bgdyn_jit::OftenCalled::after(PAYS, jit)),
        Err(_) => Box::new(Tape),
    }
}

/// Returns the tape.
#[cfg(not(feature = "jit"))]
pub(crate) fn often_called() -> Box<dyn Engine> {
    Box::new(Tape)
}

/// Returns the engine that makes machine code, or why there is none.
#[cfg(feature = "jit")]
fn machine_code() -> Result<Box<dyn Engine>, bgdyn_jit::Refusal> {
    bgdyn_jit::Jit::new().map(|engine| Box::new(engine) as Box<dyn Engine>)
}

/// Says why there is none.
#[cfg(not(feature = "jit"))]
fn machine_code() -> Result<Box<dyn Engine>, &'static str> {
    Err("this command was built without its feature `jit`")
}

/// Returns what computed functions until now, in words: with the numbers of functions, if it was not one engine for all.
pub(crate) fn engines_of<'a>(functions: impl Iterator<Item = &'a dyn Callable>) -> String {
    let mut counts = BTreeMap::new();
    for function in functions {
        *counts.entry(function.engine()).or_insert(0) += 1;
    }
    let in_words = |(name, count): (&str, u32)| match count {
        1 => format!("{name} (1 function)"),
        _ => format!("{name} ({count} functions)"),
    };
    match counts.len() {
        1 => counts.into_keys().collect(),
        _ => counts
            .into_iter()
            .map(in_words)
            .collect::<Vec<_>>()
            .join(" and "),
    }
}

//! The engines that compute functions for the commands `eval`, `simulate` and `accuracy`.

use anyhow::{Result, anyhow};
use bgdyn_codegen::engine::{Callable, Engine};
use bgdyn_codegen::tape::Tape;
use clap::{Args, ValueEnum};

use crate::output::tell;

/// The words of the option.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum EngineName {
    /// Machine code where it can be had and pays, else the tape
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
        long_help = "What computes the functions: `jit`, machine code made at run time; `tape`, lists of operations; `auto`, machine code where it can be had and pays. The numbers do not depend on it"
    )]
    engine: EngineName,
}

impl EngineChoice {
    /// Returns the engine for functions that are called often.
    ///
    /// # Errors
    /// If machine code is asked for, and cannot be had: why.
    pub(crate) fn engine(&self) -> Result<Box<dyn Engine>> {
        match (self.engine, machine_code()) {
            (EngineName::Tape, _) => Ok(Box::new(Tape)),
            (EngineName::Jit, Err(why)) => Err(anyhow!("no machine code: {why}")),
            (EngineName::Auto, Err(_)) => Ok(Box::new(Tape)),
            (_, Ok(engine)) => Ok(engine),
        }
    }

    /// Returns the engine for functions that are called this often: machine code pays after [`PAYS`] calls.
    ///
    /// # Errors
    /// As [`EngineChoice::engine`].
    pub(crate) fn engine_for(&self, calls: usize) -> Result<Box<dyn Engine>> {
        match self.engine {
            EngineName::Auto if calls < PAYS => Ok(Box::new(Tape)),
            _ => self.engine(),
        }
    }

    /// Says what computes a function, unless nobody asked and it is the tape.
    pub(crate) fn tell(&self, function: &dyn Callable) {
        let name = function.engine();
        if self.engine != EngineName::Auto || name != Tape.name() {
            tell(&format!("bgdyn: computed by {name}\n"));
        }
    }
}

/// About so many calls of a function take on the tape the time in which its machine code is made.
const PAYS: usize = 10_000;

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

/// What computes the functions of a scene.
#[derive(Clone, Debug, Default)]
pub(crate) struct EnginesUsed(Vec<(&'static str, usize)>);

impl EnginesUsed {
    /// Counts a function.
    pub(crate) fn note(&mut self, function: &dyn Callable) {
        let name = function.engine();
        match self.0.iter_mut().find(|(known, _)| *known == name) {
            Some((_, count)) => *count += 1,
            None => self.0.push((name, 1)),
        }
    }

    /// Returns the engine in words: both with the numbers of their functions, if one left some to the other.
    pub(crate) fn words(&self) -> String {
        match &self.0[..] {
            [(name, _)] => (*name).to_owned(),
            all => {
                let one = |(name, count): &(&str, usize)| format!("{name} ({count} functions)");
                all.iter().map(one).collect::<Vec<_>>().join(" and ")
            }
        }
    }
}

//! What computes functions at run time, without a compiler: engines, and the functions that they prepare.

use std::fmt::Debug;

use crate::expr::Inputs;
use crate::function::Function;

/// The arguments of a call, in SI units. A function reads only some of them; the others may be empty.
#[derive(Clone, Copy, Debug)]
pub struct CallArguments<'a, T = f64> {
    /// Positions.
    pub q: &'a [T],
    /// Velocities; momenta for functions of the canonical form.
    pub v: &'a [T],
    /// Accelerations.
    pub a: &'a [T],
    /// First-order states.
    pub x: &'a [T],
    /// Inputs: joint efforts first.
    pub u: &'a [T],
    /// Modes.
    pub modes: &'a [T],
    /// Run-time parameters.
    pub parameters: &'a [T],
    /// Time, s.
    pub t: Option<T>,
}

impl<T> Default for CallArguments<'_, T> {
    fn default() -> Self {
        CallArguments {
            q: &[],
            v: &[],
            a: &[],
            x: &[],
            u: &[],
            modes: &[],
            parameters: &[],
            t: None,
        }
    }
}

impl<'a, T: Copy> From<&'a Inputs<T>> for CallArguments<'a, T> {
    fn from(inputs: &'a Inputs<T>) -> Self {
        CallArguments {
            q: &inputs.q,
            v: &inputs.v,
            a: &inputs.a,
            x: &inputs.x,
            u: &inputs.u,
            modes: &inputs.modes,
            parameters: &inputs.parameters,
            t: inputs.t,
        }
    }
}

/// How a call ended. The results are written in every case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// All results are finite, and no pivot was refused.
    Done,
    /// The first refused pivot: its joint, or the number of a loop after them, as in [`crate::expr::Node::Pivot`].
    Refused(usize),
    /// No pivot was refused; the result with this index is the first one that is NaN or infinite.
    NotFinite(usize),
}

impl Status {
    /// Returns the status of a call with these results.
    pub fn of(refused: Option<usize>, results: &[f64]) -> Self {
        match (refused, results.iter().position(|x| !x.is_finite())) {
            (Some(joint), _) => Status::Refused(joint),
            (None, Some(index)) => Status::NotFinite(index),
            (None, None) => Status::Done,
        }
    }

    /// Returns the refused pivot.
    pub fn refused(self) -> Option<usize> {
        match self {
            Status::Refused(joint) => Some(joint),
            Status::Done | Status::NotFinite(_) => None,
        }
    }
}

/// A function of a mechanism or a scene, ready to be called from any thread.
pub trait Callable: Debug + Send + Sync {
    /// Returns the name of the engine that computes it: not that of the one which was asked to prepare it, if that one
    /// left it to another.
    fn engine(&self) -> &'static str;

    /// Returns the number of results.
    fn results(&self) -> usize;

    /// Computes the results in the order of [`Function::evaluate`], with the same bits.
    ///
    /// # Panics
    /// If `from` lacks a component that the function reads, or `out` has not [`Callable::results`] numbers.
    fn call(&self, from: &CallArguments<'_>, out: &mut [f64]) -> Status;

    /// Does the same, and returns the results.
    ///
    /// # Panics
    /// If `from` lacks a component that the function reads.
    fn value(&self, from: &CallArguments<'_>) -> (Vec<f64>, Status) {
        let mut out = vec![0.0; self.results()];
        let status = self.call(from, &mut out);
        (out, status)
    }
}

/// A way to compute functions without a compiler.
pub trait Engine: Debug + Send + Sync {
    /// Returns its name, in words for people.
    fn name(&self) -> &'static str;

    /// Prepares a function, once for all calls.
    fn prepare(&self, function: &Function) -> Box<dyn Callable>;
}

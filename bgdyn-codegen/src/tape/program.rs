//! A function as runs of instructions over a dense array of values, for any scalar.
//!
//! The array has constants first, then arguments, then the values of the instructions in the order of
//! execution: an instruction has operands, but no destination.

use bgdyn_runtime::{Dd, Scalar};

use super::code::{Run, SineSum, TapeCode};
use super::operation::Operation;
use super::order::{OrderedRun, runs};
use super::run::Execution;
use super::unrolled::{ArgumentArray, Instruction, Unrolled, ValueSource};
use crate::engine::CallArguments;
use crate::function::Function;

/// A function that is prepared for calls.
#[derive(Clone, Debug)]
pub struct Program {
    code: TapeCode,
    constants: Vec<Dd>,
    arguments: [usize; ArgumentArray::COUNT],
    /// The number of values.
    len: usize,
    results: Vec<u32>,
}

impl Program {
    /// Prepares a function.
    pub fn new(function: &Function) -> Self {
        let list = Unrolled::new(function);
        let runs = runs(&list);
        let indices = Indices::new(&list, &runs);
        let members = || runs.iter().flat_map(|run| &run.members);
        let instructions = members().map(|&i| &list.instructions[i as usize]);
        let operands = instructions
            .clone()
            .flat_map(|one| &list.operands[one.operands.clone()]);
        let of = |operation| {
            let all = instructions.clone();
            all.filter(move |one| one.operation == operation)
        };
        let sum = |one: &Instruction| SineSum {
            terms: one.operands.len() as u32,
            offset: list.offsets[one.detail],
        };
        let code = TapeCode {
            runs: runs.iter().map(OrderedRun::of_tape).collect(),
            operands: operands.map(|&operand| indices.of(operand)).collect(),
            sums: of(Operation::Sines).map(sum).collect(),
            joints: of(Operation::Pivot).map(|one| one.detail).collect(),
        };
        Program {
            code,
            arguments: list.arguments,
            len: indices.len,
            results: list.results.iter().map(|&r| indices.of(r)).collect(),
            constants: list.constants,
        }
    }

    /// Returns the number of results.
    pub fn results(&self) -> usize {
        self.results.len()
    }

    /// Returns the constants in a scalar, for [`Program::call`].
    pub fn constants<T: Scalar>(&self) -> Vec<T> {
        let constant = |c: &Dd| T::from_parts(c.hi(), c.lo());
        self.constants.iter().map(constant).collect()
    }

    /// Computes the results, and returns the refused pivots. `values` is memory: its contents do not matter.
    ///
    /// # Panics
    /// If `from` lacks a component that the function reads, `out` has not [`Program::results`] numbers, or the
    /// constants are those of another function.
    pub fn call<T: Scalar>(
        &self,
        constants: &[T],
        values: &mut Vec<T>,
        from: &CallArguments<'_, T>,
        out: &mut [T],
    ) -> T::Refused {
        if values.len() < self.len {
            values.resize(self.len, T::from_f64(0.0));
        }
        let values = &mut values[..self.len];
        let first = self.load(constants, values, from);
        let refused = Execution::new(&self.code, values, first).all();
        assert_eq!(out.len(), self.results.len(), "the number of results");
        for (out, &index) in out.iter_mut().zip(&self.results) {
            *out = values[index as usize];
        }
        refused
    }

    /// Computes the results, and the refused pivots.
    ///
    /// # Panics
    /// If `from` lacks a component that the function reads.
    pub fn value<T: Scalar>(&self, from: &CallArguments<'_, T>) -> (Vec<T>, T::Refused) {
        let mut out = vec![T::from_f64(0.0); self.results.len()];
        let refused = self.call(&self.constants(), &mut Vec::new(), from, &mut out);
        (out, refused)
    }

    /// Copies constants and arguments to the values, and returns their number.
    fn load<T: Scalar>(
        &self,
        constants: &[T],
        values: &mut [T],
        from: &CallArguments<'_, T>,
    ) -> usize {
        let mut end = constants.len();
        values[..end].copy_from_slice(constants);
        for (array, count) in ArgumentArray::all(from).into_iter().zip(self.arguments) {
            // Most functions read two or three arrays.
            if count > 0 {
                values[end..end + count].copy_from_slice(&array[..count]);
                end += count;
            }
        }
        end
    }
}

impl OrderedRun {
    fn of_tape(&self) -> Run {
        Run {
            operation: self.operation,
            count: self.members.len() as u32,
        }
    }
}

/// The indices of values in the array.
struct Indices {
    /// The first component of each array of arguments.
    arguments: [usize; ArgumentArray::COUNT],
    /// The first value of each instruction.
    instructions: Vec<u32>,
    /// The number of values.
    len: usize,
}

impl Indices {
    fn new(list: &Unrolled, runs: &[OrderedRun]) -> Self {
        let mut len = list.constants.len();
        let arguments = list.arguments.map(|count| {
            len += count;
            len - count
        });
        let mut instructions = vec![0; list.instructions.len()];
        for run in runs {
            for &i in &run.members {
                instructions[i as usize] = len as u32;
                len += run.operation.values();
            }
        }
        Indices {
            arguments,
            instructions,
            len,
        }
    }

    fn of(&self, source: ValueSource) -> u32 {
        match source {
            ValueSource::Constant(i) => i,
            ValueSource::Argument(array, i) => self.arguments[array as usize] as u32 + i,
            ValueSource::Result(i) => self.instructions[i as usize],
            ValueSource::Cosine(i) => self.instructions[i as usize] + 1,
        }
    }
}

//! The instructions of a tape as data.

use super::operation::Operation;

/// Consecutive instructions with the same operation, none of which reads another one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub operation: Operation,
    /// The number of instructions.
    pub count: u32,
}

/// The sum of angles of a sine and its cosine.
#[derive(Clone, Copy, Debug)]
pub(super) struct SineSum {
    /// The number of its terms among the operands.
    pub terms: u32,
    /// The constant in it, rad.
    pub offset: (f64, f64),
}

/// The instructions in the order of execution.
#[derive(Clone, Debug)]
pub(super) struct TapeCode {
    pub runs: Vec<Run>,
    /// Indices of the operands, instruction by instruction.
    pub operands: Vec<u32>,
    /// The sums of angles.
    pub sums: Vec<SineSum>,
    /// The joints of the pivots.
    pub joints: Vec<usize>,
}

//! The order of instructions on a tape: those with the same operation that do not read each other form a run.
//!
//! A run is one loop, so that the tape decides what to do once per run instead of once per operation. The
//! order of operations does not change any value. Pivots keep their order: the first refused one is
//! reported.

use super::operation::Operation;
use super::unrolled::{Unrolled, ValueSource};

/// Instructions with the same operation, none of which reads another one.
#[derive(Debug)]
pub(super) struct OrderedRun {
    pub operation: Operation,
    /// Indices of the instructions.
    pub members: Vec<u32>,
}

/// Returns the runs in the order of execution: always the operation that most instructions are ready for.
pub(super) fn runs(list: &Unrolled) -> Vec<OrderedRun> {
    let mut waiting = Waiting::new(list);
    let mut runs = Vec::new();
    while let Some(members) = waiting.largest() {
        let operation = list.instructions[members[0] as usize].operation;
        members.iter().for_each(|&i| waiting.finish(list, i));
        runs.push(OrderedRun { operation, members });
    }
    runs
}

/// The instructions that are not on the tape yet.
struct Waiting {
    /// For each instruction, the number of operands that are not computed.
    missing: Vec<u32>,
    /// For each instruction, its readers: a range of `readers`.
    starts: Vec<u32>,
    readers: Vec<u32>,
    /// The instructions whose operands are computed, by operation.
    ready: [Vec<u32>; Operation::COUNT],
}

impl Waiting {
    fn new(list: &Unrolled) -> Self {
        let pairs = dependences(list);
        let count = list.instructions.len();
        let mut missing = vec![0; count];
        let mut starts = vec![0; count + 1];
        for &(read, reader) in &pairs {
            missing[reader as usize] += 1;
            starts[read as usize + 1] += 1;
        }
        for i in 0..count {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut readers = vec![0; pairs.len()];
        for &(read, reader) in &pairs {
            let at = &mut next[read as usize];
            readers[*at as usize] = reader;
            *at += 1;
        }
        let mut ready = [const { Vec::new() }; Operation::COUNT];
        for i in (0..count).filter(|&i| missing[i] == 0) {
            ready[list.instructions[i].operation as usize].push(i as u32);
        }
        Waiting {
            missing,
            starts,
            readers,
            ready,
        }
    }

    /// Takes the instructions that are ready, of the operation with most of them.
    fn largest(&mut self) -> Option<Vec<u32>> {
        let largest = self.ready.iter_mut().max_by_key(|all| all.len())?;
        (!largest.is_empty()).then(|| std::mem::take(largest))
    }

    /// Notes that an instruction is on the tape.
    fn finish(&mut self, list: &Unrolled, i: u32) {
        let [from, to] = [i, i + 1].map(|k| self.starts[k as usize] as usize);
        for &reader in &self.readers[from..to] {
            let missing = &mut self.missing[reader as usize];
            *missing -= 1;
            if *missing == 0 {
                let operation = list.instructions[reader as usize].operation;
                self.ready[operation as usize].push(reader);
            }
        }
    }
}

/// Returns pairs of an instruction and one that must follow it.
fn dependences(list: &Unrolled) -> Vec<(u32, u32)> {
    let mut pairs = Vec::with_capacity(list.operands.len());
    let mut last_pivot = None;
    for (i, instruction) in (0..).zip(&list.instructions) {
        for operand in &list.operands[instruction.operands.clone()] {
            if let ValueSource::Result(k) | ValueSource::Cosine(k) = *operand {
                pairs.push((k, i));
            }
        }
        if instruction.operation == Operation::Pivot {
            pairs.extend(last_pivot.replace(i).map(|last| (last, i)));
        }
    }
    pairs
}

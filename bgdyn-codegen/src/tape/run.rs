//! Runs the instructions of a tape.

use bgdyn_runtime::Scalar;

use super::code::{Run, SineSum, TapeCode};
use super::operation::Operation;

/// The largest number of sines that are computed together.
const BATCH: usize = 8;

/// A tape while it runs.
pub(super) struct Execution<'a, T: Scalar> {
    runs: &'a [Run],
    /// The values, of which the first `done` are known.
    values: &'a mut [T],
    done: usize,
    /// What later instructions read.
    operands: &'a [u32],
    sums: &'a [SineSum],
    joints: &'a [usize],
    refused: T::Refused,
}

impl<'a, T: Scalar> Execution<'a, T> {
    /// Returns the tape before its first instruction; the first `done` values are known.
    pub fn new(code: &'a TapeCode, values: &'a mut [T], done: usize) -> Self {
        Execution {
            runs: &code.runs,
            values,
            done,
            operands: &code.operands,
            sums: &code.sums,
            joints: &code.joints,
            refused: T::none_refused(),
        }
    }

    /// Runs all instructions, and returns the refused pivots.
    pub fn all(mut self) -> T::Refused {
        for run in self.runs {
            self.run(run.operation, run.count as usize);
        }
        self.refused
    }

    fn run(&mut self, operation: Operation, count: usize) {
        match operation {
            Operation::Negate => self.each(count, |[a]| -a),
            Operation::Add => self.each(count, |[a, b]| a + b),
            Operation::Subtract => self.each(count, |[a, b]| a - b),
            Operation::Multiply => self.each(count, |[a, b]| a * b),
            Operation::Divide => self.each(count, |[a, b]| a / b),
            Operation::MultiplyAdd => self.each(count, |[a, b, c]: [T; 3]| a.mul_add(b, c)),
            Operation::MultiplySubtract => self.each(count, |[a, b, c]: [T; 3]| a.mul_add(b, -c)),
            Operation::NegativeMultiplyAdd => {
                self.each(count, |[a, b, c]: [T; 3]| (-a).mul_add(b, c));
            }
            Operation::NegativeMultiplySubtract => {
                self.each(count, |[a, b, c]: [T; 3]| (-a).mul_add(b, -c));
            }
            Operation::SquareRoot => self.each(count, |[a]: [T; 1]| a.sqrt()),
            Operation::Sines => self.sines(count),
            Operation::Exponential => self.each(count, |[a]: [T; 1]| a.exp()),
            Operation::Logarithm => self.each(count, |[a]: [T; 1]| a.ln()),
            Operation::HyperbolicTangent => self.each(count, |[a]: [T; 1]| a.tanh()),
            Operation::Absolute => self.each(count, |[a]: [T; 1]| a.abs()),
            Operation::Minimum => self.each(count, |[a, b]: [T; 2]| a.min(b)),
            Operation::Maximum => self.each(count, |[a, b]: [T; 2]| a.max(b)),
            Operation::Sign => self.each(count, |[a]: [T; 1]| a.sign()),
            Operation::Select => {
                self.each(count, |[a, b, c, d]: [T; 4]| T::select(a.less(b), c, d));
            }
            Operation::Pivot => self.pivots(count),
        }
    }

    /// Computes instructions of N operands.
    #[inline(always)]
    fn each<const N: usize>(&mut self, count: usize, compute: impl Fn([T; N]) -> T) {
        let operands = self.take_operands(N * count);
        let (known, rest) = self.values.split_at_mut(self.done);
        let (operands, _) = operands.as_chunks::<N>();
        for (value, operands) in rest.iter_mut().zip(operands) {
            *value = compute(operands.map(|i| known[i as usize]));
        }
        self.done += count;
    }

    fn pivots(&mut self, count: usize) {
        let (joints, later) = self.joints.split_at(count);
        self.joints = later;
        for &joint in joints {
            let [value, magnitude] = [0, 1].map(|k| self.values[self.operands[k] as usize]);
            self.take_operands(2);
            self.values[self.done] = value.checked_pivot(magnitude, joint, &mut self.refused);
            self.done += 1;
        }
    }

    /// Computes sines and cosines, several at once.
    fn sines(&mut self, mut count: usize) {
        while count > 0 {
            count -= match count {
                BATCH.. => self.batch::<BATCH>(),
                4.. => self.batch::<4>(),
                2.. => self.batch::<2>(),
                _ => self.batch::<1>(),
            };
        }
    }

    /// Computes K sines and cosines, and returns K.
    fn batch<const K: usize>(&mut self) -> usize {
        let (sums, later) = self.sums.split_at(K);
        self.sums = later;
        let terms = sums.iter().map(|sum| sum.terms as usize).sum();
        let operands = self.take_operands(terms);
        let angles = operands.iter().map(|&i| self.values[i as usize]);
        // Most sums are single angles.
        let mut few = [T::from_f64(0.0); BATCH];
        let many: Vec<T>;
        let angles: &[T] = if terms <= BATCH {
            few.iter_mut().zip(angles).for_each(|(to, x)| *to = x);
            &few[..terms]
        } else {
            many = angles.collect();
            &many
        };
        let mut from = 0;
        let angles: [&[T]; K] = std::array::from_fn(|k| {
            let begin = from;
            from += sums[k].terms as usize;
            &angles[begin..from]
        });
        let found = T::sin_cos_all(angles, std::array::from_fn(|k| sums[k].offset));
        for (k, (sine, cosine)) in found.into_iter().enumerate() {
            self.values[self.done + 2 * k] = sine;
            self.values[self.done + 2 * k + 1] = cosine;
        }
        self.done += 2 * K;
        K
    }

    /// Returns the operands of the next instructions.
    fn take_operands(&mut self, count: usize) -> &'a [u32] {
        let (operands, later) = self.operands.split_at(count);
        self.operands = later;
        operands
    }
}

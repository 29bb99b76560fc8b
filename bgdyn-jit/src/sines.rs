//! Sines and cosines of sums of angles, two sums at once.

use bgdyn_codegen::tape::{Instruction, Operation, Unrolled, ValueSource};
use bgdyn_runtime::kernel::{SineLanes, sin_cos_in_range};
use cranelift_codegen::ir::{InstBuilder, Value};

use crate::pairs::{Body, Pair};

/// A sum of angles in two words.
pub(crate) struct AngleSum {
    /// The sum, rounded.
    angle: Value,
    /// Its rounding error, if it has more than one term.
    tail: Option<Value>,
    /// Whether it has more than two terms: then its rounding error can be large.
    long: bool,
}

impl AngleSum {
    /// Adds angles and a constant as the runtime does (its `exact_sum`): Knuth's two-sum, with the errors of earlier
    /// additions added to the shorter of its two paths.
    pub(crate) fn new(body: &Body<'_>, angles: &[Value], (hi, lo): (f64, f64)) -> Self {
        let constant = |x| body.add(|f| f.ins().f64const(x));
        let has_offset = (hi, lo) != (0.0, 0.0);
        let (mut sum, mut tail, later) = match (has_offset, angles) {
            (true, _) => (constant(hi), Some(constant(lo)), angles),
            (false, []) => (constant(0.0), None, angles),
            (false, [first, later @ ..]) => (*first, None, later),
        };
        for &angle in later {
            body.add(|f| {
                let next = f.ins().fadd(sum, angle);
                let back = f.ins().fsub(next, sum);
                let mut left = f.ins().fsub(angle, back);
                if let Some(tail) = tail {
                    left = f.ins().fadd(left, tail);
                }
                let kept = f.ins().fsub(next, back);
                let error = f.ins().fsub(sum, kept);
                tail = Some(f.ins().fadd(error, left));
                sum = next;
            });
        }
        AngleSum {
            angle: sum,
            tail,
            long: angles.len() + usize::from(has_offset) > 2,
        }
    }
}

/// Returns sine and cosine of each of two sums.
pub(crate) fn sines(body: &Body<'_>, sums: [&AngleSum; 2]) -> [[Value; 2]; 2] {
    let angles = body.pair(sums.map(|sum| sum.angle));
    angles.within();
    let any = sums.iter().any(|sum| sum.tail.is_some());
    let tails = any.then(|| {
        let zero = || body.add(|f| f.ins().f64const(0.0));
        body.pair(sums.map(|sum| sum.tail.unwrap_or_else(zero)))
    });
    if let Some(tails) = tails.filter(|_| sums.iter().any(|sum| sum.long)) {
        tails.all_below(Pair::TAIL_LIMIT);
    }
    let (sines, cosines) = sin_cos_in_range(angles, tails);
    let (sines, cosines) = (body.numbers(sines), body.numbers(cosines));
    [0, 1].map(|k| [sines[k], cosines[k]])
}

/// Returns, for each instruction with a sine, the later one that is computed together with it: the next one whose angles
/// are known by then.
pub(crate) fn partners(list: &Unrolled) -> Vec<Option<usize>> {
    let count = list.instructions.len();
    let mut partners = vec![None; count];
    let mut taken = vec![false; count];
    let all: Vec<usize> = (0..count)
        .filter(|&i| list.instructions[i].operation == Operation::Sines)
        .collect();
    for (k, &i) in all.iter().enumerate() {
        if taken[i] {
            continue;
        }
        let known = |&j: &usize| !taken[j] && is_known(list, &list.instructions[j], i);
        partners[i] = all[k + 1..].iter().copied().find(known);
        if let Some(j) = partners[i] {
            taken[j] = true;
        }
    }
    partners
}

/// Returns whether the operands of an instruction are known before instruction i.
fn is_known(list: &Unrolled, instruction: &Instruction, i: usize) -> bool {
    let mut operands = list.operands[instruction.operands.clone()].iter();
    operands.all(|operand| match *operand {
        ValueSource::Constant(_) | ValueSource::Argument(..) => true,
        ValueSource::Result(k) | ValueSource::Cosine(k) => (k as usize) < i,
    })
}

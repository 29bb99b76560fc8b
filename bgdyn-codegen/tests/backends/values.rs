//! States, and the values of functions at them: the evaluator's outputs in the order of a flat result.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::Shape;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::random::Random;
use bgdyn_runtime::{ACTUATORS, Dd, Scalar};

use crate::c_program::{effort_count, extras, velocity_count};

/// A type of numbers that C has as well.
pub trait CNumber: Scalar<Refused = Option<usize>, Mask = bool> + Default + PartialEq {
    /// Its name in C.
    const NAME: &'static str;
    /// Half the spacing of numbers at 1.
    const ROUNDING: f64;
    fn bits(self) -> u64;
    fn of_bits(bits: u64) -> Self;
    fn is_finite(self) -> bool;
    fn is_nan(self) -> bool;
    fn size(self) -> f64;

    /// Returns whether the other number has the same bits, or whether both are NaN: the sign of a NaN means nothing.
    fn equals(self, other: Self) -> bool {
        self.bits() == other.bits() || self.is_nan() && other.is_nan()
    }
}

impl CNumber for f64 {
    const NAME: &'static str = "double";
    const ROUNDING: f64 = f64::EPSILON / 2.0;
    fn bits(self) -> u64 {
        self.to_bits()
    }
    fn of_bits(bits: u64) -> Self {
        f64::from_bits(bits)
    }
    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
    fn is_nan(self) -> bool {
        f64::is_nan(self)
    }
    fn size(self) -> f64 {
        self.abs()
    }
}

impl CNumber for f32 {
    const NAME: &'static str = "float";
    const ROUNDING: f64 = f32::EPSILON as f64 / 2.0;
    fn bits(self) -> u64 {
        u64::from(self.to_bits())
    }
    fn of_bits(bits: u64) -> Self {
        f32::from_bits(u32::try_from(bits).expect("a word of 32 bits"))
    }
    fn is_finite(self) -> bool {
        f32::is_finite(self)
    }
    fn is_nan(self) -> bool {
        f32::is_nan(self)
    }
    fn size(self) -> f64 {
        f64::from(self.abs())
    }
}

/// Random arguments of every function of a model: positions in ±`reach`.
pub fn state<T: CNumber>(random: &mut Random, model: &Model, reach: f64) -> Inputs<T> {
    let mut some = |count: usize, size: f64| -> Vec<T> {
        (0..count)
            .map(|_| T::from_f64(size * random.signed()))
            .collect()
    };
    let (nq, n) = (model.mechanism.nq(), velocity_count(model));
    let (q, v, a) = (some(nq, reach), some(n, 4.0), some(n, 9.0));
    let u = some(effort_count(model), 50.0);
    let others = extras(model).map_or(0, |()| n);
    let (x, modes) = (some(others, 4.0), some(others, 4.0));
    let parameters = model.mechanism.parameters().iter();
    let parameters =
        parameters.map(|p| T::from_f64(p.default.to_f64() * (1.0 + 0.3 * random.unit())));
    Inputs {
        parameters: parameters.collect(),
        q,
        v,
        a,
        u,
        x,
        modes,
        ..Inputs::default()
    }
}

/// Moves the positions of a state to one at which loops close, and by up to `off` beside it; without loops and contacts
/// it does nothing.
pub fn close_to<T: CNumber>(state: &mut Inputs<T>, model: &Model, random: &mut Random, off: f64) {
    let Some(closed) = model.bond_graph.closed.as_deref() else {
        return;
    };
    let samples: Vec<&Vec<Dd>> = closed
        .closure
        .samples
        .iter()
        .chain([&closed.closure.start])
        .collect();
    let number = (random.unit() * samples.len() as f64) as usize;
    let sample = samples[number.min(samples.len() - 1)];
    for (q, x) in state.q.iter_mut().zip(sample) {
        *q = T::from_f64(x.to_f64() + off * random.signed());
    }
}

/// The result that C must give: what it returns, and its array.
pub struct Expected<T> {
    pub status: i64,
    pub values: Vec<T>,
}

pub fn expected<T: CNumber>(function: &Function, model: &Model, state: &Inputs<T>) -> Expected<T> {
    let (nv, nt) = (model.mechanism.nv(), velocity_count(model));
    let (values, refused) = function.evaluate(state.clone());
    let checked = match function.shape() {
        Shape::CheckedVector | Shape::CheckedActuated(_) | Shape::CheckedTree => values.len(),
        Shape::CheckedTreeAndRows => nt,
        Shape::CheckedSquares | Shape::CheckedSlopesByTree | Shape::CheckedWrenches => nv,
        Shape::Checked(_) => nv,
        _ => 0,
    };
    let is_wild = values[..checked].iter().any(|x| !x.is_finite());
    let status = match refused {
        // Kinds of causes begin at multiples of this number; C has the place among the names.
        Some(pivot) => (pivot % ACTUATORS) as i64 + 1,
        None => -i64::from(is_wild),
    };
    let flat: Vec<T> = match function.shape() {
        Shape::Symmetric => {
            let of_triangle = |i: usize, j: usize| values[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
            (0..nv * nv).map(|k| of_triangle(k / nv, k % nv)).collect()
        }
        Shape::CheckedSquares | Shape::CheckedSlopesByTree | Shape::CheckedWrenches => {
            values[nv..].to_vec()
        }
        Shape::Checked(entries) => entries.spread(&values[nv..], nv),
        _ => values,
    };
    Expected {
        status,
        values: flat,
    }
}

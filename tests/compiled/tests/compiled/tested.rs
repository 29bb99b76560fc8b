//! Scalars as lists of `f64`, to draw random ones and to compare two of them word by word.

use bgdyn::Scalar;
use bgdyn::runtime::Dd;
use bgdyn::runtime::num_dual::{Dual64, HyperDual64};
use bgdyn::runtime::wide::{f32x8, f64x4, f64x8};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::mechanism::Motion;
use compiled::State;

use crate::common;
use crate::common::rng::Rng;
use crate::rounded::Rounded;

/// A scalar made of `WIDTH` numbers.
pub(crate) trait Tested: Scalar {
    const WIDTH: usize;
    /// Number of states in the scalar.
    const LANES: usize = 1;

    /// Builds the scalar from its numbers; a double-double from two that need not be normalized.
    fn pack(numbers: &[f64]) -> Self;

    /// Returns its numbers.
    fn numbers(self) -> Vec<f64>;
}

macro_rules! tested {
    ($($scalar:ty, $width:literal, $lanes:literal, |$n:ident| $pack:expr, |$x:ident| $numbers:expr;)*) => {$(
        impl Tested for $scalar {
            const WIDTH: usize = $width;
            const LANES: usize = $lanes;
            fn pack($n: &[f64]) -> Self {
                $pack
            }
            fn numbers(self) -> Vec<f64> {
                let $x = self;
                Vec::from($numbers)
            }
        }
    )*};
}

tested! {
    f64, 1, 1, |n| n[0], |x| [x];
    f32, 1, 1, |n| n[0] as f32, |x| [x.into()];
    Dd, 2, 1, |n| Dd::from_f64(n[0]) + Dd::from_f64(n[1]), |x| [x.hi(), x.lo()];
    Rounded, 2, 1, |n| Rounded(Dd::pack(n)), |x| x.0.numbers();
    Dual64, 2, 1, |n| Dual64::new(n[0], n[1]), |x| [x.re, x.eps];
    HyperDual64, 4, 1, |n| HyperDual64::new(n[0], n[1], n[2], n[3]), |x| [x.re, x.eps1, x.eps2, x.eps1eps2];
    f64x4, 4, 4, |n| f64x4::new(std::array::from_fn(|k| n[k])), |x| x.to_array();
    f64x8, 8, 8, |n| f64x8::new(std::array::from_fn(|k| n[k])), |x| x.to_array();
    f32x8, 8, 8, |n| f32x8::new(std::array::from_fn(|k| n[k] as f32)), |x| x.to_array().map(f64::from);
}

/// Returns a random state: each number of each scalar is that of a random state in `f64`.
pub(crate) fn draw<T: Tested>(rng: &mut Rng, motions: &[Motion]) -> State<T> {
    let parts: Vec<_> = (0..T::WIDTH)
        .map(|_| common::State::random(rng, motions))
        .collect();
    let all = |of: fn(&common::State) -> &[f64]| {
        let scalar = |j: usize| {
            let numbers: Vec<f64> = parts.iter().map(|s| of(s)[j]).collect();
            T::pack(&numbers)
        };
        (0..motions.len()).map(scalar).collect()
    };
    State {
        q: all(|s| &s.q),
        v: all(|s| &s.v),
        a: all(|s| &s.a),
        tau: all(|s| &s.tau),
    }
}

/// Converts a state to the evaluator's inputs.
pub(crate) fn inputs<T: Scalar>(state: State<T>) -> Inputs<T> {
    // Parameters of bodies are the longest argument: see `compiled::State::argument`.
    let longest = 10 * state.tau.len();
    let efforts = state.tau.iter().copied().cycle().take(longest).collect();
    Inputs {
        q: state.q,
        v: state.v,
        a: state.a,
        u: efforts,
        x: state.tau,
        modes: vec![],
        parameters: vec![],
        t: None,
        passed: vec![],
    }
}

//! Implementation of [`Scalar`] for `f64` and `f32`.

use nalgebra::SVector;

use crate::sine::{self, SineLanes};
use crate::singular::{failed, note_refused, succeeded};
use crate::sqrt::{sqrt_f32, sqrt_f64};
use crate::tanh::tanh;
use crate::two_sum::TwoWord;
use crate::{Look, Scalar, Singular};

/// How many units in the last place of the subtracted terms a pivot must exceed.
const PIVOT_ULPS: f64 = 64.0;

/// Operations on the components of lanes and of dual numbers.
pub(crate) trait Float: TwoWord {
    /// A pivot must be larger than this number times the terms that were subtracted in it.
    const PIVOT_FLOOR: Self;
}

macro_rules! float_scalar {
    ($float:ident, $sqrt:path, $exp:path, $ln:path) => {
        impl Scalar for $float {
            type Mask = bool;
            type Refused = Option<usize>;
            type Singular<const N: usize> = Singular;

            // Always inlined: a constant argument becomes a constant, also when the compiler optimises for
            // size and `f64` would be computed in software.
            #[inline(always)]
            fn from_f64(x: f64) -> Self {
                x as $float
            }

            #[inline]
            fn mul_add(self, b: Self, c: Self) -> Self {
                self.fused(b, c)
            }

            #[inline]
            fn sqrt(self) -> Self {
                $sqrt(self)
            }

            sine::methods!();

            #[inline]
            fn exp(self) -> Self {
                $exp(self)
            }

            #[inline]
            fn ln(self) -> Self {
                $ln(self)
            }

            #[inline]
            fn tanh(self) -> Self {
                tanh(self)
            }

            #[inline]
            fn abs(self) -> Self {
                $float::abs(self)
            }

            #[inline]
            fn min(self, other: Self) -> Self {
                if self < other || self.is_nan() {
                    self
                } else {
                    other
                }
            }

            #[inline]
            fn max(self, other: Self) -> Self {
                if self > other || self.is_nan() {
                    self
                } else {
                    other
                }
            }

            #[inline]
            fn sign(self) -> Self {
                if self > 0.0 {
                    1.0
                } else if self < 0.0 {
                    -1.0
                } else {
                    self * 0.0
                }
            }

            #[inline]
            fn less(self, other: Self) -> bool {
                self < other
            }

            #[inline]
            fn select(mask: bool, a: Self, b: Self) -> Self {
                if mask { a } else { b }
            }

            #[inline]
            fn none_refused() -> Option<usize> {
                None
            }

            #[inline]
            fn checked_pivot(
                self,
                magnitude: Self,
                joint: usize,
                refused: &mut Option<usize>,
            ) -> Self {
                let floor = magnitude * Self::PIVOT_FLOOR;
                // These comparisons also refuse a NaN on either side. With `self < INFINITY` and a floor
                // of 0, compilers make twenty instructions on bits of them.
                let floor = if floor < 0.0 { 0.0 } else { floor };
                note_refused(self > floor && self <= $float::MAX, joint, refused);
                self
            }

            #[inline]
            fn succeeded<const N: usize>(
                accelerations: &SVector<Self, N>,
                refused: Option<usize>,
            ) -> bool {
                succeeded(accelerations, refused)
            }

            fn failed<const N: usize>(
                accelerations: SVector<Self, N>,
                refused: Option<usize>,
                names: &'static [&'static str],
                arguments: impl FnOnce(&mut Look<'_, Self>),
            ) -> Option<Singular> {
                failed(accelerations, refused, names, arguments)
            }
        }

        impl TwoWord for $float {
            // Always inlined, as `from_f64`.
            #[inline(always)]
            fn two_words(hi: f64, lo: f64) -> (Self, Self) {
                let sum = hi as $float;
                (sum, (hi - f64::from(sum) + lo) as $float)
            }
        }

        impl Float for $float {
            const PIVOT_FLOOR: Self = PIVOT_ULPS as $float * $float::EPSILON;
        }
    };
}

/// The bound of pivots in `f64`: `Float::PIVOT_FLOOR`.
pub const F64_PIVOT_FLOOR: f64 = <f64 as Float>::PIVOT_FLOOR;

float_scalar!(f64, sqrt_f64, libm::exp, libm::log);
float_scalar!(f32, sqrt_f32, libm::expf, libm::logf);

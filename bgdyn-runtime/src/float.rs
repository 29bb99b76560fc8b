//! [`Scalar`] for `f64` and `f32`.

use nalgebra::SVector;

use crate::sine::{self, Pack};
use crate::singular::{finish, note_refused};
use crate::{Scalar, Singular};

/// How many units in the last place of the subtracted terms a pivot must exceed.
const PIVOT_ULPS: f64 = 64.0;

/// Constants in two words.
pub(crate) trait Split: Scalar {
    /// The nearest value to `hi`, and the nearest to the rest of `hi + lo`.
    fn split(hi: f64, lo: f64) -> (Self, Self);
}

/// What lanes and dual numbers need of the numbers they are made of.
pub(crate) trait Float: Split {
    /// Up to here, in radians, two terms of a Taylor series stand for a tail's sine and cosine.
    const SMALL_TAIL: Self;
    /// A pivot must exceed this many times the terms it was subtracted from.
    const PIVOT_FLOOR: Self;

    /// Sine and cosine of a + `tail` from those of a.
    fn turn(sine_cosine: (Self, Self), tail: Self) -> (Self, Self);
}

/// The sum of `angles` and `offset`, rounded, and what the rounding leaves; in any arithmetic that
/// rounds as [`Float`]s do, lane by lane.
#[inline]
pub(crate) fn exact_sum<T: Split>(angles: impl Iterator<Item = T>, offset: (f64, f64)) -> (T, T) {
    let (mut sum, mut tail) = T::split(offset.0, offset.1);
    for angle in angles {
        // Knuth's two-sum: the rounding error of the addition, exactly.
        let next = sum + angle;
        let back = next - sum;
        tail = tail + ((sum - (next - back)) + (angle - back));
        sum = next;
    }
    // And once more, so that the tail is half a unit in the last place at most.
    let angle = sum + tail;
    let back = angle - sum;
    (angle, (sum - (angle - back)) + (tail - back))
}

macro_rules! float_scalar {
    ($float:ident, $small_tail:expr, $sqrt:path, $exp:path, $ln:path, $tanh:path) => {
        impl Scalar for $float {
            type Mask = bool;
            type Refused = Option<usize>;
            type Singular<const N: usize> = Singular;

            #[inline]
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

            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                sine::one(self, 0.0)
            }

            // The tail's own rounding is |q|·eps², so the sum is good to eps for |q| up to 1/eps:
            // 4e15 rad for `f64`, 8e6 rad for `f32`.
            #[inline]
            fn sin_cos_sum(angles: &[Self], offset: (f64, f64)) -> (Self, Self) {
                let (angle, tail) = sine::plain_or_sum(angles, offset);
                sine::one(angle, tail)
            }

            #[inline(always)]
            fn sin_cos_all<const K: usize>(
                angles: [&[Self]; K],
                offsets: [(f64, f64); K],
            ) -> [(Self, Self); K] {
                sine::all(angles, offsets)
            }

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
                $tanh(self)
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
                // Written so that a NaN on either side is refused.
                let ok = self > 0.0 && self > floor && self < $float::INFINITY;
                if note_refused(ok, joint, refused) {
                    self
                } else {
                    1.0
                }
            }

            #[inline]
            fn finish<const N: usize>(
                accelerations: SVector<Self, N>,
                refused: Option<usize>,
                names: &'static [&'static str; N],
            ) -> Result<SVector<Self, N>, Singular> {
                finish(accelerations, refused, names)
            }
        }

        impl Split for $float {
            #[inline]
            fn split(hi: f64, lo: f64) -> (Self, Self) {
                let sum = hi as $float;
                (sum, (hi - f64::from(sum) + lo) as $float)
            }
        }

        impl Float for $float {
            const SMALL_TAIL: Self = $small_tail;
            const PIVOT_FLOOR: Self = PIVOT_ULPS as $float * $float::EPSILON;

            fn turn((s, c): (Self, Self), tail: Self) -> (Self, Self) {
                if tail.abs() <= Self::SMALL_TAIL {
                    // Adding the small correction last leaves its rounding as the only new error.
                    (
                        s + tail * (c - 0.5 * tail * s),
                        c - tail * (s + 0.5 * tail * c),
                    )
                } else if tail.is_finite() {
                    let (ds, dc) = sine::one(tail, 0.0);
                    (s * dc + c * ds, c * dc - s * ds)
                } else {
                    (s, c)
                }
            }
        }
    };
}

// Up to 2⁻¹⁸ (2⁻⁸), in radians, two terms of a Taylor series stand for the sine and cosine of a
// tail: what they leave out, tail³/6, is less than a tenth of the spacing of the numbers above 1.
float_scalar!(f64, 3.8e-6, libm::sqrt, libm::exp, libm::log, libm::tanh);
float_scalar!(
    f32,
    3.9e-3,
    libm::sqrtf,
    libm::expf,
    libm::logf,
    libm::tanhf
);

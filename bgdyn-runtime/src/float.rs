//! [`Scalar`] for `f64` and `f32`.

use nalgebra::SVector;

use crate::root;
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
    /// A pivot must exceed this many times the terms it was subtracted from.
    const PIVOT_FLOOR: Self;
}

/// The sum of `angles` and `offset`, rounded, and what the rounding leaves, but for a single angle;
/// in any arithmetic that rounds as [`Float`]s do, lane by lane.
#[inline(always)]
pub(crate) fn exact_sum<T: Split>(
    mut angles: impl Iterator<Item = T>,
    offset: (f64, f64),
) -> (T, Option<T>) {
    let (mut sum, mut tail) = match offset {
        (0.0, 0.0) => (angles.next().unwrap_or(T::from_f64(0.0)), None),
        (hi, lo) => {
            let (hi, lo) = T::split(hi, lo);
            (hi, Some(lo))
        }
    };
    let mut sums = 0;
    for angle in angles {
        sums += 1;
        // Knuth's two-sum: the rounding error of the addition, exactly. What is left of earlier ones
        // joins the shorter of its two ways, so that nothing waits for it.
        let next = sum + angle;
        let back = next - sum;
        let left = angle - back;
        let left = tail.map_or(left, |tail| left + tail);
        tail = Some((sum - (next - back)) + left);
        sum = next;
    }
    let (1.., Some(tail)) = (sums, tail) else {
        return (sum, None);
    };
    if sums == 1 {
        // The tail is half a unit in the last place: where more than that is left of the offset, the
        // angle has cancelled it, and has no digits that the offset's first word has not.
        return (sum, Some(tail));
    }
    // And once more, so that it is.
    let angle = sum + tail;
    let back = angle - sum;
    (angle, Some((sum - (angle - back)) + (tail - back)))
}

macro_rules! float_scalar {
    ($float:ident, $sqrt:path, $exp:path, $ln:path, $tanh:path) => {
        impl Scalar for $float {
            type Mask = bool;
            type Refused = Option<usize>;
            type Singular<const N: usize> = Singular;

            // Always: of constants, nothing is left of it but a constant, also where a compiler saves
            // space and `f64` would be computed in software.
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
                // Written so that a NaN on either side is refused, and without `self > 0`, which
                // together with infinity is compiled to thirty instructions on bits.
                let floor = if floor < 0.0 { 0.0 } else { floor };
                note_refused(self > floor && self < $float::INFINITY, joint, refused);
                self
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
            // As `from_f64`.
            #[inline(always)]
            fn split(hi: f64, lo: f64) -> (Self, Self) {
                let sum = hi as $float;
                (sum, (hi - f64::from(sum) + lo) as $float)
            }
        }

        impl Float for $float {
            const PIVOT_FLOOR: Self = PIVOT_ULPS as $float * $float::EPSILON;
        }
    };
}

float_scalar!(f64, libm::sqrt, libm::exp, libm::log, libm::tanh);
float_scalar!(f32, root::single, libm::expf, libm::logf, libm::tanhf);

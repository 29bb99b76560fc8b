//! The trait [`Scalar`], the number type of generated functions.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use nalgebra::SVector;

use crate::argument::Look;

/// A number that generated dynamics can be computed with: `f64`, `f32`, double-double
/// ([`crate::Dd`]), lanes of a SIMD register, dual numbers, or a type of your own (one that
/// counts its operations, say).
///
/// Every generated function is generic over it. Comparisons return a [`Scalar::Mask`] instead of a `bool`,
/// and a failed pivot is a value instead of an early return, so that lanes and scalars run the same
/// straight-line code.
pub trait Scalar:
    Copy
    + Debug
    + PartialEq
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Result of a comparison: `bool`, or one truth value per lane.
    type Mask: Copy + Debug;

    /// The first joint whose pivot was refused, or none (per lane).
    type Refused: Copy + Debug;

    /// The error of [`Scalar::finish`] if the mass matrix was singular.
    type Singular<const N: usize>: Debug;

    /// Returns the value nearest to `x`.
    fn from_f64(x: f64) -> Self;

    /// Returns the value nearest to the unevaluated sum `hi + lo`; `hi` is the `f64` nearest to the sum.
    fn from_parts(hi: f64, lo: f64) -> Self {
        let _ = lo;
        Self::from_f64(hi)
    }

    /// Returns `self · b + c`, with one rounding if the machine computes that as fast as a product and a
    /// sum.
    fn mul_add(self, b: Self, c: Self) -> Self;
    /// Returns the square root.
    fn sqrt(self) -> Self;
    /// Returns sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);

    /// Returns sine and cosine of the exact sum of `angles` and `offset.0 + offset.1`, in radians.
    ///
    /// A rounded sum has an error of |q|·eps; implementations add the rounding error of the sum to the
    /// angle. These additions belong to the sine: they do not count as operations.
    fn sin_cos_sum(angles: &[Self], offset: (f64, f64)) -> (Self, Self);

    /// Returns sines and cosines of all angles of a call, each as [`Scalar::sin_cos_sum`] does. `f64` and
    /// `f32` compute them in lanes.
    #[inline(always)]
    fn sin_cos_all<const K: usize>(
        angles: [&[Self]; K],
        offsets: [(f64, f64); K],
    ) -> [(Self, Self); K] {
        core::array::from_fn(|k| match (angles[k], offsets[k]) {
            (&[angle], (0.0, 0.0)) => angle.sin_cos(),
            (angles, offset) => Self::sin_cos_sum(angles, offset),
        })
    }

    /// Returns e to the power of `self`.
    fn exp(self) -> Self;
    /// Returns the natural logarithm.
    fn ln(self) -> Self;
    /// Returns the hyperbolic tangent.
    fn tanh(self) -> Self;
    /// Returns the absolute value.
    fn abs(self) -> Self;
    /// Returns the smaller number; NaN where either is NaN.
    fn min(self, other: Self) -> Self;
    /// Returns the larger number; NaN where either is NaN.
    fn max(self, other: Self) -> Self;
    /// Returns −1, 0 or 1 with the sign of `self`; 0 for ±0, NaN for NaN.
    fn sign(self) -> Self;

    /// Returns `self < other`; false where either is NaN.
    fn less(self, other: Self) -> Self::Mask;
    /// Returns `a` where the mask is true, else `b`.
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self;

    /// Returns the value for "no pivot refused".
    fn none_refused() -> Self::Refused;

    /// Checks a pivot of a factorisation of the mass matrix. `self` is the result of subtractions whose
    /// terms had the size `magnitude`.
    ///
    /// Records `joint` in `refused` (an earlier joint is not overwritten) if `self` is not positive and
    /// finite, or is not larger than the rounding error of those terms. Returns `self` in either case: a
    /// division need not wait for the comparisons, and [`Scalar::finish`] discards results of a refused
    /// pivot.
    fn checked_pivot(self, magnitude: Self, joint: usize, refused: &mut Self::Refused) -> Self;

    /// Returns whether no pivot was refused and the sum of the accelerations is finite; then all
    /// accelerations are finite.
    fn succeeded<const N: usize>(accelerations: &SVector<Self, N>, refused: Self::Refused) -> bool;

    /// Returns the error if [`Scalar::succeeded`] is false: it names the joint of a refused pivot, or of
    /// an acceleration that is not finite. Returns `None` if only the sum of the accelerations overflowed.
    /// `names` are the names of the model's joints, and of its loops after them. `arguments` passes the arguments of the failed
    /// function to a callback; the first component that is NaN or infinite is reported as the cause. This
    /// function may be slow.
    fn failed<const N: usize>(
        accelerations: SVector<Self, N>,
        refused: Self::Refused,
        names: &'static [&'static str],
        arguments: impl FnOnce(&mut Look<'_, Self>),
    ) -> Option<Self::Singular<N>>;

    /// Returns the accelerations or their error: [`Scalar::succeeded`] and [`Scalar::failed`] together.
    ///
    /// # Errors
    /// The error of [`Scalar::failed`].
    #[inline]
    fn finish<const N: usize>(
        accelerations: SVector<Self, N>,
        refused: Self::Refused,
        names: &'static [&'static str],
        arguments: impl FnOnce(&mut Look<'_, Self>),
    ) -> Result<SVector<Self, N>, Self::Singular<N>> {
        if Self::succeeded(&accelerations, refused) {
            Ok(accelerations)
        } else {
            Self::failed(accelerations, refused, names, arguments).map_or(Ok(accelerations), Err)
        }
    }
}

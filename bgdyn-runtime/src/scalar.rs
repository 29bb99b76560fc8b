//! The trait [`Scalar`], by which every generated function is generic.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use nalgebra::SVector;

use crate::argument::Look;

/// A number that generated dynamics can be computed with: `f64`, `f32`, double-double
/// ([`crate::Dd`]), lanes of a SIMD register, dual numbers, or a type of your own (one that
/// counts its operations, say).
///
/// Every generated function is generic over it. Comparisons give a [`Scalar::Mask`] rather than a
/// `bool`, and a failed pivot is a value rather than an early return, so that lanes and scalars
/// run the same straight line of code.
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
    /// Outcome of a comparison: `bool`, or one truth value per lane.
    type Mask: Copy + Debug;

    /// Which joints had a pivot refused so far: none yet, or the first one (per lane).
    type Refused: Copy + Debug;

    /// What [`Scalar::finish`] returns where a mass matrix was singular.
    type Singular<const N: usize>: Debug;

    /// The nearest value to `x`.
    fn from_f64(x: f64) -> Self;

    /// The nearest value to the unevaluated sum `hi + lo`; `hi` is the sum's nearest `f64`.
    fn from_parts(hi: f64, lo: f64) -> Self {
        let _ = lo;
        Self::from_f64(hi)
    }

    /// `self · b + c`, with one rounding where the machine has it for no more than two.
    fn mul_add(self, b: Self, c: Self) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);

    /// Sine and cosine of the exact sum of `angles` and `offset.0 + offset.1`, in radians.
    ///
    /// A plain sum loses |q|·eps of its angle; implementations carry the sum's tail into the sine.
    /// The additions are part of the sine: they do not count as operations.
    fn sin_cos_sum(angles: &[Self], offset: (f64, f64)) -> (Self, Self);

    /// Sines and cosines of all angles of a call, each as [`Scalar::sin_cos_sum`] gives it: `f64` and
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

    /// e to the power of `self`.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// The smaller one; NaN where either is NaN.
    fn min(self, other: Self) -> Self;
    /// The larger one; NaN where either is NaN.
    fn max(self, other: Self) -> Self;
    /// −1, 0 or 1 with the sign of `self`; 0 for ±0, NaN for NaN.
    fn sign(self) -> Self;

    /// `self < other`; false where either is NaN.
    fn less(self, other: Self) -> Self::Mask;
    /// `a` where the mask holds, else `b`.
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self;

    /// No pivot refused.
    fn none_refused() -> Self::Refused;

    /// Checks a pivot of a factorisation of the mass matrix. `self` came out of subtractions whose
    /// terms were as large as `magnitude`.
    ///
    /// Notes `joint` in `refused` (the first one stays) where `self` is not positive and finite, or does
    /// not stand clear of the rounding error of those terms. Gives `self` either way: a division need not
    /// wait for the comparisons, and [`Scalar::finish`] throws away what a refused pivot led to.
    fn checked_pivot(self, magnitude: Self, joint: usize, refused: &mut Self::Refused) -> Self;

    /// Whether no pivot was refused and the sum of the accelerations is finite: then so are they all.
    fn succeeded<const N: usize>(accelerations: &SVector<Self, N>, refused: Self::Refused) -> bool;

    /// The error that names the joint, where [`Scalar::succeeded`] is false: of a refused pivot, or of an
    /// acceleration that is not finite; `None` where only the sum of the accelerations was too large.
    /// `names` are those of the model's joints. `arguments` shows the arguments of the function that failed:
    /// the first one that is NaN or infinite is the cause. A scalar may be slow here.
    fn failed<const N: usize>(
        accelerations: SVector<Self, N>,
        refused: Self::Refused,
        names: &'static [&'static str; N],
        arguments: impl FnOnce(&mut Look<'_, Self>),
    ) -> Option<Self::Singular<N>>;

    /// The accelerations, unless they have an error: [`Scalar::succeeded`] and [`Scalar::failed`] together.
    ///
    /// # Errors
    /// Those of [`Scalar::failed`].
    #[inline]
    fn finish<const N: usize>(
        accelerations: SVector<Self, N>,
        refused: Self::Refused,
        names: &'static [&'static str; N],
        arguments: impl FnOnce(&mut Look<'_, Self>),
    ) -> Result<SVector<Self, N>, Self::Singular<N>> {
        if Self::succeeded(&accelerations, refused) {
            Ok(accelerations)
        } else {
            Self::failed(accelerations, refused, names, arguments).map_or(Ok(accelerations), Err)
        }
    }
}

//! Implementation of [`Scalar`] for the lanes of a SIMD register, which compute several states together.
//!
//! Lane k of every result equals, bit for bit, the result of `f64` (or `f32`) for lane k of the arguments.
//! Sines and cosines are computed in the lanes, except for large angles (`sine/`); those of `wide` lose
//! accuracy for large angles. So are hyperbolic tangents (`tanh.rs`). Exponentials and logarithms are those of the scalar, lane
//! by lane.

use core::fmt;

use nalgebra::SVector;
use wide::{f32x4, f32x8, f32x16, f64x2, f64x4, f64x8};

use crate::float::Float;
use crate::sine;
use crate::singular::{sum, zero_if_finite};
use crate::tanh::tanh;
use crate::two_sum::TwoWord;
use crate::{Look, Scalar, Singular};

/// The error if at least one lane has no accelerations; the other lanes have theirs.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct LaneSingular<T: nalgebra::Scalar, const LANES: usize, const N: usize> {
    /// The accelerations; 0 in failed lanes.
    pub accelerations: SVector<T, N>,
    /// The error of each lane; `None` if it succeeded.
    pub errors: [Option<Singular>; LANES],
}

impl<T: nalgebra::Scalar, const LANES: usize, const N: usize> LaneSingular<T, LANES, N> {
    /// Returns the error of one lane; `None` if it succeeded, or if the lane does not exist.
    pub fn lane(&self, lane: usize) -> Option<Singular> {
        self.errors.get(lane).copied().flatten()
    }

    /// Returns the failed lanes, each with its error.
    pub fn failed(&self) -> impl Iterator<Item = (usize, Singular)> + '_ {
        (0..LANES).filter_map(|lane| Some((lane, self.lane(lane)?)))
    }
}

impl<T: nalgebra::Scalar, const LANES: usize, const N: usize> fmt::Display
    for LaneSingular<T, LANES, N>
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, (lane, error)) in self.failed().enumerate() {
            let separator = if i > 0 { "; " } else { "" };
            write!(f, "{separator}lane {lane}: {error}")?;
        }
        Ok(())
    }
}

impl<T: nalgebra::Scalar, const LANES: usize, const N: usize> core::error::Error
    for LaneSingular<T, LANES, N>
{
}

macro_rules! lane_scalar {
    ($($lanes:ident: $float:ident, $n:literal;)*) => {$(
        impl Scalar for $lanes {
            /// All bits of a lane are set if the comparison is true.
            type Mask = Self;
            /// Index of the joint; -1 for none.
            type Refused = Self;
            type Singular<const N: usize> = LaneSingular<Self, $n, N>;

            #[inline]
            fn from_f64(x: f64) -> Self {
                Self::splat(x as $float)
            }

            // One instruction if the target has it, else a product and a sum; never a call.
            #[inline]
            fn mul_add(self, b: Self, c: Self) -> Self {
                $lanes::mul_add(self, b, c)
            }

            #[inline]
            fn sqrt(self) -> Self {
                $lanes::sqrt(self)
            }

            sine::methods!();

            #[inline]
            fn exp(self) -> Self {
                Self::new(self.to_array().map(<$float as Scalar>::exp))
            }

            #[inline]
            fn ln(self) -> Self {
                Self::new(self.to_array().map(<$float as Scalar>::ln))
            }

            #[inline]
            fn tanh(self) -> Self {
                tanh(self)
            }

            #[inline]
            fn abs(self) -> Self {
                $lanes::abs(self)
            }

            #[inline]
            fn min(self, other: Self) -> Self {
                (self.simd_lt(other) | self.is_nan()).select(self, other)
            }

            #[inline]
            fn max(self, other: Self) -> Self {
                (self.simd_gt(other) | self.is_nan()).select(self, other)
            }

            #[inline]
            fn sign(self) -> Self {
                let (zero, one) = (Self::splat(0.0), Self::splat(1.0));
                let not_positive = self.simd_lt(zero).select(-one, self * zero);
                self.simd_gt(zero).select(one, not_positive)
            }

            #[inline]
            fn less(self, other: Self) -> Self {
                self.simd_lt(other)
            }

            #[inline]
            fn select(mask: Self, a: Self, b: Self) -> Self {
                mask.select(a, b)
            }

            #[inline]
            fn none_refused() -> Self {
                Self::splat(-1.0)
            }

            #[inline]
            fn checked_pivot(self, magnitude: Self, joint: usize, refused: &mut Self) -> Self {
                let zero = Self::splat(0.0);
                let floor = magnitude * Self::splat($float::PIVOT_FLOOR);
                let ok = self.simd_gt(zero)
                    & self.simd_gt(floor)
                    & self.simd_lt(Self::splat($float::INFINITY));
                let first = refused.simd_lt(zero).select(Self::splat(joint as $float), *refused);
                *refused = ok.select(*refused, first);
                self
            }

            #[inline]
            fn succeeded<const N: usize>(
                accelerations: &SVector<Self, N>,
                refused: Self,
            ) -> bool {
                let zero = Self::splat(0.0);
                let finite = zero_if_finite(sum(accelerations)).simd_eq(zero);
                (refused.simd_lt(zero) & finite).all()
            }

            #[cold]
            #[inline(never)]
            fn failed<const N: usize>(
                accelerations: SVector<Self, N>,
                refused: Self,
                names: &'static [&'static str],
                arguments: impl FnOnce(&mut Look<'_, Self>),
            ) -> Option<LaneSingular<Self, $n, N>> {
                let zero = Self::splat(0.0);
                let mut finite = refused.simd_lt(zero);
                let mut errors = refused
                    .to_array()
                    .map(|j| (j >= 0.0).then(|| Singular::refused(j as usize, N, names)));
                for (j, &a) in accelerations.iter().enumerate() {
                    let number = zero_if_finite(a).simd_eq(zero);
                    finite &= number;
                    for (error, x) in errors.iter_mut().zip(a.to_array()) {
                        if error.is_none() && !x.is_finite() {
                            *error = Some(Singular::not_finite(j, names));
                        }
                    }
                }
                if finite.all() {
                    // The accelerations are finite; only their sum was too large.
                    return None;
                }
                arguments(&mut |argument, components, values| {
                    for (lane, error) in errors.iter_mut().enumerate() {
                        let wild = |x: &Self| {
                            x.to_array().get(lane).is_some_and(|x| !x.is_finite())
                        };
                        if let Some(error) = error {
                            error.look(argument, components, values.iter().position(wild));
                        }
                    }
                });
                Some(LaneSingular {
                    accelerations: accelerations.map(|a| finite.select(a, zero)),
                    errors,
                })
            }
        }

        impl TwoWord for $lanes {
            #[inline]
            fn two_words(hi: f64, lo: f64) -> (Self, Self) {
                let (hi, lo) = $float::two_words(hi, lo);
                (Self::splat(hi), Self::splat(lo))
            }
        }
    )*};
}

lane_scalar! {
    f64x2: f64, 2;
    f64x4: f64, 4;
    f64x8: f64, 8;
    f32x4: f32, 4;
    f32x8: f32, 8;
    f32x16: f32, 16;
}

//! Implementation of [`Scalar`] for the lanes of a SIMD register: several states at once.
//!
//! Lane k of every result equals, bit for bit, what `f64` (or `f32`) makes of lane k of the
//! inputs. Sines and cosines are computed in the lanes, but for large angles (`sine/`); the ones of
//! `wide` lose the reduction of large angles. The other elementary functions are those of the scalar,
//! lane by lane.

use core::fmt;

use nalgebra::SVector;
use wide::{f32x4, f32x8, f32x16, f64x2, f64x4, f64x8};

use crate::float::Float;
use crate::sine;
use crate::singular::{Cause, cause, sum, zero_if_finite};
use crate::two_sum::TwoWord;
use crate::{Look, Scalar, Singular};

/// There are no accelerations in at least one lane; the other lanes have theirs.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct LaneSingular<T: nalgebra::Scalar, const LANES: usize, const N: usize> {
    /// The accelerations; 0 in lanes that failed.
    pub accelerations: SVector<T, N>,
    /// For each lane the joint whose pivot vanishes, in the order of `JOINT_NAMES`; `None` where
    /// the mass matrix is regular.
    pub joint: [Option<usize>; LANES],
    /// Why, for each lane that failed.
    pub cause: [Cause; LANES],
    /// Names of the model's joints.
    pub names: &'static [&'static str; N],
}

impl<T: nalgebra::Scalar, const LANES: usize, const N: usize> LaneSingular<T, LANES, N> {
    /// The error of one lane; `None` where it succeeded, or where there is no such lane.
    pub fn lane(&self, lane: usize) -> Option<Singular> {
        let joint = self.joint.get(lane).copied().flatten()?;
        Some(Singular {
            joint,
            name: self.names.get(joint).copied().unwrap_or(""),
            cause: self.cause.get(lane).copied().unwrap_or(Cause::Pivot),
        })
    }

    /// The lanes that failed, each with its error.
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
            /// All bits of a lane are set where the comparison holds.
            type Mask = Self;
            /// Index of the joint, -1 for none.
            type Refused = Self;
            type Singular<const N: usize> = LaneSingular<Self, $n, N>;

            #[inline]
            fn from_f64(x: f64) -> Self {
                Self::splat(x as $float)
            }

            // One instruction where the target has it, else a product and a sum: never a call.
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
                Self::new(self.to_array().map(<$float as Scalar>::tanh))
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
            fn finish<const N: usize>(
                accelerations: SVector<Self, N>,
                refused: Self,
                names: &'static [&'static str; N],
            ) -> Result<SVector<Self, N>, LaneSingular<Self, $n, N>> {
                let zero = Self::splat(0.0);
                let finite = zero_if_finite(sum(&accelerations)).simd_eq(zero);
                if (refused.simd_lt(zero) & finite).all() {
                    return Ok(accelerations);
                }
                let found = LaneSingular::<Self, $n, N>::of(accelerations, refused, names);
                match found.joint {
                    // Only a sum was too large.
                    joint if joint == [None; $n] => Ok(accelerations),
                    _ => Err(found),
                }
            }

            #[inline]
            fn explain<const N: usize>(
                error: LaneSingular<Self, $n, N>,
                arguments: impl FnOnce(&mut Look<'_, Self>),
            ) -> LaneSingular<Self, $n, N> {
                error.explained(arguments)
            }
        }

        impl<const N: usize> LaneSingular<$lanes, $n, N> {
            /// The error of lanes some of which have a joint noted, or an acceleration that is not finite.
            #[cold]
            fn of(
                accelerations: SVector<$lanes, N>,
                mut refused: $lanes,
                names: &'static [&'static str; N],
            ) -> Self {
                let zero = $lanes::splat(0.0);
                let pivots = refused.to_array();
                for (j, &a) in accelerations.iter().enumerate() {
                    let finite = zero_if_finite(a).simd_eq(zero);
                    let noted = refused.simd_lt(zero).select($lanes::splat(j as $float), refused);
                    refused = finite.select(refused, noted);
                }
                let regular = refused.simd_lt(zero);
                LaneSingular {
                    accelerations: accelerations.map(|a| regular.select(a, zero)),
                    joint: refused.to_array().map(|j| (j >= 0.0).then_some(j as usize)),
                    cause: pivots.map(|j| if j >= 0.0 { Cause::Pivot } else { Cause::NotFinite }),
                    names,
                }
            }

            /// The same with the argument that is not finite, lane by lane.
            #[cold]
            #[inline(never)]
            fn explained(mut self, arguments: impl FnOnce(&mut Look<'_, $lanes>)) -> Self {
                arguments(&mut |argument, components, values| {
                    for (lane, of_lane) in self.cause.iter_mut().enumerate() {
                        if matches!(of_lane, Cause::Argument { .. }) {
                            continue;
                        }
                        let wild = |x: &$lanes| {
                            x.to_array().get(lane).is_some_and(|x| !x.is_finite())
                        };
                        let index = values.iter().position(wild);
                        *of_lane = cause(argument, components, index, *of_lane);
                    }
                });
                self
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

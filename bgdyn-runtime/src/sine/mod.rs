//! Sine and cosine in `f64` and `f32`: of one angle, of SIMD lanes, of all angles of a call, with equal
//! bits.
//!
//! An angle x within [`SineLanes::LIMIT`] is reduced to n quarter turns and a rest r in ±π/4, in two words
//! (Cody and Waite 1980): π/2 is divided into parts so short that n times each is exact. Then sin r and
//! cos r are polynomials, and n selects which of them is the sine and their signs. The computation has no
//! branch, so that lanes compute several angles together and every angle takes the same time. Larger
//! angles are reduced exactly, one by one (`large.rs`).
//!
//! Errors are below one unit in the last place for an angle of any size, and for a sum of two that does not overflow. A sum of
//! three or more terms is computed in two words: its error is larger by up to |q|·eps², where q is the
//! largest of its partial sums and eps the spacing of the numbers above 1. This matters only if the sine
//! is smaller than |q|·eps. `tests/sine.rs` measures both.

/// Number of angles of a call that are computed together: the lanes of the widest register.
const MAX_BATCH: usize = 8;

/// Repeats the step with k = 0, 1, … below `count` (at most [`MAX_BATCH`]), where k is a constant for the
/// compiler, so that arrays of numbers stay in registers.
macro_rules! unrolled {
    ($count:expr, |$k:ident| $step:expr) => {
        unrolled!($count, $k, $step; 0 1 2 3 4 5 6 7);
    };
    ($count:expr, $k:ident, $step:expr; $($n:literal)*) => {$(
        if $n < $count {
            let $k: usize = $n;
            $step;
        }
    )*};
}

/// Implements methods of [`Scalar`](crate::Scalar) by this module.
///
/// They are inlined: if lanes were passed in memory, they would be stored in halves and the load would
/// wait, and a constant offset would not be a constant in the callee.
macro_rules! methods {
    () => {
        #[inline(always)]
        fn sin_cos(self) -> (Self, Self) {
            $crate::sine::sin_cos(self, None)
        }

        #[inline(always)]
        fn sin_cos_sum(angles: &[Self], offset: (f64, f64)) -> (Self, Self) {
            let (angle, tail) = $crate::two_sum::exact_sum(angles.iter().copied(), offset);
            $crate::sine::sin_cos(angle, tail)
        }

        #[inline(always)]
        fn sin_cos_all<const K: usize>(
            angles: [&[Self]; K],
            offsets: [(f64, f64); K],
        ) -> [(Self, Self); K] {
            $crate::sine::sin_cos_batch(angles, offsets)
        }
    };
}
pub(crate) use methods;

mod any_size;
mod kernel;
mod lanes;
mod large;

use crate::two_sum::{TwoWord, exact_sum};
pub(crate) use any_size::{AnySize, sin_cos};
pub use kernel::sin_cos_in_range;
pub use lanes::{Coefficients, FUSES, SineLanes};

/// Returns sines and cosines of all angles of a call: each of the exact sum of its `angles` and its
/// offset.
#[inline(always)]
pub(crate) fn sin_cos_batch<T: Batch, const K: usize>(
    angles: [&[T]; K],
    offsets: [(f64, f64); K],
) -> [(T, T); K] {
    let zero = T::from_f64(0.0);
    if K > MAX_BATCH {
        return core::array::from_fn(|k| {
            let (angle, tail) = exact_sum(angles[k].iter().copied(), offsets[k]);
            sin_cos(angle, tail)
        });
    }
    let mut sums = AngleSums {
        angles: [zero; K],
        tails: [zero; K],
        are_sums: [false; K],
        are_long: [false; K],
    };
    unrolled!(K, |k| {
        let (angle, tail) = exact_sum(angles[k].iter().copied(), offsets[k]);
        sums.angles[k] = angle;
        sums.tails[k] = tail.unwrap_or(zero);
        sums.are_sums[k] = tail.is_some();
        sums.are_long[k] = angles[k].len() + usize::from(offsets[k] != (0.0, 0.0)) > 2;
    });
    if let Some(found) = T::sin_cos_in_lanes(&sums) {
        return found;
    }
    let mut found = [(zero, zero); K];
    unrolled!(K, |k| found[k] = out_of_line(sums.angles[k], sums.tails[k]));
    found
}

/// Angles of a call, with one array for each part. With an array of pairs, compilers load wide registers
/// from values that were just stored in halves, and the load waits.
pub(crate) struct AngleSums<T, const K: usize> {
    /// The sums, rounded.
    angles: [T; K],
    /// Rounding errors of the sums.
    tails: [T; K],
    /// Which angles are sums of more than one term.
    are_sums: [bool; K],
    /// Which angles are sums of more than two terms: their rounding errors can be large.
    are_long: [bool; K],
}

/// Calls [`sin_cos`] out of line for calls with large angles or rounding errors: passed as an array, the angles would be
/// stored in every call.
#[cold]
#[inline(never)]
fn out_of_line<T: AnySize>(angle: T, tail: T) -> (T, T) {
    sin_cos(angle, Some(tail))
}

/// Numbers whose sines can be computed several at once.
pub(crate) trait Batch: AnySize + TwoWord {
    /// Returns sines and cosines of the sums; `None` if not all of them are within the limits.
    fn sin_cos_in_lanes<const K: usize>(sums: &AngleSums<Self, K>) -> Option<[(Self, Self); K]>;
}

/// Fills lanes with consecutive angles, several at once; the remaining angles use fewer lanes.
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
macro_rules! batch_in_lanes {
    ($float:ident: $($lanes:ident $n:literal from $least:literal),+) => {
        impl Batch for $float {
            #[inline(always)]
            fn sin_cos_in_lanes<const K: usize>(sums: &AngleSums<$float, K>) -> Option<[($float, $float); K]> {
                let mut found = [(0.0, 0.0); K];
                let mut done = 0;
                $(if K - done >= $least {
                    let (mut angles, mut tails, mut any) = ([0.0; $n], [0.0; $n], false);
                    let mut long = false;
                    // Lanes beyond the last angle repeat it.
                    unrolled!($n, |k| {
                        let from = (done + k).min(K - 1);
                        (angles[k], tails[k]) = (sums.angles[from], sums.tails[from]);
                        any |= sums.are_sums[from];
                        long |= sums.are_long[from];
                    });
                    let angles = wide::$lanes::new(angles);
                    let tails = wide::$lanes::new(tails);
                    if !angles.within() || long && !tails.all_below(<$float>::TAIL_LIMIT) {
                        return None;
                    }
                    let tails = any.then_some(tails);
                    let (s, c) = sin_cos_in_range(angles, tails);
                    let (s, c) = (s.to_array(), c.to_array());
                    unrolled!($n, |k| if done + k < K {
                        found[done + k] = (s[k], c[k]);
                    });
                    done = K.min(done + $n);
                })+
                // At most one angle remains.
                if done < K {
                    let (angle, tail) = (sums.angles[K - 1], sums.tails[K - 1]);
                    if !angle.within() || sums.are_long[K - 1] && !tail.all_below(<$float>::TAIL_LIMIT) {
                        return None;
                    }
                    found[K - 1] = sin_cos_in_range(angle, sums.are_sums[K - 1].then_some(tail));
                }
                Some(found)
            }
        }
    };
}

/// Lanes of states are already full: the angles are computed one after the other.
#[cfg(any(
    feature = "wide",
    not(any(target_arch = "x86_64", target_arch = "aarch64"))
))]
macro_rules! one_by_one {
    ($($lanes:ty),+) => {$(
        impl Batch for $lanes {
            #[inline(always)]
            fn sin_cos_in_lanes<const K: usize>(sums: &AngleSums<Self, K>) -> Option<[(Self, Self); K]> {
                let mut within = true;
                unrolled!(K, |k| within &= sums.angles[k].within()
                    && (!sums.are_long[k] || sums.tails[k].all_below(Self::TAIL_LIMIT)));
                let mut found = [(Self::splat(0.0), Self::splat(0.0)); K];
                if within {
                    unrolled!(K, |k| {
                        let tail = sums.are_sums[k].then_some(sums.tails[k]);
                        found[k] = sin_cos_in_range(sums.angles[k], tail);
                    });
                }
                within.then_some(found)
            }
        }
    )+};
}
#[cfg(feature = "wide")]
one_by_one!(
    wide::f64x2,
    wide::f64x4,
    wide::f64x8,
    wide::f32x4,
    wide::f32x8,
    wide::f32x16
);
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
one_by_one!(f64, f32);

// Not in registers of 512 bits: with them whole calls take up to twice as long on an Intel Xeon.
#[cfg(all(
    any(target_arch = "x86_64", target_arch = "aarch64"),
    target_feature = "avx"
))]
batch_in_lanes!(f64: f64x4 4 from 3, f64x4 4 from 3, f64x2 2 from 2);
#[cfg(all(
    any(target_arch = "x86_64", target_arch = "aarch64"),
    not(target_feature = "avx")
))]
batch_in_lanes!(f64: f64x2 2 from 2, f64x2 2 from 2, f64x2 2 from 2, f64x2 2 from 2);
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
batch_in_lanes!(f32: f32x8 8 from 5, f32x4 4 from 2);

//! Sine and cosine in `f64` and `f32`: of one angle, of SIMD lanes, of all angles of a call, bit for bit alike.
//!
//! An angle x within [`SineLanes::LIMIT`] is taken as n quarter turns and a rest r in ±π/4, in two words
//! (Cody and Waite 1980): π/2 is cut into parts that are so short that n times them is exact. Then
//! sin r and cos r are polynomials, and n says which is which and with what sign. There is no branch
//! on the way, so that several angles go through in lanes and every angle takes the same time.
//! Larger angles are reduced exactly, one by one (`large.rs`).
//!
//! Errors stay below one unit in the last place for an angle of any size, and for a sum of two that does not overflow. A sum
//! of three or more terms is carried in two words: it is off by up to |q|·eps² more, where q is the
//! largest of its partial sums and eps the spacing of the numbers above 1. That shows only where the sine
//! is smaller than |q|·eps. `tests/sine.rs` measures both.

/// Angles of a call that are taken at once: the lanes of the widest register.
const MAX_BATCH: usize = 8;

/// The step with k = 0, 1, … below `count`, which is [`MAX_BATCH`] at most, each a constant to the
/// compiler: so arrays of numbers stay in registers.
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

/// The methods of [`Scalar`](crate::Scalar) that this module stands behind.
///
/// They become part of the caller: handed over in memory, lanes would be stored in halves and waited
/// for, and a constant offset would be no constant.
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
use kernel::sin_cos_in_range;
pub(crate) use lanes::SineLanes;

/// Sines and cosines of all angles of a call: each of the exact sum of its `angles` and its offset.
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
    };
    unrolled!(K, |k| {
        let (angle, tail) = exact_sum(angles[k].iter().copied(), offsets[k]);
        sums.angles[k] = angle;
        sums.tails[k] = tail.unwrap_or(zero);
        sums.are_sums[k] = tail.is_some();
    });
    if let Some(found) = T::sin_cos_in_lanes(&sums) {
        return found;
    }
    let mut found = [(zero, zero); K];
    unrolled!(K, |k| found[k] = out_of_line(sums.angles[k], sums.tails[k]));
    found
}

/// Angles of a call. Arrays of numbers, one for each part: of an array of pairs compilers load wide
/// registers from what was just stored in halves, and wait for it.
pub(crate) struct AngleSums<T, const K: usize> {
    /// The sums, rounded.
    angles: [T; K],
    /// What rounding has left.
    tails: [T; K],
    /// Which ones are sums at all.
    are_sums: [bool; K],
}

/// [`sin_cos`], out of the way of calls whose angles are all within the limit: handed over as an array,
/// they would be stored in each of those.
#[cold]
#[inline(never)]
fn out_of_line<T: AnySize>(angle: T, tail: T) -> (T, T) {
    sin_cos(angle, Some(tail))
}

/// Numbers whose sines can be taken several at once.
pub(crate) trait Batch: AnySize + TwoWord {
    /// Sines and cosines of the sums; nothing where not all of them are within the limit.
    fn sin_cos_in_lanes<const K: usize>(sums: &AngleSums<Self, K>) -> Option<[(Self, Self); K]>;
}

/// Fills lanes with one angle after the other, several at a time; what is left over goes in fewer.
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
                    // Lanes beyond the last angle repeat it.
                    unrolled!($n, |k| {
                        let from = (done + k).min(K - 1);
                        (angles[k], tails[k]) = (sums.angles[from], sums.tails[from]);
                        any |= sums.are_sums[from];
                    });
                    let angles = wide::$lanes::new(angles);
                    if !angles.within() {
                        return None;
                    }
                    let tails = any.then(|| wide::$lanes::new(tails));
                    let (s, c) = sin_cos_in_range(angles, tails);
                    let (s, c) = (s.to_array(), c.to_array());
                    unrolled!($n, |k| if done + k < K {
                        found[done + k] = (s[k], c[k]);
                    });
                    done = K.min(done + $n);
                })+
                // One at the most is left.
                if done < K {
                    let (angle, tail) = (sums.angles[K - 1], sums.tails[K - 1]);
                    if !angle.within() {
                        return None;
                    }
                    found[K - 1] = sin_cos_in_range(angle, sums.are_sums[K - 1].then_some(tail));
                }
                Some(found)
            }
        }
    };
}

/// Lanes of states are full as they are: one angle after the other.
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
                unrolled!(K, |k| within &= sums.angles[k].within());
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

#[cfg(all(
    any(target_arch = "x86_64", target_arch = "aarch64"),
    target_feature = "avx512f"
))]
batch_in_lanes!(f64: f64x8 8 from 5, f64x4 4 from 3, f64x2 2 from 2);
#[cfg(all(
    any(target_arch = "x86_64", target_arch = "aarch64"),
    not(target_feature = "avx512f"),
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

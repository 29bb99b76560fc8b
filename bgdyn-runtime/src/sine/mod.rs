//! Sine and cosine of `f64` and `f32`, of one angle, of the lanes of a register, and of all angles
//! of a call at once: one design, and the same bits whichever way.
//!
//! An angle x within [`Pack::LIMIT`] is taken as n quarter turns and a rest r in ±π/4, in two words
//! (Cody and Waite 1980): π/2 is cut into parts that are so short that n times them is exact. Then
//! sin r and cos r are polynomials, and n says which is which and with what sign. There is no branch
//! on the way, so that several angles go through in lanes and every angle takes the same time.
//! Larger angles are reduced exactly, one by one (`large.rs`).
//!
//! Errors stay below one unit in the last place for angles of any size; `tests/sine.rs` measures it.

/// The step with k = 0, 1, … below `count`, each a constant to the compiler: so arrays of numbers stay
/// in registers.
macro_rules! unrolled {
    ($count:expr, |$k:ident| $step:expr) => {
        unrolled!($count, $k, $step; 0 1 2 3 4 5 6 7);
        for $k in (0..$count).skip(8) {
            $step;
        }
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
            $crate::sine::one(self, None)
        }

        // The tail's own rounding is |q|·eps², so the sum is good to eps for |q| up to 1/eps:
        // 4e15 rad for `f64`, 8e6 rad for `f32`.
        #[inline(always)]
        fn sin_cos_sum(angles: &[Self], offset: (f64, f64)) -> (Self, Self) {
            let (angle, tail) = $crate::float::exact_sum(angles.iter().copied(), offset);
            $crate::sine::one(angle, tail)
        }

        #[inline(always)]
        fn sin_cos_all<const K: usize>(
            angles: [&[Self]; K],
            offsets: [(f64, f64); K],
        ) -> [(Self, Self); K] {
            $crate::sine::all(angles, offsets)
        }
    };
}
pub(crate) use methods;

mod kernel;
mod large;
mod pack;

use crate::float::{Split, exact_sum};
pub(crate) use kernel::sin_cos;
pub(crate) use pack::Pack;

/// Sine and cosine of a + tail; `tail` is what the rounding of a sum a has left.
#[inline(always)]
pub(crate) fn one<T: Pack>(angle: T, tail: Option<T>) -> (T, T) {
    if angle.within() {
        sin_cos(angle, tail)
    } else {
        angle.beyond(tail.unwrap_or(T::splat(0.0)))
    }
}

/// Sines and cosines of all angles of a call: each of the exact sum of its `angles` and its offset.
#[inline(always)]
pub(crate) fn all<T: AtOnce, const K: usize>(
    angles: [&[T]; K],
    offsets: [(f64, f64); K],
) -> [(T, T); K] {
    let mut sums = [(T::from_f64(0.0), None); K];
    unrolled!(K, |k| {
        sums[k] = exact_sum(angles[k].iter().copied(), offsets[k]);
    });
    if let Some(found) = T::at_once(sums) {
        return found;
    }
    let mut found = [(T::from_f64(0.0), T::from_f64(0.0)); K];
    unrolled!(K, |k| {
        let (angle, tail) = sums[k];
        found[k] = apart(angle, tail.unwrap_or(T::from_f64(0.0)));
    });
    found
}

/// [`one`], out of the way of calls whose angles are all within the limit: handed over as an array,
/// they would be stored in each of those.
#[cold]
#[inline(never)]
fn apart<T: Pack>(angle: T, tail: T) -> (T, T) {
    one(angle, Some(tail))
}

/// Numbers whose sines can be taken several at once.
pub(crate) trait AtOnce: Pack + Split {
    /// Sines and cosines of the sums `(angle, tail)`; nothing where not all of them are within the
    /// limit.
    fn at_once<const K: usize>(sums: [(Self, Option<Self>); K]) -> Option<[(Self, Self); K]>;
}

/// Fills lanes with one angle after the other, several at a time; what is left over goes in fewer.
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
macro_rules! at_once {
    ($float:ident: $($lanes:ident $n:literal from $least:literal),+) => {
        impl AtOnce for $float {
            #[inline(always)]
            fn at_once<const K: usize>(
                sums: [($float, Option<$float>); K],
            ) -> Option<[($float, $float); K]> {
                let mut found = [(0.0, 0.0); K];
                let mut done = 0;
                $(if K - done >= $least {
                    let (mut angles, mut tails, mut any) = ([0.0; $n], [0.0; $n], false);
                    // Lanes beyond the last angle repeat it.
                    unrolled!($n, |k| {
                        let (angle, tail) = sums[(done + k).min(K - 1)];
                        any |= tail.is_some();
                        (angles[k], tails[k]) = (angle, tail.unwrap_or(0.0));
                    });
                    let angles = wide::$lanes::new(angles);
                    if !angles.within() {
                        return None;
                    }
                    let tails = any.then(|| wide::$lanes::new(tails));
                    let (s, c) = sin_cos(angles, tails);
                    let (s, c) = (s.to_array(), c.to_array());
                    unrolled!($n, |k| if done + k < K {
                        found[done + k] = (s[k], c[k]);
                    });
                    done = K.min(done + $n);
                })+
                for k in done..K {
                    let (angle, tail) = sums[k];
                    if !angle.within() {
                        return None;
                    }
                    found[k] = sin_cos(angle, tail);
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
        impl AtOnce for $lanes {
            #[inline(always)]
            fn at_once<const K: usize>(
                sums: [(Self, Option<Self>); K],
            ) -> Option<[(Self, Self); K]> {
                let mut within = true;
                unrolled!(K, |k| within &= sums[k].0.within());
                let mut found = [(Self::splat(0.0), Self::splat(0.0)); K];
                if within {
                    unrolled!(K, |k| found[k] = sin_cos(sums[k].0, sums[k].1));
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
at_once!(f64: f64x8 8 from 5, f64x4 4 from 3, f64x2 2 from 2);
#[cfg(all(
    any(target_arch = "x86_64", target_arch = "aarch64"),
    not(target_feature = "avx512f"),
    target_feature = "avx"
))]
at_once!(f64: f64x4 4 from 3, f64x4 4 from 3, f64x2 2 from 2);
#[cfg(all(
    any(target_arch = "x86_64", target_arch = "aarch64"),
    not(target_feature = "avx")
))]
at_once!(f64: f64x2 2 from 2, f64x2 2 from 2, f64x2 2 from 2, f64x2 2 from 2);
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
at_once!(f32: f32x8 8 from 5, f32x4 4 from 2);

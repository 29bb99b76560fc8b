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

mod kernel;
mod large;
mod pack;

use crate::float::{Split, exact_sum};
pub(crate) use kernel::sin_cos;
pub(crate) use pack::Pack;

/// Sine and cosine of a + tail; `tail` is what the rounding of a sum a has left.
#[inline(always)]
pub(crate) fn one<T: Pack>(angle: T, tail: T) -> (T, T) {
    if angle.within() {
        sin_cos(angle, tail)
    } else {
        angle.beyond(tail)
    }
}

/// Sines and cosines of all angles of a call: each of the exact sum of its `angles` and its offset.
#[inline(always)]
pub(crate) fn all<T: AtOnce, const K: usize>(
    angles: [&[T]; K],
    offsets: [(f64, f64); K],
) -> [(T, T); K] {
    let mut sums = [(T::from_f64(0.0), T::from_f64(0.0)); K];
    let mut within = true;
    unrolled!(K, |k| {
        sums[k] = plain_or_sum(angles[k], offsets[k]);
        within &= sums[k].0.within();
    });
    if within {
        return T::at_once(sums);
    }
    unrolled!(K, |k| sums[k] = apart(sums[k].0, sums[k].1));
    sums
}

/// [`one`], out of the way of calls whose angles are all within the limit: handed over as an array,
/// they would be stored in each of those.
#[cold]
#[inline(never)]
fn apart<T: Pack>(angle: T, tail: T) -> (T, T) {
    one(angle, tail)
}

/// The sum of angles and an offset, in two words.
#[inline(always)]
pub(crate) fn plain_or_sum<T: Split>(angles: &[T], offset: (f64, f64)) -> (T, T) {
    match angles {
        [angle] if offset == (0.0, 0.0) => (*angle, T::from_f64(0.0)),
        _ => exact_sum(angles.iter().copied(), offset),
    }
}

/// Numbers whose sines can be taken several at once.
pub(crate) trait AtOnce: Pack + Split {
    /// Sines and cosines of the sums `(angle, tail)`, all of them within the limit.
    fn at_once<const K: usize>(sums: [(Self, Self); K]) -> [(Self, Self); K];
}

/// Fills lanes with one angle after the other, several at a time; what is left over goes in fewer.
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
macro_rules! at_once {
    ($float:ident: $($lanes:ident $n:literal from $least:literal),+) => {
        impl AtOnce for $float {
            #[inline(always)]
            fn at_once<const K: usize>(sums: [($float, $float); K]) -> [($float, $float); K] {
                let mut found = [(0.0, 0.0); K];
                let mut done = 0;
                $(if K - done >= $least {
                    let (mut angles, mut tails) = ([0.0; $n], [0.0; $n]);
                    // Lanes beyond the last angle repeat it.
                    unrolled!($n, |k| (angles[k], tails[k]) = sums[(done + k).min(K - 1)]);
                    let (s, c) = sin_cos(wide::$lanes::new(angles), wide::$lanes::new(tails));
                    let (s, c) = (s.to_array(), c.to_array());
                    unrolled!($n, |k| if done + k < K {
                        found[done + k] = (s[k], c[k]);
                    });
                    done = K.min(done + $n);
                })+
                for k in done..K {
                    found[k] = sin_cos(sums[k].0, sums[k].1);
                }
                found
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
            fn at_once<const K: usize>(mut sums: [(Self, Self); K]) -> [(Self, Self); K] {
                unrolled!(K, |k| sums[k] = sin_cos(sums[k].0, sums[k].1));
                sums
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

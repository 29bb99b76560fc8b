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

mod kernel;
mod large;
mod pack;

use crate::float::{Float, Split, exact_sum};
pub(crate) use kernel::sin_cos;
use large::Large;
pub(crate) use pack::Pack;

/// Sine and cosine of a + tail; `tail` is what the rounding of a sum a has left.
#[inline(always)]
pub(crate) fn one<T: Float + Large>(angle: T, tail: T) -> (T, T) {
    if angle.within() {
        sin_cos(angle, tail)
    } else {
        T::turn(large::sin_cos(angle), tail)
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
    for ((sum, angles), offset) in sums.iter_mut().zip(angles).zip(offsets) {
        *sum = plain_or_sum(angles, offset);
        within &= sum.0.within();
    }
    if within {
        T::at_once(sums)
    } else {
        sums.map(|(angle, tail)| one(angle, tail))
    }
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
pub(crate) trait AtOnce: Float + Large {
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
                $(
                    while K - done >= $least {
                        // Lanes beyond the last angle repeat it.
                        let lane = |k: usize| sums[(done + k).min(K - 1)];
                        let (mut angles, mut tails) = ([0.0; $n], [0.0; $n]);
                        for k in 0..$n {
                            (angles[k], tails[k]) = lane(k);
                        }
                        let (s, c) = sin_cos(wide::$lanes::new(angles), wide::$lanes::new(tails));
                        let (s, c) = (s.to_array(), c.to_array());
                        for k in 0..$n.min(K - done) {
                            found[done + k] = (s[k], c[k]);
                        }
                        done = K.min(done + $n);
                    }
                )+
                // By number: this folds away where nothing is left, an iterator's `skip` does not.
                while done < K {
                    found[done] = sin_cos(sums[done].0, sums[done].1);
                    done += 1;
                }
                found
            }
        }
    };
}

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
at_once!(f64: f64x4 4 from 3, f64x2 2 from 2);
#[cfg(all(
    any(target_arch = "x86_64", target_arch = "aarch64"),
    not(target_feature = "avx")
))]
at_once!(f64: f64x2 2 from 2);
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
at_once!(f32: f32x8 8 from 5, f32x4 4 from 2);

/// Elsewhere one after the other.
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
macro_rules! one_by_one {
    ($($float:ident)*) => {$(
        impl AtOnce for $float {
            fn at_once<const K: usize>(sums: [($float, $float); K]) -> [($float, $float); K] {
                sums.map(|(angle, tail)| sin_cos(angle, tail))
            }
        }
    )*};
}
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
one_by_one!(f64 f32);

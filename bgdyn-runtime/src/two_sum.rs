//! Exact sums of two numbers in two words (Knuth's two-sum).

use core::ops::{Add, Sub};

use crate::Scalar;

/// Constants in two words.
pub(crate) trait TwoWord: Scalar {
    /// Returns the value nearest to `hi`, and the value nearest to the remainder of `hi + lo`.
    fn two_words(hi: f64, lo: f64) -> (Self, Self);
}

/// Returns the sum of `angles` and `offset`, summed one after the other, and its rounding error (`None` for a
/// single angle). The error is at most half a unit in the sum's last place for two terms; for more, it is as
/// large as the errors of all partial sums, and can be larger than the sum. Works in any arithmetic that
/// rounds as `f64` and `f32` do, lane by lane.
#[inline(always)]
pub(crate) fn exact_sum<T: TwoWord>(
    mut angles: impl Iterator<Item = T>,
    offset: (f64, f64),
) -> (T, Option<T>) {
    let (mut sum, mut tail) = match offset {
        (0.0, 0.0) => (angles.next().unwrap_or(T::from_f64(0.0)), None),
        (hi, lo) => {
            let (hi, lo) = T::two_words(hi, lo);
            (hi, Some(lo))
        }
    };
    for angle in angles {
        // Knuth's two-sum: the exact rounding error of the addition. The errors of earlier additions are
        // added to the shorter of its two paths, so that nothing waits for them.
        let next = sum + angle;
        let back = next - sum;
        let left = angle - back;
        let left = tail.map_or(left, |tail| left + tail);
        tail = Some((sum - (next - back)) + left);
        sum = next;
    }
    (sum, tail)
}

/// Returns the sum of two numbers, rounded, and its rounding error.
#[inline(always)]
pub(crate) fn two_sum<T: Copy + Add<Output = T> + Sub<Output = T>>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    let back = sum - a;
    (sum, (a - (sum - back)) + (b - back))
}

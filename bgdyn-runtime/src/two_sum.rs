//! Exact sums of two numbers in two words (Knuth's two-sum).

use crate::Scalar;

/// Constants in two words.
pub(crate) trait TwoWord: Scalar {
    /// Returns the value nearest to `hi`, and the value nearest to the remainder of `hi + lo`.
    fn two_words(hi: f64, lo: f64) -> (Self, Self);
}

/// Returns the sum of `angles` and `offset`, rounded, and its rounding error (`None` for a single angle).
/// Works in any arithmetic that rounds as `f64` and `f32` do, lane by lane.
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
    let mut sums = 0;
    for angle in angles {
        sums += 1;
        // Knuth's two-sum: the exact rounding error of the addition. The errors of earlier additions are
        // added to the shorter of its two paths, so that nothing waits for them.
        let next = sum + angle;
        let back = next - sum;
        let left = angle - back;
        let left = tail.map_or(left, |tail| left + tail);
        tail = Some((sum - (next - back)) + left);
        sum = next;
    }
    let (1.., Some(tail)) = (sums, tail) else {
        return (sum, None);
    };
    if sums == 1 {
        // The tail must be at most half a unit in the last place. If more than that is left of the offset,
        // the angle has cancelled it and has no digits below those of the offset's first word.
        return (sum, Some(tail));
    }
    // A second two-sum makes the tail that small.
    let angle = sum + tail;
    let back = angle - sum;
    (angle, Some((sum - (angle - back)) + (tail - back)))
}

//! Exact sums of two numbers in two words (Knuth's two-sum).

use crate::Scalar;

/// Constants in two words.
pub(crate) trait TwoWord: Scalar {
    /// The nearest value to `hi`, and the nearest to the rest of `hi + lo`.
    fn two_words(hi: f64, lo: f64) -> (Self, Self);
}

/// The sum of `angles` and `offset`, rounded, and what the rounding leaves, but for a single angle;
/// in any arithmetic that rounds as `f64` and `f32` do, lane by lane.
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
        // Knuth's two-sum: the rounding error of the addition, exactly. What is left of earlier ones
        // joins the shorter of its two ways, so that nothing waits for it.
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
        // The tail is half a unit in the last place: where more than that is left of the offset, the
        // angle has cancelled it, and has no digits that the offset's first word has not.
        return (sum, Some(tail));
    }
    // And once more, so that it is.
    let angle = sum + tail;
    let back = angle - sum;
    (angle, Some((sum - (angle - back)) + (tail - back)))
}

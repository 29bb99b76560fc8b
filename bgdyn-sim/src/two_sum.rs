//! Sums in two words.

use bgdyn_runtime::Scalar;

/// Returns a + b rounded, and the rounding error (Knuth's two-sum).
pub(crate) fn sum_in_two<T: Scalar>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    let back = sum - a;
    (sum, (a - (sum - back)) + (b - back))
}

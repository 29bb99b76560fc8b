//! Linear combinations of rows of numbers, in an order that compilers turn into vector instructions.
//!
//! Matrices of the sweep are kept row by row. A product a·b then adds multiples of rows of b, whose entries lie side by
//! side, to a row of the result. Entries are taken in pieces of 8, then of 4, 2 and 1, whose sums stay in registers.

use crate::real::Real;

/// Adds Σ coefficient(k) · row(k) over k = 0 … `terms` − 1 to `sum`; the rows are at least as long as the sum.
#[inline(always)]
pub(super) fn add_rows<'a, T: Real>(
    sum: &mut [T],
    terms: core::ops::Range<usize>,
    coefficient: impl Fn(usize) -> T,
    row: impl Fn(usize) -> &'a [T],
) {
    let from = add_pieces::<T, 8>(sum, 0, terms.clone(), &coefficient, &row);
    let from = add_pieces::<T, 4>(sum, from, terms.clone(), &coefficient, &row);
    let from = add_pieces::<T, 2>(sum, from, terms.clone(), &coefficient, &row);
    add_pieces::<T, 1>(sum, from, terms, &coefficient, &row);
}

/// [`add_rows`] for as many pieces of `L` entries as there are; returns the first entry that is left.
#[inline(always)]
fn add_pieces<'a, T: Real, const L: usize>(
    sum: &mut [T],
    mut from: usize,
    terms: core::ops::Range<usize>,
    coefficient: &impl Fn(usize) -> T,
    row: &impl Fn(usize) -> &'a [T],
) -> usize {
    while from + L <= sum.len() {
        let mut piece: [T; L] = core::array::from_fn(|i| sum[from + i]);
        for k in terms.clone() {
            let (factor, row) = (coefficient(k), &row(k)[from..from + L]);
            for i in 0..L {
                piece[i] = factor.mul_add(row[i], piece[i]);
            }
        }
        sum[from..from + L].copy_from_slice(&piece);
        from += L;
    }
    from
}

/// Returns Σ a_i b_i.
pub(super) fn inner<T: Real, const N: usize>(a: &[T; N], b: &[T; N]) -> T {
    let pairs = a.iter().zip(b);
    pairs.fold(T::from_f64(0.0), |sum, (&a, &b)| a.mul_add(b, sum))
}

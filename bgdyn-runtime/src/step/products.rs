//! Products and sums of small matrices in any scalar.

use nalgebra::{SMatrix, SVector};

use crate::Scalar;

/// Returns a + k b.
pub(super) fn plus<T: Scalar, const R: usize, const C: usize>(
    a: &SMatrix<T, R, C>,
    k: T,
    b: &SMatrix<T, R, C>,
) -> SMatrix<T, R, C> {
    a.zip_map(b, |a, b| k.mul_add(b, a))
}

/// Returns the unit matrix times k.
pub(super) fn multiple_of_one<T: Scalar, const N: usize>(k: T) -> SMatrix<T, N, N> {
    SMatrix::from_fn(|i, j| if i == j { k } else { T::from_f64(0.0) })
}

/// Returns a b.
pub(super) fn product<T: Scalar, const R: usize, const K: usize, const C: usize>(
    a: &SMatrix<T, R, K>,
    b: &SMatrix<T, K, C>,
) -> SMatrix<T, R, C> {
    let mut result = SMatrix::repeat(T::from_f64(0.0));
    for (sums, column) in result.data.0.iter_mut().zip(&b.data.0) {
        for (of_a, &y) in a.data.0.iter().zip(column) {
            for (sum, &x) in sums.iter_mut().zip(of_a) {
                *sum = x.mul_add(y, *sum);
            }
        }
    }
    result
}

/// Returns aᵀ x.
pub(super) fn transposed_product<T: Scalar, const R: usize, const C: usize>(
    a: &SMatrix<T, R, C>,
    x: &SVector<T, R>,
) -> SVector<T, C> {
    let [x] = &x.data.0;
    let of_column = |column: &[T; R]| {
        let pairs = column.iter().zip(x);
        pairs.fold(T::from_f64(0.0), |sum, (&a, &x)| a.mul_add(x, sum))
    };
    crate::vector(a.data.0.each_ref().map(of_column))
}

//! Constructors of vectors and matrices from their entries, for generated code.

use nalgebra::{ArrayStorage, SMatrix, SVector};

use crate::Scalar;

/// Returns the vector with the given entries.
#[inline(always)]
pub fn vector<T, const N: usize>(entries: [T; N]) -> SVector<T, N> {
    SVector::from_array_storage(ArrayStorage([entries]))
}

/// Returns the matrix with the given columns.
#[inline(always)]
pub fn matrix<T, const R: usize, const C: usize>(columns: [[T; R]; C]) -> SMatrix<T, R, C> {
    SMatrix::from_array_storage(ArrayStorage(columns))
}

/// Copies the entries below the diagonal to the entries above it.
#[inline]
pub fn mirror<T: Copy, const N: usize>(matrix: &mut SMatrix<T, N, N>) {
    let columns = &mut matrix.data.0;
    for j in 1..N {
        for i in 0..j {
            columns[j][i] = columns[i][j];
        }
    }
}

/// Computes entries of a matrix as inner products of a vector of the row and a vector of the column.
///
/// `rows[c][i]` is component c of the vector of row i. A run is a column, its first row and the row after
/// its last; run k uses the column vector at index k of `columns`. Rows and columns outside of the matrix
/// are skipped.
#[inline]
pub fn inner_products<T, const N: usize, const L: usize, const C: usize, const K: usize>(
    matrix: &mut SMatrix<T, N, N>,
    rows: &[[T; L]; C],
    columns: &[[T; C]; K],
    runs: &[[usize; 3]; K],
) where
    T: Scalar,
{
    for (column, &[j, from, to]) in columns.iter().zip(runs) {
        let Some(entries) = matrix.data.0.get_mut(j) else {
            continue;
        };
        for i in from..to.min(N).min(L) {
            let mut pairs = rows.iter().zip(column);
            let first = pairs.next().map(|(row, &y)| row[i] * y);
            let add = |sum, (row, &y): (&[T; L], &T)| T::mul_add(row[i], y, sum);
            if let Some(first) = first {
                entries[i] = pairs.fold(first, add);
            }
        }
    }
}

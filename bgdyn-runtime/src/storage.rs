//! Vectors and matrices from their entries, as generated code writes them.

use nalgebra::{ArrayStorage, SMatrix, SVector};

/// The vector of these entries.
#[inline(always)]
pub fn vector<T, const N: usize>(entries: [T; N]) -> SVector<T, N> {
    SVector::from_array_storage(ArrayStorage([entries]))
}

/// The matrix of these columns.
#[inline(always)]
pub fn matrix<T, const R: usize, const C: usize>(columns: [[T; R]; C]) -> SMatrix<T, R, C> {
    SMatrix::from_array_storage(ArrayStorage(columns))
}

//! Results as lists of numbers, matrices row by row.

use std::fmt::Debug;

use bgdyn::Scalar;
use bgdyn::nalgebra::SMatrix;
use bgdyn::runtime::Pose;

use crate::Outcome;

pub(crate) fn number<T: Scalar>(x: T) -> Outcome<T> {
    Ok(vec![x])
}

pub(crate) fn matrix<T: Scalar, const R: usize, const C: usize>(x: SMatrix<T, R, C>) -> Outcome<T> {
    Ok(rows(&x))
}

pub(crate) fn matrices<T: Scalar, const R: usize, const C: usize, const K: usize>(
    x: [SMatrix<T, R, C>; K],
) -> Outcome<T> {
    Ok(x.iter().flat_map(rows).collect())
}

pub(crate) fn pose<T: Scalar>(x: Pose<T>) -> Outcome<T> {
    let mut all = rows(&x.rotation);
    all.extend(rows(&x.translation));
    Ok(all)
}

pub(crate) fn checked<T: Scalar, E: Debug, const R: usize, const C: usize>(
    x: Result<SMatrix<T, R, C>, E>,
) -> Outcome<T> {
    x.map_err(text).and_then(matrix)
}

pub(crate) fn checked_matrices<
    T: Scalar,
    E: Debug,
    const R: usize,
    const C: usize,
    const K: usize,
>(
    x: Result<[SMatrix<T, R, C>; K], E>,
) -> Outcome<T> {
    x.map_err(text).and_then(matrices)
}

fn rows<T: Scalar, const R: usize, const C: usize>(x: &SMatrix<T, R, C>) -> Vec<T> {
    (0..R * C).map(|k| x[(k / C, k % C)]).collect()
}

fn text(error: impl Debug) -> String {
    format!("{error:?}")
}

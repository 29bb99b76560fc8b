//! LU factorisation with partial pivoting, in any scalar without lanes.

use bgdyn_runtime::{ArrayOf, StateVector};

use crate::real::{Of, Real};

/// A factored square matrix.
#[derive(Clone, Debug)]
pub(crate) struct Lu<Y: StateVector> {
    /// Unit lower and upper factors in one matrix.
    factors: Y::Matrix,
    /// Index of the row that was moved to each row.
    pivots: ArrayOf<Y, usize>,
}

impl<Y: StateVector> Lu<Y>
where
    Of<Y>: Real,
{
    /// Factors a matrix for vectors such as `like`; `None` if a pivot is 0 or not finite.
    pub(crate) fn new(mut factors: Y::Matrix, like: &Y) -> Option<Self> {
        let mut pivots = like.array(0);
        let n = like.entries().len();
        let sound = factor(Y::columns_mut(&mut factors), pivots.as_mut(), n);
        sound.then_some(Lu { factors, pivots })
    }

    /// Replaces x by the solution for the right-hand side x.
    pub(crate) fn solve(&self, x: &mut Y) {
        solve(
            Y::columns(&self.factors),
            self.pivots.as_ref(),
            x.entries_mut(),
        );
    }

    /// Solves for every column of a matrix.
    pub(crate) fn solve_columns(&self, matrix: &mut Y::Matrix) {
        let pivots = self.pivots.as_ref();
        for column in Y::columns_mut(matrix).chunks_mut(pivots.len().max(1)) {
            solve(Y::columns(&self.factors), pivots, column);
        }
    }
}

/// Factors an n × n matrix, column by column, in place. Returns false if a pivot is 0 or not finite.
pub(crate) fn factor<T: Real>(a: &mut [T], pivots: &mut [usize], n: usize) -> bool {
    for k in 0..n {
        let mut p = k;
        for i in k + 1..n {
            if a[k * n + p].abs() < a[k * n + i].abs() {
                p = i;
            }
        }
        pivots[k] = p;
        let pivot = a[k * n + p];
        if pivot == T::from_f64(0.0) || !pivot.is_finite() {
            return false;
        }
        for column in a.chunks_mut(n) {
            column.swap(k, p);
        }
        let (done, rest) = a.split_at_mut((k + 1) * n);
        let multipliers = &mut done[k * n + k + 1..];
        for x in &mut *multipliers {
            *x = *x / pivot;
        }
        for column in rest.chunks_mut(n) {
            let top = column[k];
            eliminate(&mut column[k + 1..], multipliers, top);
        }
    }
    true
}

/// Solves with the factors of [`factor`], in place.
pub(crate) fn solve<T: Real>(a: &[T], pivots: &[usize], x: &mut [T]) {
    let n = x.len();
    // The rows of the factors are in their final order: permute x before the elimination.
    for (k, &p) in pivots.iter().enumerate() {
        x.swap(k, p);
    }
    for (k, column) in a.chunks(n.max(1)).enumerate() {
        let top = x[k];
        eliminate(&mut x[k + 1..], &column[k + 1..], top);
    }
    for (k, column) in a.chunks(n.max(1)).enumerate().rev() {
        let top = x[k] / column[k];
        x[k] = top;
        eliminate(&mut x[..k], &column[..k], top);
    }
}

/// Solves for four right-hand sides at once, the rows of x, as [`solve`] does for each.
pub(crate) fn solve_four<T: Real>(a: &[T], pivots: &[usize], x: &mut [[T; 4]]) {
    let n = x.len();
    for (k, &p) in pivots.iter().enumerate() {
        x.swap(k, p);
    }
    for (k, column) in a.chunks(n.max(1)).enumerate() {
        let top = x[k];
        eliminate_four(&mut x[k + 1..], &column[k + 1..], top);
    }
    for (k, column) in a.chunks(n.max(1)).enumerate().rev() {
        let top = x[k].map(|x| x / column[k]);
        x[k] = top;
        eliminate_four(&mut x[..k], &column[..k], top);
    }
}

/// Computes x ← x − column · topᵀ.
fn eliminate_four<T: Real>(x: &mut [[T; 4]], column: &[T], top: [T; 4]) {
    for (row, &factor) in x.iter_mut().zip(column) {
        for (x, top) in row.iter_mut().zip(top) {
            *x = *x - factor * top;
        }
    }
}

/// Computes x ← x − top · column.
fn eliminate<T: Real>(x: &mut [T], column: &[T], top: T) {
    for (x, &factor) in x.iter_mut().zip(column) {
        *x = *x - factor * top;
    }
}

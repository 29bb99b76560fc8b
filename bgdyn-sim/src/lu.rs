//! LU factorisation and inverse with partial pivoting, in any scalar without lanes.

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

/// Computes x ← x − top · column.
fn eliminate<T: Real>(x: &mut [T], column: &[T], top: T) {
    for (x, &factor) in x.iter_mut().zip(column) {
        *x = *x - factor * top;
    }
}

/// Inverts an n × n matrix, column by column, in place: Gauss and Jordan's elimination with partial pivoting. Returns false
/// if a pivot is 0 or not finite.
pub(crate) fn invert<T: Real>(a: &mut [T], pivots: &mut [usize], n: usize) -> bool {
    let (zero, one) = (T::from_f64(0.0), T::from_f64(1.0));
    for k in 0..n {
        let column = &a[k * n..(k + 1) * n];
        let larger = |p: usize, i: usize| {
            if column[p].abs() < column[i].abs() {
                i
            } else {
                p
            }
        };
        let p = (k + 1..n).fold(k, larger);
        pivots[k] = p;
        let pivot = column[p];
        if pivot == zero || !pivot.is_finite() {
            return false;
        }
        for column in a.chunks_mut(n) {
            column.swap(k, p);
        }
        // Rows other than k lose their multiple of row k, which becomes one of the inverse.
        let (before, rest) = a.split_at_mut(k * n);
        let (own, after) = rest.split_at_mut(n);
        own[k] = zero;
        for column in before.chunks_mut(n).chain(after.chunks_mut(n)) {
            let top = column[k] / pivot;
            column[k] = zero;
            eliminate(column, own, top);
            column[k] = top;
        }
        for x in &mut *own {
            *x = -(*x / pivot);
        }
        own[k] = one / pivot;
    }
    for (k, &p) in pivots[..n]
        .iter()
        .enumerate()
        .rev()
        .filter(|&(k, &p)| k != p)
    {
        let (before, after) = a.split_at_mut(p * n);
        before[k * n..(k + 1) * n].swap_with_slice(&mut after[..n]);
    }
    true
}

#[cfg(test)]
mod tests {
    use super::invert;

    /// A product of a matrix with its inverse is 1, with pivots from below, and a singular one has no inverse.
    #[test]
    fn inverses_are_those_of_their_matrices() {
        const N: usize = 7;
        let matrix: [f64; N * N] = core::array::from_fn(|i| {
            let (column, row) = (i / N, i % N);
            let far = if (row + 3) % N == column { 4.0 } else { 0.0 };
            far + (1.7 * i as f64 + 0.3 * (i * i) as f64).sin()
        });
        let (mut inverse, mut pivots) = (matrix, [0; N]);
        assert!(invert(&mut inverse, &mut pivots, N));
        assert!(pivots.iter().enumerate().any(|(k, &p)| k != p));
        for i in 0..N {
            for j in 0..N {
                let product: f64 = (0..N).map(|k| matrix[k * N + i] * inverse[j * N + k]).sum();
                let one = if i == j { 1.0 } else { 0.0 };
                assert!((product - one).abs() < 1e-13, "{i}, {j}: {product}");
            }
        }
        let mut singular = matrix;
        singular.copy_within(0..N, 3 * N);
        assert!(!invert(&mut singular, &mut pivots, N) || singular.iter().any(|x| x.abs() > 1e12));
        assert!(!invert(&mut [0.0; 4], &mut pivots[..2], 2));
    }
}

//! Small systems of linear equations in double-double.

use bgdyn_runtime::Dd;

/// Solves A X = B by elimination with complete pivoting; `b` are the columns of B. `None` if the largest pivot
/// left is not larger than `least` times the first one.
pub(crate) fn solve(mut a: Vec<Vec<Dd>>, b: &[Vec<Dd>], least: f64) -> Option<Vec<Vec<Dd>>> {
    let n = a.len();
    for (row, entries) in a.iter_mut().enumerate() {
        entries.extend(b.iter().map(|column| column[row]));
    }
    let (pivots, smallest) = eliminate(&mut a, n);
    if pivots.len() < n || smallest <= least {
        return None;
    }
    let mut found = vec![vec![Dd::ZERO; n]; b.len()];
    for &(row, column) in &pivots {
        for (k, x) in found.iter_mut().enumerate() {
            x[column] = a[row][n + k] / a[row][column];
        }
    }
    Some(found)
}

/// Eliminates the first `columns` columns (Gauss–Jordan, complete pivoting). Returns the pivots, row and column,
/// and the ratio of the smallest to the largest one; pivots below 1e-24 of the largest are rounding errors and are
/// left out.
pub(crate) fn eliminate(a: &mut [Vec<Dd>], columns: usize) -> (Vec<(usize, usize)>, f64) {
    let mut pivots: Vec<(usize, usize)> = Vec::new();
    let (mut largest, mut smallest) = (0.0_f64, f64::INFINITY);
    while let Some((row, column, size)) = best_pivot(a, columns, &pivots) {
        largest = largest.max(size);
        if size <= 1e-24 * largest {
            break;
        }
        smallest = smallest.min(size);
        pivots.push((row, column));
        let (pivot_row, pivot) = (a[row].clone(), a[row][column]);
        for (i, other) in a.iter_mut().enumerate() {
            if i == row || other[column] == Dd::ZERO {
                continue;
            }
            let factor = other[column] / pivot;
            for (x, &y) in other.iter_mut().zip(&pivot_row) {
                *x -= factor * y;
            }
            other[column] = Dd::ZERO;
        }
    }
    let ratio = if largest > 0.0 {
        smallest / largest
    } else {
        0.0
    };
    (pivots, ratio)
}

/// Returns the number of pivots that are no less than 1e-18 of the largest one.
pub(super) fn rank(a: &mut [Vec<Dd>], columns: usize) -> usize {
    let (pivots, _) = eliminate(a, columns);
    let sizes = pivots
        .iter()
        .map(|&(row, column)| a[row][column].to_f64().abs());
    let largest = sizes.clone().fold(0.0, f64::max);
    sizes.filter(|size| *size > 1e-18 * largest).count()
}

/// Returns the largest entry of the rows and columns without a pivot.
fn best_pivot(
    a: &[Vec<Dd>],
    columns: usize,
    pivots: &[(usize, usize)],
) -> Option<(usize, usize, f64)> {
    let free_row = |i: &usize| pivots.iter().all(|(row, _)| row != i);
    let free_column = |j: &usize| pivots.iter().all(|(_, column)| column != j);
    let mut best: Option<(usize, usize, f64)> = None;
    for i in (0..a.len()).filter(free_row) {
        for j in (0..columns).filter(free_column) {
            let size = a[i][j].to_f64().abs();
            if size > best.map_or(0.0, |(.., size)| size) {
                best = Some((i, j, size));
            }
        }
    }
    best
}

/// Returns whether the determinant of a square matrix is positive.
pub(super) fn is_positive(mut a: Vec<Vec<Dd>>) -> bool {
    let n = a.len();
    let mut positive = true;
    for k in 0..n {
        let size = |i: &usize| a[*i][k].to_f64().abs();
        let Some(row) = (k..n).max_by(|i, j| size(i).total_cmp(&size(j))) else {
            return positive;
        };
        if row != k {
            a.swap(row, k);
            positive = !positive;
        }
        let pivot = a[k].clone();
        if pivot[k] == Dd::ZERO {
            return false;
        }
        positive ^= pivot[k] < Dd::ZERO;
        for other in &mut a[k + 1..] {
            let factor = other[k] / pivot[k];
            for (x, &y) in other.iter_mut().zip(&pivot) {
                *x -= factor * y;
            }
        }
    }
    positive
}

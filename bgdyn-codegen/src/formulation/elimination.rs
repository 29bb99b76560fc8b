//! Eliminates a square matrix of expressions.
//!
//! Pivots are chosen from their values at sampled positions: large at all of them, constant if possible.

use bgdyn_runtime::Dd;

use crate::expr::{Builder, Expr, Inputs, Signed, evaluate};

/// A pivot may be smaller than the best one by this factor if it is constant or saves operations.
const AS_LARGE: f64 = 0.1;

/// A square matrix, eliminated.
pub(super) struct EliminatedMatrix<'g> {
    b: &'g Builder,
    /// The pivots in their order: row, column.
    pivots: Vec<(usize, usize)>,
    /// The matrix after elimination: factors of rows below a pivot, in its column.
    matrix: Vec<Vec<Expr<'g>>>,
    /// 1 / pivot, by column.
    inverse: Vec<Expr<'g>>,
    /// Number of pivots that are not constant.
    varying: usize,
}

/// A place for a pivot.
struct PivotPlace {
    row: usize,
    column: usize,
    /// Its size at the sampled positions.
    size: f64,
}

impl<'g> EliminatedMatrix<'g> {
    /// Eliminates a matrix; with `checks` its pivots are checked, that of each row by its
    /// index.
    pub(super) fn new(
        b: &'g Builder,
        mut matrix: Vec<Vec<Expr<'g>>>,
        samples: &[Vec<Dd>],
        checks: Option<&[usize]>,
    ) -> Self {
        let n = matrix.len();
        let mut pivots: Vec<(usize, usize)> = Vec::new();
        let mut inverse = vec![b.zero(); n];
        // The product of the pivots so far that are not constant.
        let (mut product, mut varying): (Option<Expr<'g>>, usize) = (None, 0);
        for k in 1..=n {
            let place = pivot(b, &matrix, &pivots, samples);
            let (row, column) = (place.row, place.column);
            pivots.push((row, column));
            let check = checks.map(|checks| checks[row]);
            let value = matrix[row][column];
            inverse[column] = match check {
                None => b.constant(Dd::ONE) / value,
                Some(index) if k < n => inverted_early(b, value, place.size, index),
                Some(index) => inverted_last(b, (value, product), samples, index),
            };
            if value.as_constant().is_none() {
                varying += 1;
                if check.is_some() {
                    product = Some(product.map_or(value, |product| product * value));
                }
            }
            let free_row = |i: &usize| pivots.iter().all(|(row, _)| row != i);
            let free_column = |j: &usize| pivots.iter().all(|(_, column)| column != j);
            for i in (0..n).filter(free_row) {
                if matrix[i][column].is_zero() {
                    continue;
                }
                let factor = matrix[i][column] * inverse[column];
                for j in (0..n).filter(free_column) {
                    matrix[i][j] = matrix[i][j] - factor * matrix[row][j];
                }
                matrix[i][column] = factor;
            }
        }
        EliminatedMatrix {
            b,
            pivots,
            matrix,
            inverse,
            varying,
        }
    }

    /// Returns the number of pivots, not constant, that others follow: they may vanish where the matrix is regular.
    pub(super) fn early(&self) -> usize {
        self.varying.saturating_sub(1)
    }

    /// Returns the solution of the transposed equations for one side, which is by column; the result is by row.
    pub(super) fn solve_transposed(&self, mut side: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
        let mut x = vec![self.b.zero(); side.len()];
        for (k, &(row, column)) in self.pivots.iter().enumerate() {
            x[row] = side[column] * self.inverse[column];
            for &(_, j) in &self.pivots[k + 1..] {
                side[j] = side[j] - self.matrix[row][j] * x[row];
            }
        }
        for (k, &(row, column)) in self.pivots.iter().enumerate().rev() {
            for &(i, _) in &self.pivots[k + 1..] {
                x[row] = x[row] - self.matrix[i][column] * x[i];
            }
        }
        x
    }

    /// Returns the solution for one side.
    pub(super) fn solve(&self, mut side: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
        let mut x = vec![self.b.zero(); side.len()];
        for (k, &(row, column)) in self.pivots.iter().enumerate() {
            for &(i, _) in &self.pivots[k + 1..] {
                side[i] = side[i] - self.matrix[i][column] * side[row];
            }
        }
        for (k, &(row, column)) in self.pivots.iter().enumerate().rev() {
            let later = self.pivots[k + 1..].iter();
            let rest = later.fold(side[row], |rest, &(_, j)| rest - self.matrix[row][j] * x[j]);
            x[column] = rest * self.inverse[column];
        }
        x
    }
}

/// Returns 1 / pivot for a pivot that others follow. It may have either sign at regular positions, and is refused if it
/// is a rounding error of its size: there this order of pivots has no digits.
fn inverted_early<'g>(b: &'g Builder, value: Expr<'g>, size: f64, index: usize) -> Expr<'g> {
    if value.as_constant().is_some() {
        return b.constant(Dd::ONE) / value;
    }
    value.sign() / value.abs().pivot(b.number(size), index)
}

/// Returns 1 / pivot for the last pivot. The product of all pivots, the determinant, is refused if it is a rounding
/// error of its size, or has changed its sign: then the loop is at a singular position, or beyond one.
fn inverted_last<'g>(
    b: &'g Builder,
    (value, before): (Expr<'g>, Option<Expr<'g>>),
    samples: &[Vec<Dd>],
    index: usize,
) -> Expr<'g> {
    let one = b.constant(Dd::ONE);
    if value.as_constant().is_some() && before.is_none() {
        return one / value;
    }
    let before = before.unwrap_or(one);
    let determinant = before * value;
    let sampled = samples.iter().map(|q| at(b, &[determinant.signed()], q)[0]);
    let sampled: Vec<f64> = sampled.collect();
    let size = b.number(sampled.iter().fold(0.0, |most: f64, x| most.max(x.abs())));
    if sampled.iter().all(|x| *x > 0.0) {
        before / determinant.pivot(size, index)
    } else if sampled.iter().all(|x| *x < 0.0) {
        -(before / (-determinant).pivot(size, index))
    } else {
        before * determinant / (determinant * determinant).pivot(size * size, index)
    }
}

/// Returns the next pivot: among those that are large at all sampled positions a constant one, else the one with
/// the fewest entries in its row and column.
fn pivot(
    b: &Builder,
    matrix: &[Vec<Expr<'_>>],
    pivots: &[(usize, usize)],
    samples: &[Vec<Dd>],
) -> PivotPlace {
    let n = matrix.len();
    let rows: Vec<usize> = (0..n)
        .filter(|i| pivots.iter().all(|(row, _)| row != i))
        .collect();
    let columns: Vec<usize> = (0..n)
        .filter(|j| pivots.iter().all(|(_, column)| column != j))
        .collect();
    let places: Vec<(usize, usize)> = (rows.iter())
        .flat_map(|&i| columns.iter().map(move |&j| (i, j)))
        .collect();
    let outputs: Vec<Signed> = places.iter().map(|&(i, j)| matrix[i][j].signed()).collect();
    let sampled: Vec<Vec<f64>> = samples.iter().map(|q| at(b, &outputs, q)).collect();
    let of = |k: usize| sampled.iter().map(move |values| values[k]);
    let least = |k: usize| of(k).map(f64::abs).fold(f64::INFINITY, f64::min);
    let best = (0..places.len()).map(least).fold(0.0, f64::max);
    let entries = |&(i, j): &(usize, usize)| {
        let in_row = columns.iter().filter(|&&k| !matrix[i][k].is_zero()).count();
        let in_column = rows.iter().filter(|&&k| !matrix[k][j].is_zero()).count();
        in_row * in_column
    };
    let large = (0..places.len()).filter(|&k| least(k) >= AS_LARGE * best && least(k) > 0.0);
    let chosen = large.min_by_key(|&k| {
        let (i, j) = places[k];
        (matrix[i][j].as_constant().is_none(), entries(&places[k]))
    });
    let k = chosen.unwrap_or(0);
    PivotPlace {
        row: places[k].0,
        column: places[k].1,
        size: of(k).map(f64::abs).fold(0.0, f64::max),
    }
}

/// Returns the largest size of an expression at positions of the tree.
pub(super) fn largest_at(b: &Builder, value: Expr<'_>, samples: &[Vec<Dd>]) -> f64 {
    let sizes = samples.iter().map(|q| at(b, &[value.signed()], q)[0].abs());
    sizes.fold(0.0, f64::max)
}

/// Returns the values of expressions at a position of the tree.
pub(super) fn at(b: &Builder, outputs: &[Signed], q: &[Dd]) -> Vec<f64> {
    let inputs = Inputs {
        q: q.to_vec(),
        ..Inputs::default()
    };
    let values = b.with_graph(|g| evaluate(g, outputs, &inputs, &mut None));
    values.into_iter().map(Dd::to_f64).collect()
}

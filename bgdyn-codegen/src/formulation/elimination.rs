//! Eliminates a square matrix of expressions.
//!
//! Pivots are chosen from their values at sampled positions: large at all of them, constant if possible.

use bgdyn_runtime::Dd;

use crate::expr::{Builder, Expr, Inputs, Signed, evaluate};

/// A pivot may be smaller than the best one by this factor if it is constant or saves operations.
const AS_LARGE: f64 = 0.1;

/// Sums at sampled positions differ by less, relative to them, if they are constant.
const SAME: f64 = 1e-24;

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
    /// The rotation of two rows before each pivot.
    rotations: Vec<Option<RowRotation<'g>>>,
    /// The inverse of the rows and columns of the last two pivots, if they are solved together: row by row, which are
    /// the columns of the matrix.
    pair: Option<[[Expr<'g>; 2]; 2]>,
}

/// Two rows are replaced: row i by a · i + b · j, row j by a · j − b · i. With the entries a and b of one column, whose
/// squares have a constant sum, these are a² + b² and 0.
#[derive(Clone, Copy)]
struct RowRotation<'g> {
    rows: [usize; 2],
    factors: [Expr<'g>; 2],
}

impl<'g> RowRotation<'g> {
    /// Replaces the components of a side, by row.
    fn apply(&self, side: &mut [Expr<'g>]) {
        let ([i, j], [a, b]) = (self.rows, self.factors);
        (side[i], side[j]) = (a * side[i] + b * side[j], a * side[j] - b * side[i]);
    }

    /// Does the same with the transposed rotation.
    fn apply_transposed(&self, x: &mut [Expr<'g>]) {
        let ([i, j], [a, b]) = (self.rows, self.factors);
        (x[i], x[j]) = (a * x[i] - b * x[j], a * x[j] + b * x[i]);
    }
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
        matrix: Vec<Vec<Expr<'g>>>,
        samples: &[Vec<Dd>],
        checks: Option<&[usize]>,
    ) -> Self {
        EliminatedMatrix::with_rotations(b, (matrix, false), samples, checks)
    }

    /// Does the same; if asked to, with rotations of two rows where they give constant pivots, and with the last two
    /// pivots together if they vary: no order of them is regular where their determinant is.
    pub(super) fn with_rotations(
        b: &'g Builder,
        (mut matrix, rotates): (Vec<Vec<Expr<'g>>>, bool),
        samples: &[Vec<Dd>],
        checks: Option<&[usize]>,
    ) -> Self {
        let n = matrix.len();
        let mut rotations = vec![None; n];
        let mut pivots: Vec<(usize, usize)> = Vec::new();
        let mut inverse = vec![b.zero(); n];
        // The product of the pivots so far that are not constant.
        let (mut product, mut varying): (Option<Expr<'g>>, usize) = (None, 0);
        let mut pair = None;
        for k in 1..=n {
            let place = pivot(b, &matrix, &pivots, samples);
            let (mut row, mut column) = (place.row, place.column);
            let varies = rotates && matrix[row][column].as_constant().is_none();
            if let Some((rotation, rotated, sum)) =
                (varies.then(|| rotation(b, &matrix, &pivots, samples))).flatten()
            {
                (row, column) = (rotation.rows[0], rotated);
                let free = (0..n).filter(|j| pivots.iter().all(|(_, known)| known != j));
                for j in free {
                    let mut entries: Vec<Expr<'g>> = matrix.iter().map(|row| row[j]).collect();
                    rotation.apply(&mut entries);
                    matrix
                        .iter_mut()
                        .zip(entries)
                        .for_each(|(row, x)| row[j] = x);
                }
                matrix[row][column] = b.constant(sum);
                matrix[rotation.rows[1]][column] = b.zero();
                rotations[k - 1] = Some(rotation);
            }
            if rotates && k + 1 == n && matrix[row][column].as_constant().is_none() {
                let [rows, columns] = free_of(&pivots, n);
                let entry = |i: usize, j: usize| matrix[rows[i]][columns[j]];
                let determinant = entry(0, 0) * entry(1, 1) - entry(0, 1) * entry(1, 0);
                let one = match checks.map(|checks| checks[rows[1]]) {
                    None => b.constant(Dd::ONE) / determinant,
                    Some(index) => inverted_last(b, (determinant, product), samples, index),
                };
                let opposite = [[entry(1, 1), -entry(0, 1)], [-entry(1, 0), entry(0, 0)]];
                pair = Some(opposite.map(|row| row.map(|x| x * one)));
                pivots.extend(rows.into_iter().zip(columns));
                varying += usize::from(determinant.as_constant().is_none());
                break;
            }
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
            rotations,
            pair,
        }
    }

    /// Returns the number of pivots that are solved one after the other.
    fn single(&self) -> usize {
        self.pivots.len() - if self.pair.is_some() { 2 } else { 0 }
    }

    /// Returns the number of pivots, not constant, that others follow: they may vanish where the matrix is regular.
    pub(super) fn early(&self) -> usize {
        self.varying.saturating_sub(1)
    }

    /// Returns the solution of the transposed equations for one side, which is by column; the result is by row.
    pub(super) fn solve_transposed(&self, mut side: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
        let mut x = vec![self.b.zero(); side.len()];
        let single = &self.pivots[..self.single()];
        for (k, &(row, column)) in single.iter().enumerate() {
            x[row] = side[column] * self.inverse[column];
            for &(_, j) in &self.pivots[k + 1..] {
                side[j] = side[j] - self.matrix[row][j] * x[row];
            }
        }
        if let (Some(inverse), [(i, p), (j, q)]) = (self.pair, &self.pivots[single.len()..]) {
            let [[a, b], [c, d]] = inverse;
            (x[*i], x[*j]) = (a * side[*p] + c * side[*q], b * side[*p] + d * side[*q]);
        }
        for (k, &(row, column)) in single.iter().enumerate().rev() {
            for &(i, _) in &self.pivots[k + 1..] {
                x[row] = x[row] - self.matrix[i][column] * x[i];
            }
            if let Some(rotation) = &self.rotations[k] {
                rotation.apply_transposed(&mut x);
            }
        }
        x
    }

    /// Returns the solution for one side.
    pub(super) fn solve(&self, mut side: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
        let mut x = vec![self.b.zero(); side.len()];
        let single = &self.pivots[..self.single()];
        for (k, &(row, column)) in single.iter().enumerate() {
            if let Some(rotation) = &self.rotations[k] {
                rotation.apply(&mut side);
            }
            for &(i, _) in &self.pivots[k + 1..] {
                side[i] = side[i] - self.matrix[i][column] * side[row];
            }
        }
        if let (Some(inverse), [(i, p), (j, q)]) = (self.pair, &self.pivots[single.len()..]) {
            let [[a, b], [c, d]] = inverse;
            (x[*p], x[*q]) = (a * side[*i] + b * side[*j], c * side[*i] + d * side[*j]);
        }
        for (k, &(row, column)) in single.iter().enumerate().rev() {
            let later = self.pivots[k + 1..].iter();
            let rest = later.fold(side[row], |rest, &(_, j)| rest - self.matrix[row][j] * x[j]);
            x[column] = rest * self.inverse[column];
        }
        x
    }
}

/// Returns the two rows and the two columns without pivots.
fn free_of(pivots: &[(usize, usize)], n: usize) -> [[usize; 2]; 2] {
    let mut free = [[0; 2]; 2];
    let rows = (0..n).filter(|i| pivots.iter().all(|(row, _)| row != i));
    let columns = (0..n).filter(|j| pivots.iter().all(|(_, column)| column != j));
    rows.zip(columns)
        .enumerate()
        .take(2)
        .for_each(|(k, (i, j))| {
            free[0][k] = i;
            free[1][k] = j;
        });
    free
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

/// Returns a rotation of two rows whose entries in one column, in which others are zero, have squares with a constant
/// sum; with that column and the sum.
fn rotation<'g>(
    b: &Builder,
    matrix: &[Vec<Expr<'g>>],
    pivots: &[(usize, usize)],
    samples: &[Vec<Dd>],
) -> Option<(RowRotation<'g>, usize, Dd)> {
    let n = matrix.len();
    let mut columns = (0..n).filter(|j| pivots.iter().all(|(_, column)| column != j));
    columns.find_map(|column| {
        let rows = (0..n).filter(|i| pivots.iter().all(|(row, _)| row != i));
        let rows: Vec<usize> = rows.filter(|&i| !matrix[i][column].is_zero()).collect();
        let [i, j] = rows[..] else { return None };
        let factors = [matrix[i][column], matrix[j][column]];
        let outputs = factors.map(Expr::signed);
        let mut sums = samples.iter().map(|q| {
            let values = exact_at(b, &outputs, q);
            values[0] * values[0] + values[1] * values[1]
        });
        let first = sums.next()?;
        let size = first.to_f64();
        let same = sums.all(|sum| (sum - first).to_f64().abs() <= SAME * size);
        let rows = [i, j];
        (same && size > 0.0).then_some((RowRotation { rows, factors }, column, first))
    })
}

/// Returns the largest size of an expression at positions of the tree.
pub(super) fn largest_at(b: &Builder, value: Expr<'_>, samples: &[Vec<Dd>]) -> f64 {
    let sizes = samples.iter().map(|q| at(b, &[value.signed()], q)[0].abs());
    sizes.fold(0.0, f64::max)
}

/// Returns the values of expressions at a position of the tree.
pub(super) fn at(b: &Builder, outputs: &[Signed], q: &[Dd]) -> Vec<f64> {
    let values = exact_at(b, outputs, q);
    values.into_iter().map(Dd::to_f64).collect()
}

fn exact_at(b: &Builder, outputs: &[Signed], q: &[Dd]) -> Vec<Dd> {
    let inputs = Inputs {
        q: q.to_vec(),
        ..Inputs::default()
    };
    b.with_graph(|g| evaluate(g, outputs, &inputs, &mut None))
}

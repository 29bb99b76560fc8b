//! The dependent velocities of a mechanism with loops: q̇ = S u, q̈ = S u̇ + z, as expressions.
//!
//! Each block of rows is solved by elimination: J_d S_d = −J_i, J_d z_d = γ. Pivots are chosen from the values at
//! sampled positions: large at all of them, constant if possible.

use bgdyn_runtime::Dd;

use crate::expr::{Builder, Expr, Inputs, Signed, evaluate};
use crate::mechanism::CoordinateId;
use crate::mechanism::closure::{Closure, LoopRow, RelativePlace};

/// A pivot may be smaller than the best one by this factor if it is constant or saves operations.
const AS_LARGE: f64 = 0.1;

/// The rows of the loops: rates per unit velocity of the open tree, and −γ.
pub(super) struct LoopRows<'g> {
    /// For each row of the closure, the rate for a unit of each velocity of the tree.
    pub(super) rates: Vec<Vec<Expr<'g>>>,
}

/// Checks of pivots: the first index of the loops' pivots, after those of the joints.
pub(super) type FirstPivot = Option<usize>;

/// S with the eliminations of its blocks.
pub(super) struct VelocityMap<'a, 'g> {
    b: &'g Builder,
    closure: &'a Closure,
    rows: LoopRows<'g>,
    blocks: Vec<Elimination<'g>>,
    /// S, row by row for the velocities of the tree.
    pub(super) map: Vec<Vec<Expr<'g>>>,
}

/// Returns the rows of the loops in the axes of their places a.
pub(super) fn loop_rows<'g>(b: &'g Builder, closure: &Closure, q: &[Expr<'g>]) -> LoopRows<'g> {
    let places: Vec<RelativePlace<Expr<'g>>> = closure
        .loops
        .iter()
        .map(|one| {
            let frames = one.chain.frames(q, &b);
            one.chain.place(&frames, one.kind.coincident, &b)
        })
        .collect();
    let rates = closure.rows.iter().map(|row| {
        let (place, length) = (&places[row.closes], closure.loops[row.closes].length);
        let mut rates = vec![b.zero(); closure.positions.len()];
        for (j, column) in &place.columns {
            rates[j.0] = row.kind.rate(place, column, length);
        }
        rates
    });
    LoopRows {
        rates: rates.collect(),
    }
}

/// Returns c(q), row by row.
pub(super) fn loop_residuals<'g>(
    b: &'g Builder,
    closure: &Closure,
    q: &[Expr<'g>],
) -> Vec<Expr<'g>> {
    let row = |row: &LoopRow| {
        let one = &closure.loops[row.closes];
        let frames = one.chain.frames(q, &b);
        let place = one.chain.place(&frames, one.kind.coincident, &b);
        row.kind.residual(&place, one.length, |x| b.constant(x))
    };
    closure.rows.iter().map(row).collect()
}

/// Returns −γ = Ḃ q̇ for velocities of the tree, row by row.
pub(super) fn loop_bias<'g>(
    b: &'g Builder,
    closure: &Closure,
    (q, v): (&[Expr<'g>], &[Expr<'g>]),
) -> Vec<Expr<'g>> {
    let row = |row: &LoopRow| {
        let one = &closure.loops[row.closes];
        let frames = one.chain.frames(q, &b);
        let place = one.chain.place(&frames, one.kind.coincident, &b);
        let rates = one.chain.rates(&frames, v, &b);
        row.kind.bias(&place, &rates, one.length)
    };
    closure.rows.iter().map(row).collect()
}

impl<'a, 'g> VelocityMap<'a, 'g> {
    /// Solves the rows for the dependent velocities; with `first` pivots are checked.
    pub(super) fn new(
        b: &'g Builder,
        closure: &'a Closure,
        rows: LoopRows<'g>,
        first: FirstPivot,
    ) -> Self {
        let nv = closure.independents.len();
        let mut map = vec![vec![b.zero(); nv]; closure.positions.len()];
        for (k, i) in closure.independents.iter().enumerate() {
            map[i.0][k] = b.constant(Dd::ONE);
        }
        let mut blocks = Vec::new();
        b.section(|| "dependent velocities of the loops".into());
        for block in &closure.blocks {
            let own = |j: usize| block.dependents.iter().any(|d| d.0 == j);
            let entries = |&r: &usize| {
                block
                    .dependents
                    .iter()
                    .map(|d| rows.rates[r][d.0])
                    .collect()
            };
            let matrix: Vec<Vec<Expr<'g>>> = block.rows.iter().map(entries).collect();
            let of_loop = block.rows.first().map_or(0, |&r| closure.rows[r].closes);
            let check = first.map(|first| first + of_loop);
            let elimination = Elimination::new(b, matrix, &closure.samples, check);
            let mut found = Vec::new();
            for k in 0..nv {
                let side = |&r: &usize| {
                    let others = (0..map.len()).filter(|&j| !own(j));
                    -others.fold(b.zero(), |sum, j| sum + rows.rates[r][j] * map[j][k])
                };
                found.push(elimination.solve(block.rows.iter().map(side).collect()));
            }
            for (d, j) in block.dependents.iter().enumerate() {
                for (k, column) in found.iter().enumerate() {
                    map[j.0][k] = column[d];
                }
            }
            blocks.push(elimination);
        }
        VelocityMap {
            b,
            closure,
            rows,
            blocks,
            map,
        }
    }

    /// Returns B, row by row.
    pub(super) fn rates(&self) -> &[Vec<Expr<'g>>] {
        &self.rows.rates
    }

    /// Returns S u.
    pub(super) fn velocities(&self, u: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let row = |row: &Vec<Expr<'g>>| {
            let terms = row.iter().zip(u);
            terms.fold(self.b.zero(), |sum, (s, u)| sum + *s * *u)
        };
        self.map.iter().map(row).collect()
    }

    /// Returns Sᵀ f for efforts on the joints of the tree.
    pub(super) fn efforts(&self, f: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let column = |k: usize| {
            let terms = self.map.iter().zip(f);
            terms.fold(self.b.zero(), |sum, (row, f)| sum + row[k] * *f)
        };
        (0..self.closure.independents.len()).map(column).collect()
    }

    /// Returns the solution of Bᵀ λ = f in the dependent rows: the efforts of the rows for efforts that the joints of
    /// the tree lack.
    pub(super) fn multipliers(&self, f: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let mut found = vec![self.b.zero(); self.rows.rates.len()];
        let blocks = self.closure.blocks.iter().zip(&self.blocks).rev();
        for (block, elimination) in blocks {
            let side = |j: &CoordinateId| {
                let later = (0..found.len()).filter(|r| !block.rows.contains(r));
                later.fold(f[j.0], |sum, r| sum - self.rows.rates[r][j.0] * found[r])
            };
            let own = elimination.solve_transposed(block.dependents.iter().map(side).collect());
            for (&r, x) in block.rows.iter().zip(own) {
                found[r] = x;
            }
        }
        found
    }

    /// Returns J_d⁻¹ c, by velocity of the tree.
    pub(super) fn steps(&self, residuals: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let opposite: Vec<Expr<'g>> = residuals.iter().map(|&c| -c).collect();
        self.accelerations(&opposite)
    }

    /// Returns z, from −γ.
    pub(super) fn accelerations(&self, bias: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let mut z = vec![self.b.zero(); self.map.len()];
        for (block, elimination) in self.closure.blocks.iter().zip(&self.blocks) {
            let own = |j: usize| block.dependents.iter().any(|d| d.0 == j);
            let side = |&r: &usize| {
                let others = (0..z.len()).filter(|&j| !own(j));
                -others.fold(bias[r], |sum, j| sum + self.rows.rates[r][j] * z[j])
            };
            let found = elimination.solve(block.rows.iter().map(side).collect());
            for (j, x) in block.dependents.iter().zip(found) {
                z[j.0] = x;
            }
        }
        z
    }
}

/// A square matrix, eliminated.
struct Elimination<'g> {
    b: &'g Builder,
    /// The pivots in their order: row, column.
    pivots: Vec<(usize, usize)>,
    /// The matrix after elimination: factors of rows below a pivot, in its column.
    matrix: Vec<Vec<Expr<'g>>>,
    /// 1 / pivot, by column.
    inverse: Vec<Expr<'g>>,
}

/// A place for a pivot.
struct PivotPlace {
    row: usize,
    column: usize,
    /// Its size at the sampled positions.
    size: f64,
    /// Whether it is negative at all of them; `None` if it changes its sign.
    negative: Option<bool>,
}

impl<'g> Elimination<'g> {
    fn new(
        b: &'g Builder,
        mut matrix: Vec<Vec<Expr<'g>>>,
        samples: &[Vec<Dd>],
        check: Option<usize>,
    ) -> Self {
        let n = matrix.len();
        let mut pivots: Vec<(usize, usize)> = Vec::new();
        let mut inverse = vec![b.zero(); n];
        for _ in 0..n {
            let place = pivot(b, &matrix, &pivots, samples);
            let (row, column) = (place.row, place.column);
            pivots.push((row, column));
            inverse[column] = inverted(b, matrix[row][column], &place, check);
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
        Elimination {
            b,
            pivots,
            matrix,
            inverse,
        }
    }

    /// Returns the solution of the transposed equations for one side, which is by column; the result is by row.
    fn solve_transposed(&self, mut side: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
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
    fn solve(&self, mut side: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
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

/// Returns 1 / pivot. A checked pivot is refused if it is a rounding error of its size, or has changed its sign: then
/// the loop is at a singular position, or beyond one.
fn inverted<'g>(
    b: &'g Builder,
    value: Expr<'g>,
    place: &PivotPlace,
    check: Option<usize>,
) -> Expr<'g> {
    let one = b.constant(Dd::ONE);
    let Some(index) = check.filter(|_| value.as_constant().is_none()) else {
        return one / value;
    };
    let size = b.number(place.size);
    match place.negative {
        Some(false) => one / value.pivot(size, index),
        Some(true) => -(one / (-value).pivot(size, index)),
        None => value / (value * value).pivot(size * size, index),
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
        negative: match (of(k).all(|x| x < 0.0), of(k).all(|x| x > 0.0)) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        },
    }
}

/// Returns the values of expressions at a position of the tree.
fn at(b: &Builder, outputs: &[Signed], q: &[Dd]) -> Vec<f64> {
    let inputs = Inputs {
        q: q.to_vec(),
        ..Inputs::default()
    };
    let values = b.with_graph(|g| evaluate(g, outputs, &inputs, &mut None));
    values.into_iter().map(Dd::to_f64).collect()
}

//! Solves M x = f for a symmetric positive definite M, unrolled.

use bgdyn_runtime::Dd;

use crate::expr::{Builder, Expr};

/// The factors of M = Lᵀ D L, from the last coordinate to the first, which preserves the zeros of a
/// branching mechanism (Featherstone 2005). Every pivot is checked.
pub(super) struct PivotFactor<'g> {
    b: &'g Builder,
    /// L below its unit diagonal.
    l: Vec<Vec<Expr<'g>>>,
    /// D⁻¹
    inverse: Vec<Expr<'g>>,
}

impl<'g> PivotFactor<'g> {
    /// Factors the lower triangle of M, whose rows belong to these coordinates.
    pub(super) fn of(b: &'g Builder, mut mass: Vec<Vec<Expr<'g>>>, coordinates: &[usize]) -> Self {
        let n = mass.len();
        let original: Vec<Expr<'g>> = (0..n).map(|k| mass[k][k]).collect();
        let mut inverse = vec![b.zero(); n];
        b.section(|| "M = Lᵀ D L, from the last joint to the first".into());
        for k in (0..n).rev() {
            // Only subtractions at run time can lose digits; folded numbers were subtracted in
            // double-double, which distinguishes a small difference from zero.
            let folded = mass[k][k].as_constant().is_some();
            let magnitude = if folded || mass[k][k] == original[k] {
                b.zero()
            } else {
                original[k]
            };
            let pivot = mass[k][k].pivot(magnitude, coordinates[k]);
            inverse[k] = b.constant(Dd::ONE) / pivot;
            // M_ij ← M_ij − l_ki M_kj for i, j < k with l_ki = M_ki / d_k
            let row = mass[k].clone();
            for i in (0..k).filter(|&i| !row[i].is_zero()) {
                // Two joints on one axis have equal entries: M_ki / M_kk = ±1 folds exactly.
                let l = if row[i] == row[k] {
                    b.number(1.0)
                } else if row[i] == -row[k] {
                    b.number(-1.0)
                } else {
                    row[i] * inverse[k]
                };
                for j in (0..=i).filter(|&j| !row[j].is_zero()) {
                    mass[i][j] = mass[i][j] - l * row[j];
                }
                mass[k][i] = l;
            }
        }
        PivotFactor {
            b,
            l: mass,
            inverse,
        }
    }

    /// Solves M x = f: Lᵀ y = f, then L x = D⁻¹ y.
    fn solve(&self, f: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
        self.b.section(|| "Lᵀ y = f, L x = D⁻¹ y".into());
        self.outwards(self.inwards(f))
    }

    /// Solves Lᵀ y = f, the half of M x = f from the last coordinate to the first.
    pub(super) fn inwards(&self, mut x: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
        for k in (0..x.len()).rev() {
            for i in 0..k {
                x[i] = x[i] - self.l[k][i] * x[k];
            }
        }
        x
    }

    /// Returns D⁻¹ y.
    pub(super) fn scaled(&self, y: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let pairs = y.iter().zip(&self.inverse);
        pairs.map(|(&y, &inverse)| y * inverse).collect()
    }

    /// Solves L x = D⁻¹ y, the other half.
    pub(super) fn outwards(&self, mut x: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
        for k in 0..x.len() {
            x[k] = x[k] * self.inverse[k];
            for i in 0..k {
                x[k] = x[k] - self.l[k][i] * x[i];
            }
        }
        x
    }
}

/// Returns the lower triangle of M⁻¹, row by row, from that of M; the pivots of the rows have these indices.
pub(super) fn inverse<'g>(
    b: &'g Builder,
    mass: Vec<Vec<Expr<'g>>>,
    coordinates: &[usize],
) -> Vec<Expr<'g>> {
    let n = mass.len();
    let factor = PivotFactor::of(b, mass, coordinates);
    let unit = |i: usize, j: usize| if i == j { b.number(1.0) } else { b.zero() };
    let column = |j: usize| factor.solve((0..n).map(|i| unit(i, j)).collect());
    // Of two equal entries, the one in the earlier row needs fewer operations.
    (0..n)
        .flat_map(|j| column(j).into_iter().take(j + 1))
        .collect()
}

/// Solves M x = f for one right-hand side, where the velocities `first` are eliminated before all others.
pub(crate) fn ltdl_after<'g>(
    b: &'g Builder,
    mass: Vec<Vec<Expr<'g>>>,
    f: Vec<Expr<'g>>,
    first: &[usize],
) -> Vec<Expr<'g>> {
    if first.is_empty() {
        return ltdl(b, mass, f);
    }
    // The last row is eliminated first.
    let rest = (0..f.len()).filter(|k| !first.contains(k));
    let order: Vec<usize> = rest.chain(first.iter().copied()).collect();
    let entry = |i: usize, j: usize| mass[order[i].max(order[j])][order[i].min(order[j])];
    let permuted = (0..f.len()).map(|i| (0..=i).map(|j| entry(i, j)).collect());
    let sides = order.iter().map(|&k| f[k]).collect();
    let solved = PivotFactor::of(b, permuted.collect(), &order).solve(sides);
    let mut found = vec![b.zero(); f.len()];
    for (&k, x) in order.iter().zip(solved) {
        found[k] = x;
    }
    found
}

/// Solves M x = f for one right-hand side; the pivots of the rows have these indices.
pub(crate) fn ltdl_of<'g>(
    b: &'g Builder,
    mass: Vec<Vec<Expr<'g>>>,
    f: Vec<Expr<'g>>,
    coordinates: &[usize],
) -> Vec<Expr<'g>> {
    PivotFactor::of(b, mass, coordinates).solve(f)
}

/// Solves M x = f for one right-hand side.
pub(crate) fn ltdl<'g>(
    b: &'g Builder,
    mass: Vec<Vec<Expr<'g>>>,
    f: Vec<Expr<'g>>,
) -> Vec<Expr<'g>> {
    let coordinates: Vec<usize> = (0..f.len()).collect();
    PivotFactor::of(b, mass, &coordinates).solve(f)
}

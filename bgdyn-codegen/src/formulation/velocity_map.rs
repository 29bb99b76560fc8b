//! The dependent velocities of a mechanism with loops: q̇ = S u, q̈ = S u̇ + z, as expressions.
//!
//! Each block of rows is solved by elimination: J_d S_d = −J_i, J_d z_d = γ.

use bgdyn_runtime::Dd;

use super::elimination::EliminatedMatrix;
use super::loop_rows::{LoopForm, LoopRows, loop_rows};
use crate::expr::{Builder, Expr, Leaf};
use crate::mechanism::CoordinateId;
use crate::mechanism::closure::{Closure, ClosureBlock};

/// Checks of pivots: the first index of the loops' pivots, after those of the joints.
pub(super) type FirstPivot = Option<usize>;

/// A way to write the rows of loops and contacts for S.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RowChoice {
    /// In the axes of places b.
    reversed: bool,
    /// Rows of leaning wheels along their planes.
    along_planes: bool,
}

impl RowChoice {
    /// Returns all ways for these loops and contacts.
    pub fn all(closure: &Closure) -> Vec<Self> {
        let reversible = closure.loops.iter().any(|one| one.reversible);
        let leans = closure.along_planes.is_some();
        let all = [(false, false), (true, false), (false, true), (true, true)];
        let all = all.into_iter();
        let can = all.filter(|(reversed, along)| (reversible || !reversed) && (leans || !along));
        can.map(|(reversed, along_planes)| RowChoice {
            reversed,
            along_planes,
        })
        .collect()
    }

    /// Returns S with the eliminations for positions of the open tree; with `first` pivots are checked.
    fn map<'a, 'g>(
        self,
        b: &'g Builder,
        closure: &'a Closure,
        q: &[Expr<'g>],
        first: FirstPivot,
    ) -> VelocityMap<'a, 'g> {
        let form = LoopForm {
            reversed: self.reversed,
            by_vectors: false,
            of_plane: false,
            along_planes: self.along_planes,
            rotates: false,
            first_pivot: first,
        };
        let other = closure.along_planes.as_deref();
        let closure = other.filter(|_| self.along_planes).unwrap_or(closure);
        let rows = loop_rows(b, closure, q, form);
        VelocityMap::new(b, closure, (rows, form), first)
    }

    /// Returns the number of pivots that others follow: they may vanish at regular positions.
    pub(crate) fn early_pivots(self, closure: &Closure) -> usize {
        let b = Builder::silent();
        let q: Vec<Expr<'_>> = (0..closure.start.len())
            .map(|p| b.leaf(Leaf::Position(p)))
            .collect();
        self.map(&b, closure, &q, None).early_pivots()
    }
}

/// Returns S for positions of the open tree, row by row for its velocities; with `first` pivots are checked.
pub(crate) fn velocity_map<'g>(
    b: &'g Builder,
    closure: &Closure,
    (q, choice): (&[Expr<'g>], RowChoice),
    first: FirstPivot,
) -> Vec<Vec<Expr<'g>>> {
    choice.map(b, closure, q, first).map
}

/// S with the eliminations of its blocks.
pub(super) struct VelocityMap<'a, 'g> {
    b: &'g Builder,
    closure: &'a Closure,
    rows: LoopRows<'g>,
    blocks: Vec<ClosureBlock>,
    eliminations: Vec<EliminatedMatrix<'g>>,
    /// S, row by row for the velocities of the tree; empty if only vectors are solved for.
    pub(super) map: Vec<Vec<Expr<'g>>>,
}

impl<'a, 'g> VelocityMap<'a, 'g> {
    /// Eliminates the dependent velocities from the rows; with `first` pivots are checked.
    pub(super) fn new(
        b: &'g Builder,
        closure: &'a Closure,
        (rows, form): (LoopRows<'g>, LoopForm),
        first: FirstPivot,
    ) -> Self {
        b.section(|| "dependent velocities of the loops".into());
        // The blocks are those of the rows in the axes of places a, and of contacts in the axes of the body.
        let turned = form.of_plane && closure.nonholonomic();
        let blocks = match form.reversed || turned {
            false => closure.blocks.clone(),
            true => vec![ClosureBlock {
                rows: closure
                    .blocks
                    .iter()
                    .flat_map(|block| block.rows.clone())
                    .collect(),
                dependents: closure.dependents().collect(),
            }],
        };
        let elimination = |block: &ClosureBlock| {
            let row = |&r: &usize| {
                let columns = block.dependents.iter();
                columns.map(|d| rows.rates[r][d.0]).collect()
            };
            let matrix = block.rows.iter().map(row).collect();
            let pivot = |&r: &usize| first.map(|first| first + closure.rows[r].closes);
            let checks: Option<Vec<usize>> = block.rows.iter().map(pivot).collect();
            let matrix = (matrix, form.rotates);
            EliminatedMatrix::with_rotations(b, matrix, &closure.samples, checks.as_deref())
        };
        let eliminations = blocks.iter().map(elimination).collect();
        let mut map = VelocityMap {
            b,
            closure,
            rows,
            blocks,
            eliminations,
            map: Vec::new(),
        };
        if !form.by_vectors {
            let n = closure.independents.len();
            let unit = |k: usize| {
                let one = |i: usize| b.constant(if i == k { Dd::ONE } else { Dd::ZERO });
                map.solve(&(0..n).map(one).collect::<Vec<_>>(), None)
            };
            let columns: Vec<Vec<Expr<'g>>> = (0..n).map(unit).collect();
            let row = |j: usize| columns.iter().map(|column| column[j]).collect();
            map.map = (0..closure.positions.len()).map(row).collect();
        }
        map
    }

    /// Returns the number of pivots, not constant, that others follow in their block.
    pub(super) fn early_pivots(&self) -> usize {
        self.eliminations.iter().map(EliminatedMatrix::early).sum()
    }

    /// Returns the number of independent velocities.
    pub(super) fn independents(&self) -> usize {
        self.closure.independents.len()
    }

    /// Returns B, row by row.
    pub(super) fn rates(&self) -> &[Vec<Expr<'g>>] {
        &self.rows.rates
    }

    /// Returns the values of all velocities of the tree for these of the independent ones, such that B x + open = 0.
    fn solve(&self, independent: &[Expr<'g>], open: Option<&[Expr<'g>]>) -> Vec<Expr<'g>> {
        let mut all = vec![self.b.zero(); self.closure.positions.len()];
        for (i, &x) in self.closure.independents.iter().zip(independent) {
            all[i.0] = x;
        }
        for (block, elimination) in self.blocks.iter().zip(&self.eliminations) {
            let side = |&r: &usize| {
                let own = |j: &usize| block.dependents.iter().any(|d| d.0 == *j);
                let start = open.map_or(self.b.zero(), |open| open[r]);
                let others = (0..all.len()).filter(|j| !own(j));
                -others.fold(start, |sum, j| sum + self.rows.rates[r][j] * all[j])
            };
            let found = elimination.solve(block.rows.iter().map(side).collect());
            for (j, x) in block.dependents.iter().zip(found) {
                all[j.0] = x;
            }
        }
        all
    }

    /// Returns S u.
    pub(super) fn velocities(&self, u: &[Expr<'g>]) -> Vec<Expr<'g>> {
        if self.map.is_empty() {
            return self.solve(u, None);
        }
        let row = |row: &Vec<Expr<'g>>| {
            let terms = row.iter().zip(u);
            terms.fold(self.b.zero(), |sum, (s, u)| sum + *s * *u)
        };
        self.map.iter().map(row).collect()
    }

    /// Returns Sᵀ f for efforts on the joints of the tree: f_i − B_iᵀ λ with B_dᵀ λ = f_d, or by S.
    pub(super) fn efforts(&self, f: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let independents = self.closure.independents.iter();
        if self.map.is_empty() {
            let lambda = self.multipliers(f);
            let rows = || self.rows.rates.iter().zip(&lambda);
            let left = |i: &CoordinateId| rows().fold(f[i.0], |sum, (row, l)| sum - row[i.0] * *l);
            return independents.map(left).collect();
        }
        let column = |k: usize| {
            let terms = self.map.iter().zip(f);
            terms.fold(self.b.zero(), |sum, (row, f)| sum + row[k] * *f)
        };
        (0..independents.len()).map(column).collect()
    }

    /// Returns S u̇ + z, from −γ.
    pub(super) fn accelerations(&self, a: &[Expr<'g>], bias: &[Expr<'g>]) -> Vec<Expr<'g>> {
        if self.map.is_empty() {
            return self.solve(a, Some(bias));
        }
        let z = self.solve(&[], Some(bias));
        let moved = self.velocities(a).into_iter();
        moved.zip(z).map(|(x, z)| x + z).collect()
    }

    /// Returns the solution of Bᵀ λ = f in the dependent rows: the efforts of the rows for efforts that the joints of
    /// the tree lack.
    pub(super) fn multipliers(&self, f: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let mut found = vec![self.b.zero(); self.rows.rates.len()];
        let blocks = self.blocks.iter().zip(&self.eliminations).rev();
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

    /// Returns J_d⁻¹ c, by velocity of the tree; beside rows on velocities those of the rows with positions alone.
    pub(super) fn steps(&self, residuals: &[Expr<'g>]) -> Vec<Expr<'g>> {
        if self.closure.nonholonomic() {
            return self.steps_of_positions(residuals);
        }
        let opposite: Vec<Expr<'g>> = residuals.iter().map(|&c| -c).collect();
        self.solve(&[], Some(&opposite))
    }

    /// Returns the shortest solution of J x = c: Jᵀ (J Jᵀ)⁻¹ c if J has more columns than rows.
    fn shortest(&self, matrix: Vec<Vec<Expr<'g>>>, side: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
        let (b, samples) = (self.b, &self.closure.samples);
        let columns = matrix.first().map_or(0, Vec::len);
        if columns == matrix.len() {
            return EliminatedMatrix::new(b, matrix, samples, None).solve(side);
        }
        let dot = |x: &[Expr<'g>], y: &[Expr<'g>]| {
            let terms = x.iter().zip(y);
            terms.fold(b.zero(), |sum, (x, y)| sum + *x * *y)
        };
        let row = |x: &Vec<Expr<'g>>| matrix.iter().map(|y| dot(x, y)).collect();
        let normal = matrix.iter().map(row).collect();
        let found = EliminatedMatrix::new(b, normal, samples, None).solve(side);
        let column = |k: usize| matrix.iter().map(|row| row[k]).collect::<Vec<_>>();
        (0..columns).map(|k| dot(&column(k), &found)).collect()
    }

    fn steps_of_positions(&self, residuals: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let closure = self.closure;
        let closers: Vec<CoordinateId> = closure.closing().collect();
        let rows = (0..closure.rows.len()).filter(|&r| closure.rows[r].kind.has_positions());
        let rows: Vec<usize> = rows.collect();
        let row = |&r: &usize| closers.iter().map(|j| self.rows.rates[r][j.0]).collect();
        let matrix: Vec<Vec<Expr<'g>>> = rows.iter().map(row).collect();
        let side = rows.iter().map(|&r| residuals[r]).collect();
        let found = self.shortest(matrix, side);
        let mut all = vec![self.b.zero(); closure.positions.len()];
        for (j, x) in closers.iter().zip(found) {
            all[j.0] = x;
        }
        all
    }
}

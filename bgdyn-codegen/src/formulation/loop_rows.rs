//! The rows of loops as expressions: rates, values, second derivatives.

use bgdyn_runtime::Dd;

use crate::expr::{Builder, Expr};
use crate::mechanism::closure::{Closure, ContactNumbers, LoopRow, RowAxes, RowsAt};
use crate::mechanism::joint::PoseNumbers;

/// The way in which the rows of the loops are written and solved.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LoopForm {
    /// In the axes of places b, for loops whose rows hold there too.
    pub(super) reversed: bool,
    /// For the vectors S u and Sᵀ f alone, without the matrix S.
    pub(super) by_vectors: bool,
    /// Those of contacts along their planes and the normals: the directions of the multipliers.
    pub(super) of_plane: bool,
    /// Those of [`Closure::along_planes`].
    pub(super) along_planes: bool,
    /// With rotations of two rows where they give constant pivots.
    pub(super) rotates: bool,
    /// With checks of pivots: the index of the first loop's.
    pub(super) first_pivot: Option<usize>,
}

impl LoopForm {
    fn axes(self) -> RowAxes {
        RowAxes {
            reversed: self.reversed,
            of_plane: self.of_plane,
            closed: true,
        }
    }

    /// Returns whether the rows are those that are solved, not those of the file.
    fn combines(self, closure: &Closure) -> bool {
        !self.of_plane && !closure.combined.is_empty()
    }
}

/// Expressions as the numbers of a loop's rows; the cosine of a wheel's lean is a checked pivot of this index.
struct RowNumbers<'g> {
    b: &'g Builder,
    pivot: Option<usize>,
}

impl<'g> PoseNumbers<Expr<'g>> for RowNumbers<'g> {
    fn constant(&self, x: Dd) -> Expr<'g> {
        self.b.constant(x)
    }

    fn cos_sin(&self, angle: Expr<'g>) -> (Expr<'g>, Expr<'g>) {
        PoseNumbers::cos_sin(&self.b, angle)
    }

    fn cos_sin_from(&self, angle: Expr<'g>, phase: Dd) -> (Expr<'g>, Expr<'g>) {
        PoseNumbers::cos_sin_from(&self.b, angle, phase)
    }

    fn twice_inverse(&self, squares: Expr<'g>) -> Expr<'g> {
        self.b.twice_inverse(squares)
    }
}

impl<'g> ContactNumbers<Expr<'g>> for RowNumbers<'g> {
    fn inverse(&self, x: Expr<'g>) -> Expr<'g> {
        self.b.constant(Dd::ONE) / x
    }

    fn root(&self, x: Expr<'g>) -> Expr<'g> {
        x.sqrt()
    }

    fn leaning(&self, cosine: Expr<'g>) -> Expr<'g> {
        match self.pivot {
            Some(index) if cosine.as_constant().is_none() => {
                cosine.pivot(self.b.constant(Dd::ONE), index)
            }
            _ => cosine,
        }
    }
}

/// Returns the rows of a loop at a position.
fn rows_of<'a, 'g>(
    b: &'g Builder,
    (closure, closes): (&'a Closure, usize),
    q: &[Expr<'g>],
    form: LoopForm,
) -> (RowsAt<'a, Expr<'g>>, RowNumbers<'g>) {
    let pivot = form.first_pivot.map(|first| first + closes);
    let numbers = RowNumbers { b, pivot };
    let at = closure.rows_at(closes, form.axes(), (q, &numbers));
    (at, numbers)
}

/// Returns the rows of a loop in the directions of the multipliers.
pub(super) fn plane_rows<'a, 'g>(
    b: &'g Builder,
    (closure, closes): (&'a Closure, usize),
    q: &[Expr<'g>],
) -> RowsAt<'a, Expr<'g>> {
    let form = LoopForm {
        of_plane: true,
        ..LoopForm::default()
    };
    rows_of(b, (closure, closes), q, form).0
}

/// The rows of the loops: rates per unit velocity of the open tree, and −γ.
pub(super) struct LoopRows<'g> {
    /// For each row of the closure, the rate for a unit of each velocity of the tree.
    pub(super) rates: Vec<Vec<Expr<'g>>>,
}

/// Returns the rows of the loops.
pub(super) fn loop_rows<'g>(
    b: &'g Builder,
    closure: &Closure,
    q: &[Expr<'g>],
    form: LoopForm,
) -> LoopRows<'g> {
    let at = |closes: usize| rows_of(b, (closure, closes), q, form).0;
    let loops: Vec<RowsAt<'_, Expr<'g>>> = (0..closure.loops.len()).map(at).collect();
    let rates = closure.rows.iter().map(|row| {
        let mut rates = vec![b.zero(); closure.positions.len()];
        for (j, rate) in loops[row.closes].rates(row.kind) {
            rates[j.0] = rate;
        }
        rates
    });
    let rates = rates.collect();
    LoopRows {
        rates: match form.combines(closure) {
            true => combined(b, closure, &rates),
            false => rates,
        },
    }
}

/// Returns the rates of the rows that are solved.
fn combined<'g>(
    b: &'g Builder,
    closure: &Closure,
    rates: &Vec<Vec<Expr<'g>>>,
) -> Vec<Vec<Expr<'g>>> {
    let entry = |(r, j): (usize, usize)| match closure.constants[r][j] {
        Some(constant) => b.constant(constant),
        None => sum(b, &closure.combined[r], rates.iter().map(|row| row[j])),
    };
    let all = 0..closure.positions.len();
    let row = |r: usize| all.clone().map(|j| entry((r, j))).collect();
    (0..rates.len()).map(row).collect()
}

/// Returns the sum of expressions with constant factors.
fn sum<'g>(b: &'g Builder, factors: &[Dd], of: impl Iterator<Item = Expr<'g>>) -> Expr<'g> {
    let terms = of.zip(factors).filter(|(_, factor)| **factor != Dd::ZERO);
    terms.fold(b.zero(), |sum, (e, &factor)| sum + e * factor)
}

/// Returns c(q), row by row; zero for rows on velocities.
pub(super) fn loop_residuals<'g>(
    b: &'g Builder,
    closure: &Closure,
    q: &[Expr<'g>],
) -> Vec<Expr<'g>> {
    let row = |row: &LoopRow| {
        let (at, numbers) = rows_of(b, (closure, row.closes), q, LoopForm::default());
        at.residual(row.kind, &numbers)
    };
    closure.rows.iter().map(row).collect()
}

/// Returns −γ = Ḃ q̇ for velocities of the tree, row by row.
pub(super) fn loop_bias<'g>(
    b: &'g Builder,
    closure: &Closure,
    (q, v): (&[Expr<'g>], &[Expr<'g>]),
    form: LoopForm,
) -> Vec<Expr<'g>> {
    let row = |row: &LoopRow| {
        let (at, numbers) = rows_of(b, (closure, row.closes), q, form);
        at.bias(row.kind, v, &numbers)
    };
    let all: Vec<Expr<'g>> = closure.rows.iter().map(row).collect();
    if !form.combines(closure) {
        return all;
    }
    let factors = closure.combined.iter();
    factors
        .map(|factors| sum(b, factors, all.iter().copied()))
        .collect()
}

//! Solves rows for dependent joints: Gauss–Jordan in double-double.

use bgdyn_runtime::Dd;

use crate::mechanism::{Leader, LinkId};

/// Differences below this part of their terms are rounding: 2⁻⁹⁸.
const ROUNDING: f64 = 3.155_443_620_884_047e-30;

/// A joint that follows others: position or velocity = Σ ratio · leader + offset.
#[derive(Clone, Debug)]
pub(super) struct Dependent {
    pub(super) link: LinkId,
    pub(super) leaders: Vec<Leader>,
    pub(super) offset: Dd,
    /// The rows that determine it.
    pub(super) rows: Vec<usize>,
}

/// Terms of a row, and the value of their sum.
pub(super) type ExpandedRow = (Vec<Leader>, Dd);

/// A row that determines no joint.
#[derive(Clone, Debug)]
pub(super) struct Leftover {
    /// Its index.
    pub(super) row: usize,
    /// Other rows with factors: their sum has the coefficients of this row.
    pub(super) others: Vec<(usize, Dd)>,
    /// The difference of the offsets of this row and of that sum.
    pub(super) gap: Dd,
    /// The independent joints that it still contains.
    pub(super) kept: Vec<LinkId>,
}

/// A row: coefficients by link, their sum, and the given rows that it consists of.
#[derive(Clone)]
struct Working {
    coefficients: Vec<Dd>,
    offset: Dd,
    parts: Vec<Dd>,
}

/// Solves Σ coefficient · x = offset for one joint a row: the last ones that are not `kept`. `n` is the number
/// of links.
pub(super) fn solve(
    rows: &[ExpandedRow],
    n: usize,
    kept: &[LinkId],
) -> (Vec<Dependent>, Vec<Leftover>) {
    let mut working: Vec<Working> = (0..rows.len()).map(|r| start(rows, r, n)).collect();
    // The pivot's column of each row that has one.
    let mut pivots: Vec<Option<usize>> = vec![None; rows.len()];
    for column in (0..n).rev().filter(|&i| !kept.contains(&LinkId(i))) {
        let size = |r: usize| working[r].coefficients[column].to_f64().abs();
        let free = (0..rows.len()).filter(|&r| pivots[r].is_none() && size(r) > 0.0);
        let Some(r) = free.max_by(|&a, &b| size(a).total_cmp(&size(b)).then(b.cmp(&a))) else {
            continue;
        };
        pivots[r] = Some(column);
        working[r].divide(column);
        let row = working[r].clone();
        let others = working
            .iter_mut()
            .enumerate()
            .filter(|(other, _)| *other != r);
        others.for_each(|(_, other)| other.subtract(&row, column));
    }
    let (mut dependents, mut leftovers) = (Vec::new(), Vec::new());
    for (r, row) in working.into_iter().enumerate() {
        match pivots[r] {
            Some(column) => dependents.push(row.solved_for(column)),
            None => leftovers.push(row.left(r)),
        }
    }
    (dependents, leftovers)
}

fn start(rows: &[ExpandedRow], r: usize, n: usize) -> Working {
    let (terms, offset) = &rows[r];
    let mut coefficients = vec![Dd::ZERO; n];
    for term in terms {
        coefficients[term.link.0] = sum(coefficients[term.link.0], term.ratio);
    }
    let part = |other: usize| if other == r { Dd::ONE } else { Dd::ZERO };
    Working {
        coefficients,
        offset: *offset,
        parts: (0..rows.len()).map(part).collect(),
    }
}

/// Returns a + b; zero where only rounding is left.
pub(super) fn sum(a: Dd, b: Dd) -> Dd {
    let (total, size) = (a + b, a.to_f64().abs() + b.to_f64().abs());
    match total.to_f64().abs() <= ROUNDING * size {
        true => Dd::ZERO,
        false => total,
    }
}

impl Working {
    fn divide(&mut self, column: usize) {
        let pivot = self.coefficients[column];
        let all = self.coefficients.iter_mut().chain(&mut self.parts);
        all.for_each(|x| *x /= pivot);
        self.offset /= pivot;
    }

    /// Subtracts the multiple of a row that removes the column.
    fn subtract(&mut self, row: &Working, column: usize) {
        let factor = -self.coefficients[column];
        if factor == Dd::ZERO {
            return;
        }
        let own = self.coefficients.iter_mut().chain(&mut self.parts);
        let other = row.coefficients.iter().chain(&row.parts);
        own.zip(other).for_each(|(x, y)| *x = sum(*x, factor * *y));
        self.offset = sum(self.offset, factor * row.offset);
        self.coefficients[column] = Dd::ZERO;
    }

    fn nonzero(&self) -> impl Iterator<Item = (usize, Dd)> {
        let all = self.coefficients.iter().copied().enumerate();
        all.filter(|(_, k)| *k != Dd::ZERO)
    }

    fn solved_for(&self, column: usize) -> Dependent {
        let others = self.nonzero().filter(|(i, _)| *i != column);
        Dependent {
            link: LinkId(column),
            leaders: others
                .map(|(i, k)| Leader {
                    link: LinkId(i),
                    ratio: -k,
                })
                .collect(),
            offset: self.offset,
            rows: (0..self.parts.len())
                .filter(|&r| self.parts[r] != Dd::ZERO)
                .collect(),
        }
    }

    fn left(&self, row: usize) -> Leftover {
        let own = self.parts[row];
        let others = self.parts.iter().enumerate();
        let others = others.filter(|(r, k)| *r != row && **k != Dd::ZERO);
        Leftover {
            row,
            others: others.map(|(r, k)| (r, -*k / own)).collect(),
            gap: self.offset / own,
            kept: self.nonzero().map(|(i, _)| LinkId(i)).collect(),
        }
    }
}

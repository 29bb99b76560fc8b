//! Loops and contacts that close at single positions only.
//!
//! At the closed positions of a mechanism that moves the rows of positions are independent, but at a few of them. A wheel
//! that touches where its height is least touches nowhere else: there the rates of its row are zero, and Newton's method
//! comes as near to that position as the square root of a rounding error.

use bgdyn_runtime::Dd;

use crate::fault::{Faults, wording};
use crate::mechanism::closure::{Closure, LoopRow, eliminate};

/// Rows depend on each other if a pivot is less, relative to their rates where they are open.
const SINGULAR: f64 = 1e-10;

/// Reports the row that depends on others, or has no rates, at the start and at all closed positions. `None` if there
/// is one.
pub(super) fn refuse(closure: &Closure, faults: &mut Faults) -> Option<()> {
    let rows = closure.position_rows();
    let sizes = sizes(closure, &rows);
    let closed = closure.samples.iter().chain([&closure.start]);
    let dependent: Vec<usize> = closed
        .map(|q| dependent_row(closure, (&rows, &sizes), q))
        .collect::<Option<_>>()
        .unwrap_or_default();
    let Some(row) = dependent.last().map(|&r| &rows[r]) else {
        return Some(());
    };
    let one = &closure.loops[row.closes];
    faults.push(match one.contact {
        Some(_) => wording::contact_touches_at_single_positions(&one.location, &one.name),
        None => wording::loop_closes_at_single_positions(&one.location, (&one.name, row.name)),
    });
    None
}

/// Returns the largest rate of each row where the loops are open, at most the size of the mechanism or 1: that of a rod
/// is longer than the rod by any factor.
fn sizes(closure: &Closure, rows: &[LoopRow]) -> Vec<f64> {
    let mut sizes = vec![0.0; rows.len()];
    for q in closure.open_positions() {
        let (_, rates) = closure.values(rows, &q);
        for (size, row) in sizes.iter_mut().zip(rates) {
            let all = row.iter().map(|x| x.to_f64().abs());
            *size = all.fold(*size, f64::max);
        }
    }
    let most = closure.size().max(1.0);
    sizes.into_iter().map(|size| size.min(most)).collect()
}

/// Returns the row with the smallest pivot at a position, if it is a rounding error.
fn dependent_row(
    closure: &Closure,
    (rows, sizes): (&[LoopRow], &[f64]),
    q: &[Dd],
) -> Option<usize> {
    let (_, mut rates) = closure.values(rows, q);
    for (row, size) in rates.iter_mut().zip(sizes) {
        row.iter_mut().for_each(|x| *x /= Dd::from_f64(*size));
    }
    let (pivots, _) = eliminate(&mut rates, closure.positions.len());
    let left = (0..rows.len()).find(|r| pivots.iter().all(|(row, _)| row != r));
    let smallest = pivots.last().filter(|&&(row, column)| {
        let pivot = rates[row][column];
        pivot.to_f64().abs() < SINGULAR
    });
    left.or(smallest.map(|(row, _)| *row))
}

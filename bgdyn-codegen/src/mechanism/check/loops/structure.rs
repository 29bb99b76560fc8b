//! Rows that hold at every position of the tree, or at none.

use bgdyn_runtime::Dd;

use super::read::ReadLoop;
use crate::fault::{Faults, wording};
use crate::mechanism::closure::{ClosingRow, Closure, RowAxes, RowKind};
use crate::mechanism::joint::DoubleDouble;

/// A value below this is a rounding error of double-double, relative to 1 m or 1 rad.
const ROUNDING: f64 = 1e-24;

/// A constant value below this is a rounding error of lengths and angles with 16 digits, m or rad.
const ROUNDED: f64 = 1e-14;

/// Drops the rows that hold at every position; reports loops that have no others, and rows with a constant value that is
/// not zero: above the rounding of the numbers of the file, or above the loop's `tolerance`.
pub(super) fn drop_rows(closure: &mut Closure, read: &[ReadLoop], faults: &mut Faults) {
    let values: Vec<(Vec<Dd>, Vec<Vec<Dd>>)> = closure
        .open_positions()
        .iter()
        .map(|q| closure.values(&closure.rows, q))
        .collect();
    let of_row = |r: usize| values.iter().map(move |(at, _)| at[r]);
    let moves = |r: usize| {
        let rates = values.iter().flat_map(|(_, rates)| &rates[r]);
        rates.map(|x| x.to_f64().abs()).fold(0.0, f64::max) > ROUNDING
    };
    let spread = |r: usize| {
        let first = values[0].0[r];
        of_row(r)
            .map(|x| (x - first).to_f64().abs())
            .fold(0.0, f64::max)
    };
    let (mut kept, mut dropped) = (Vec::new(), Vec::new());
    for (r, row) in closure.rows.iter().enumerate() {
        if !row.kind.has_positions() {
            match moves(r) {
                true => kept.push(*row),
                false => dropped.push(*row),
            }
            continue;
        }
        let largest = of_row(r).map(|x| x.to_f64().abs()).fold(0.0, f64::max);
        if largest <= ROUNDING {
            dropped.push(*row);
            continue;
        }
        if spread(r) <= ROUNDING {
            let one = &closure.loops[row.closes];
            let allowed = f64::max(ROUNDED, read[row.closes].tolerance);
            if one.contact.is_none() && largest <= allowed {
                dropped.push(*row);
                continue;
            }
            let value = values[0].0[r].to_f64();
            faults.push(match &one.contact {
                Some(contact) => wording::wheel_never_touches(
                    &one.location,
                    &one.name,
                    (value, &contact.sizes()),
                ),
                None => wording::loop_row_never_holds(
                    &one.location,
                    (&one.name, row.name),
                    (value, row.kind.unit()),
                ),
            });
        }
        kept.push(*row);
    }
    (closure.rows, closure.dropped) = (kept, dropped);
    report_empty(closure, read, faults);
    let reversible = (0..closure.loops.len()).map(|closes| is_reversible(closure, closes));
    let reversible: Vec<bool> = reversible.collect();
    for (one, reversible) in closure.loops.iter_mut().zip(reversible) {
        one.reversible = reversible;
    }
}

/// Reports loops and contacts all of whose rows hold at every position; beside others a loop may have `redundant`.
fn report_empty(closure: &Closure, read: &[ReadLoop], faults: &mut Faults) {
    for (closes, one) in closure.loops.iter().enumerate() {
        let allowed = read[closes].redundant && !closure.rows.is_empty();
        if allowed || closure.rows.iter().any(|row| row.closes == closes) {
            continue;
        }
        let own = closure.dropped.iter().filter(|row| row.closes == closes);
        let names: Vec<&str> = own.map(|row| row.name).collect();
        faults.push(match one.contact {
            Some(_) => wording::contact_rows_always_hold(&one.location, &one.name, &names),
            None => wording::loop_rows_always_hold(&one.location, &one.name, &names),
        });
    }
}

/// Returns whether the rows of a loop hold in the axes of place b as well: those that are dropped must be zero there
/// too.
fn is_reversible(closure: &Closure, closes: usize) -> bool {
    let one = &closure.loops[closes];
    let symmetric = |row: &(&str, ClosingRow)| {
        matches!(
            row.1,
            ClosingRow::Place(_) | ClosingRow::Tilt(_) | ClosingRow::Turn(_)
        )
    };
    if !one.kind.coincident || !one.kind.rows.iter().all(symmetric) {
        return false;
    }
    let axes = RowAxes {
        reversed: true,
        of_plane: false,
        closed: false,
    };
    let mut turned = closure.clone();
    turned.loops[closes].reversible = true;
    let dropped = closure.dropped.iter().filter(|row| row.closes == closes);
    let dropped: Vec<RowKind> = dropped.map(|row| row.kind).collect();
    closure.open_positions().iter().all(|q| {
        let at = turned.rows_at(closes, axes, (q, &DoubleDouble));
        let zero = |kind: &RowKind| at.residual(*kind, &DoubleDouble).to_f64().abs() <= ROUNDING;
        dropped.iter().all(zero)
    })
}

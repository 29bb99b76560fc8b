//! Rows that follow from others.
//!
//! - At every position of the tree: a fault, or left out where the loop says `redundant: allow`.
//! - At closed positions only: the loop moves by its lengths alone (paradoxical). Left out, with a warning.
//! - Almost, because lengths are rounded: the loop closes to a small gap only. Left out within its `tolerance`.
//!
//! The rows that stay close exactly.

use bgdyn_runtime::Dd;

use super::read::ReadLoop;
use super::samples;
use crate::fault::{Faults, wording};
use crate::mechanism::closure::{Closure, FollowingRow, eliminate};

/// Rows whose pivots are below this, relative to the first one, follow from others.
pub(super) const FOLLOWS: f64 = 1e-18;

/// The same for loops that stay open, times their gap over their size.
const FOLLOWS_TO_GAP: f64 = 1e3;

/// A row that follows from others is open by less.
const CLOSED: f64 = 1e-24;

/// A row within this part of the best pivot is taken, if it comes first.
const NEARLY_BEST: f64 = 0.5;

/// B at one position, row by row.
pub(super) type Jacobian = Vec<Vec<Dd>>;

/// The rows by what they follow from.
struct RowsByRank {
    /// Those that are independent at some position of the tree.
    somewhere: Vec<usize>,
    /// Those that follow from these at every position.
    always: Vec<usize>,
    /// Those that are independent at closed positions.
    kept: Vec<usize>,
    /// Those that follow from these at closed positions only.
    closed_only: Vec<usize>,
}

/// Leaves out rows that follow from others; `gap` is by how much the start is open. `None` if a rule is broken.
pub(super) fn leave_out(
    closure: &mut Closure,
    (read, gap): (&[ReadLoop], f64),
    faults: &mut Faults,
) -> Option<()> {
    let before = faults.count();
    let of_rows = |q: &Vec<Dd>| closure.values(&closure.rows, q).1;
    let (least, on): (f64, Vec<Jacobian>) = match gap > 0.0 {
        true => {
            let tolerance = read.iter().map(|one| one.tolerance).fold(0.0, f64::max);
            (least(closure, tolerance), vec![of_rows(&closure.start)])
        }
        false => (FOLLOWS, closure.samples.iter().map(of_rows).collect()),
    };
    let rows = by_rank(closure, read, (&on, least));
    report_refused(closure, (read, &rows), &on, faults);
    if faults.count() > before {
        return None;
    }
    if rows.kept.len() < closure.rows.len() {
        let kept = match rows.closed_only.is_empty() {
            true => rows.kept.clone(),
            false => best(&on, &rows.somewhere, rows.kept.len()),
        };
        keep(closure, &kept, &rows.always);
        close_again(closure);
    }
    judge(closure, (read, gap), faults);
    if faults.count() > before {
        return None;
    }
    if !rows.closed_only.is_empty() {
        warn(closure, rows.somewhere.len(), faults);
    }
    Some(())
}

/// Returns which rows follow from others; those that may do so, because their loop is `redundant` or has a `tolerance`,
/// come last.
fn by_rank(closure: &Closure, read: &[ReadLoop], (on, least): (&[Jacobian], f64)) -> RowsByRank {
    let of_rows = |q: &Vec<Dd>| closure.values(&closure.rows, q).1;
    let off: Vec<Jacobian> = closure.open_positions().iter().map(of_rows).collect();
    let allowed = |r: &usize| {
        let one = &read[closure.rows[*r].closes];
        one.redundant || one.tolerance > 0.0
    };
    let (mut order, last): (Vec<usize>, Vec<usize>) =
        (0..closure.rows.len()).partition(|r| !allowed(r));
    order.extend(last);
    let (somewhere, always) = split(&off, &order, least);
    let (kept, closed_only) = split(on, &somewhere, least);
    RowsByRank {
        somewhere,
        always,
        kept,
        closed_only,
    }
}

/// Reports rows that may not follow from others: at every position without `redundant: allow`, and those of contacts.
fn report_refused(
    closure: &Closure,
    (read, rows): (&[ReadLoop], &RowsByRank),
    on: &[Jacobian],
    faults: &mut Faults,
) {
    let closes = |r: &&usize| closure.rows[**r].closes;
    for &r in rows.always.iter().filter(|r| !read[closes(r)].redundant) {
        report(closure, (r, &rows.somewhere), on, faults);
    }
    let touches = |r: &&usize| closure.loops[closes(r)].contact.is_some();
    for &r in rows.closed_only.iter().filter(touches) {
        report(closure, (r, &rows.kept), on, faults);
    }
}

/// Reports rows that do not close: those that stay must, and those that were left out, to the tolerance of their loop.
fn judge(closure: &Closure, (read, gap): (&[ReadLoop], f64), faults: &mut Faults) {
    let rows = closure.position_rows();
    let (residuals, _) = closure.values(&rows, &closure.start);
    for (row, open) in rows.iter().zip(residuals) {
        let (one, open) = (&closure.loops[row.closes], open.to_f64().abs());
        if open > CLOSED {
            let names = (one.name.as_str(), row.name);
            faults.push(wording::loop_closes_to_rounding(&one.location, names, open));
            return;
        }
    }
    for (left, open) in closure.following.iter().zip(open_along(closure)) {
        let one = &closure.loops[left.row.closes];
        let tolerance = read[left.row.closes].tolerance;
        if open <= f64::max(CLOSED, tolerance) {
            continue;
        }
        let (location, name) = (&one.location, one.name.as_str());
        faults.push(match gap > 0.0 && tolerance > 0.0 {
            true => wording::tolerance_exceeded(location, name, (open, tolerance)),
            false => wording::loop_closes_at_single_positions(location, (name, left.row.name)),
        });
        return;
    }
}

pub(super) fn least(closure: &Closure, gap: f64) -> f64 {
    f64::max(FOLLOWS, FOLLOWS_TO_GAP * gap / closure.size())
}

/// Takes these rows, and leaves out the others; those in `always` follow from others at every position.
pub(super) fn keep(closure: &mut Closure, kept: &[usize], always: &[usize]) {
    let rows = std::mem::take(&mut closure.rows);
    for (r, row) in rows.into_iter().enumerate() {
        if kept.contains(&r) {
            closure.rows.push(row);
            continue;
        }
        // The rows of the other place are other rows, which may not be as many.
        closure.loops[row.closes].reversible = false;
        let always = always.contains(&r);
        closure.following.push(FollowingRow { row, always });
    }
}

/// Closes the rows that are left, at the start and at closed positions at random.
pub(super) fn close_again(closure: &mut Closure) {
    let rows = closure.position_rows();
    let mut start = closure.start.clone();
    let moving = closure.moving();
    closure.assemble(&rows, &mut start, &moving);
    closure.start = start;
    closure.samples = samples::sample(closure);
}

/// Returns by how much each row that was left out is open, at most, at the start and the closed positions.
pub(super) fn open_along(closure: &Closure) -> Vec<f64> {
    let left: Vec<_> = closure.following.iter().map(|one| one.row).collect();
    let mut most = vec![0.0; left.len()];
    for q in closure.samples.iter().chain([&closure.start]) {
        let (residuals, _) = closure.values(&left, q);
        for (most, open) in most.iter_mut().zip(residuals) {
            *most = f64::max(*most, open.to_f64().abs());
        }
    }
    most
}

/// Returns the rows that are independent of those before them, in this order, and the others: those that follow from
/// them at all positions.
pub(super) fn split(
    jacobians: &[Jacobian],
    order: &[usize],
    least: f64,
) -> (Vec<usize>, Vec<usize>) {
    let mut independent: Vec<usize> = Vec::new();
    let mut following = Vec::new();
    for &r in order {
        let mut all = jacobians.iter();
        let follows =
            |jacobian: &Jacobian| combination(jacobian, (&independent, r), least).is_some();
        match all.all(follows) {
            true => following.push(r),
            false => independent.push(r),
        }
    }
    (independent, following)
}

/// Returns as many rows, each the one with the largest part, at the worst position, that the others do not determine.
pub(super) fn best(jacobians: &[Jacobian], of: &[usize], count: usize) -> Vec<usize> {
    let mut parts: Vec<Jacobian> = jacobians.to_vec();
    let mut chosen: Vec<usize> = Vec::new();
    let sizes: Vec<Vec<f64>> = jacobians
        .iter()
        .map(|rows| rows.iter().map(|r| size(r)).collect())
        .collect();
    while chosen.len() < count {
        let share = |r: usize| {
            let at = parts
                .iter()
                .zip(&sizes)
                .map(|(rows, sizes)| size(&rows[r]) / sizes[r]);
            at.fold(f64::INFINITY, f64::min)
        };
        let left: Vec<usize> = of.iter().copied().filter(|r| !chosen.contains(r)).collect();
        let most = left.iter().map(|&r| share(r)).fold(0.0, f64::max);
        let Some(&next) = left.iter().find(|&&r| share(r) >= NEARLY_BEST * most) else {
            break;
        };
        chosen.push(next);
        parts.iter_mut().for_each(|rows| project_out(rows, next));
    }
    chosen.sort_unstable();
    chosen
}

fn size(row: &[Dd]) -> f64 {
    row.iter()
        .map(|x| x.to_f64() * x.to_f64())
        .sum::<f64>()
        .sqrt()
}

/// Makes all other rows perpendicular to this one.
fn project_out(rows: &mut Jacobian, along: usize) {
    let unit = rows[along].clone();
    let square = dot(&unit, &unit);
    for (r, row) in rows.iter_mut().enumerate() {
        if r != along && square > Dd::ZERO {
            let factor = dot(row, &unit) / square;
            row.iter_mut()
                .zip(&unit)
                .for_each(|(x, &y)| *x -= factor * y);
        }
    }
}

fn dot(x: &[Dd], y: &[Dd]) -> Dd {
    x.iter().zip(y).fold(Dd::ZERO, |sum, (&x, &y)| sum + x * y)
}

/// Returns the factors of the rows `of` whose sum is row r; `None` if it is independent of them.
fn combination(jacobian: &Jacobian, (of, r): (&[usize], usize), least: f64) -> Option<Vec<f64>> {
    // Columns are the rows of B: Σ factor · row = row r.
    let n = jacobian[r].len();
    let mut system: Jacobian = (0..n)
        .map(|j| of.iter().chain([&r]).map(|&k| jacobian[k][j]).collect())
        .collect();
    let largest = |row: &Vec<Dd>| row.iter().map(|x| x.to_f64().abs()).fold(0.0, f64::max);
    let size = largest(&jacobian[r]);
    let (pivots, _) = eliminate(&mut system, of.len());
    let mut factors = vec![0.0; of.len()];
    for &(row, column) in &pivots {
        factors[column] = (system[row][of.len()] / system[row][column]).to_f64();
    }
    let used = |i: usize| pivots.iter().any(|(row, _)| *row == i);
    let left = (0..n)
        .filter(|&i| !used(i))
        .map(|i| system[i][of.len()].to_f64().abs());
    (left.fold(0.0, f64::max) <= least * size.max(1e-6)).then_some(factors)
}

/// Reports a row that follows from others, with the combination at the start.
fn report(closure: &Closure, (r, of): (usize, &[usize]), on: &[Jacobian], faults: &mut Faults) {
    let row = &closure.rows[r];
    let one = &closure.loops[row.closes];
    let earlier: Vec<usize> = of.iter().copied().filter(|&k| k != r).collect();
    let factors = combination(&on[0], (&earlier, r), f64::INFINITY).unwrap_or_default();
    let terms = earlier.iter().zip(factors);
    let terms: Vec<(String, f64)> = terms
        .filter(|(_, factor)| factor.abs() > 1e-9)
        .map(|(&k, factor)| (closure.row_name(&closure.rows[k]), factor))
        .collect();
    let (location, names) = (&one.location, (one.name.as_str(), row.name));
    faults.push(match one.contact {
        Some(_) => wording::dependent_contact_row(location, names, &terms),
        None => wording::dependent_loop_row(location, names, &terms),
    });
}

/// Warns of loops that move by their lengths only; `off` is the number of rows that are independent somewhere.
pub(super) fn warn(closure: &Closure, off: usize, faults: &mut Faults) {
    let left = closure.following.iter().filter(|one| !one.always);
    let rows: Vec<_> = left.map(|one| one.row).collect();
    let Some(first) = rows.first() else { return };
    let one = &closure.loops[first.closes];
    let names: Vec<String> = rows.iter().map(|row| closure.row_name(row)).collect();
    let (moving, on) = (closure.moving().len(), closure.rows.len());
    let fault = wording::paradoxical_loop(&one.location, (&one.name, &names), (moving, off, on));
    faults.push(fault.into_warning());
}

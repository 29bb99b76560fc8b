//! Finds a closed position on the branch of the file.

use bgdyn_runtime::Dd;

use super::rank;
use super::read::ReadLoop;
use super::samples::sample;
use crate::fault::{Faults, wording};
use crate::mechanism::CoordinateId;
use crate::mechanism::closure::Closure;
use crate::random::Random;

/// Starts of the search, the given position first.
const STARTS: u64 = 200;

/// A residual below this is that of a closed position.
const CLOSED: f64 = 1e-25;

/// A wheel whose lean has a smaller cosine lies flat.
const FLAT: f64 = 1e-6;

/// Positions with such a gap that are tried for motion.
const NEAR: usize = 8;

/// A gap below this, relative to the size of the largest loop, would be one of rounded lengths.
const ROUNDED: f64 = 1e-4;

/// A position with its gap, m or rad.
type OpenPosition = (f64, Vec<Dd>);

/// Sets a closed start, and closed positions at random. `kept` are the velocities that the file names as
/// independent: their positions stay those of the start if they can. Returns by how much the start is open: 0, or a gap
/// within the `tolerance` of a loop.
pub(super) fn assemble(
    closure: &mut Closure,
    read: &[ReadLoop],
    kept: &[CoordinateId],
    faults: &mut Faults,
) -> Option<f64> {
    let mut given = closure.start.clone();
    for (position, value) in read.iter().flat_map(|one| &one.near) {
        given[position.0] = *value;
    }
    let rows = closure.position_rows();
    let moving = closure.moving();
    let others: Vec<usize> = moving
        .iter()
        .copied()
        .filter(|j| !kept.contains(&CoordinateId(*j)))
        .collect();
    let mut best = (f64::INFINITY, given.clone());
    let mut near: Vec<OpenPosition> = Vec::new();
    let rounded = ROUNDED * closure.size();
    let (mut wrong, mut flat): (Option<usize>, Option<usize>) = (None, None);
    // Of any loop: which rows stay open is decided by `rank::leave_out`.
    let tolerance = read.iter().map(|one| one.tolerance).fold(0.0, f64::max);
    for seed in 0..STARTS {
        let mut q = given.clone();
        let mut random = Random(seed);
        let spread = if seed < STARTS / 2 { 0.5 } else { 3.0 };
        let changed = if seed % 2 == 0 { &others } else { &moving };
        if seed > 0 {
            let step = |&j: &usize| (j, Dd::from_f64(spread * random.signed()));
            closure.displace(&mut q, &changed.iter().map(step).collect::<Vec<_>>());
        }
        let mut left = closure.assemble(&rows, &mut q, &others);
        if left > CLOSED {
            left = closure.assemble(&rows, &mut q, &moving);
        }
        if left > f64::max(CLOSED, tolerance) {
            if left < rounded && near.len() < NEAR {
                near.push((left, q.clone()));
            }
            if left < best.0 {
                best = (left, q);
            }
            continue;
        }
        if let Some(one) = closure.flat_wheel(&q, FLAT) {
            flat = flat.or(Some(one));
            continue;
        }
        match on_other_branch(closure, read, &q) {
            None => {
                closure.start = q;
                closure.samples = sample(closure);
                return Some(if left > CLOSED { left } else { 0.0 });
            }
            Some(one) => wrong = wrong.or(Some(one)),
        }
    }
    match (wrong, flat) {
        (Some(one), _) => {
            let location = read[one]
                .branch
                .as_ref()
                .map_or(&read[one].closes.location, |b| &b.location);
            faults.push(wording::branch_not_found(location, &read[one].closes.name));
        }
        (None, Some(one)) => {
            let one = &closure.loops[one];
            faults.push(wording::wheel_lies_flat(&one.location, &one.name));
        }
        (None, None) => report_gap(closure, (best, &near), faults),
    }
    None
}

/// Returns the first loop that is closed on another branch than that of the file, or turned over.
fn on_other_branch(closure: &Closure, read: &[ReadLoop], q: &[Dd]) -> Option<usize> {
    (0..read.len()).find(|&one| {
        let wanted = read[one].branch.as_ref();
        let other = wanted.is_some_and(|branch| !branch.value.contains(closure, one, q));
        other || closure.flipped(one, q)
    })
}

/// Reports the loop with the largest gap at the best position, or the one that would move if it closed.
fn report_gap(
    closure: &Closure,
    ((left, q), near): (OpenPosition, &[OpenPosition]),
    faults: &mut Faults,
) {
    let rounded = ROUNDED * closure.size();
    let moves = |(left, q): &OpenPosition| rank::almost_moves(closure, (q, *left), rounded);
    if let Some(almost) = near.iter().find_map(moves) {
        let one = &closure.loops[almost.closes];
        let gaps = (almost.gap, almost.open);
        let fault = wording::loop_moves_but_for_rounding(&one.location, &one.name, gaps);
        faults.push(fault);
        return;
    }
    let rows = closure.position_rows();
    let (residuals, _) = closure.values(&rows, &q);
    let sizes = residuals.iter().map(|x| x.to_f64().abs());
    let worst = sizes.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
    let Some((row, _)) = worst else { return };
    let row = &rows[row];
    let one = &closure.loops[row.closes];
    let names = (one.name.as_str(), row.name);
    faults.push(match left < rounded {
        true => wording::loop_closes_to_rounding(&one.location, names, left),
        false => wording::loop_not_assembled(&one.location, names, left),
    });
}

//! Finds a closed position on the branch of the file.

use bgdyn_runtime::Dd;

use super::read::ReadLoop;
use super::rounding;
use super::samples::sample;
use crate::fault::{Faults, wording};
use crate::mechanism::closure::{Closure, LoopRow};
use crate::mechanism::{CoordinateId, PositionId};
use crate::random::Random;

/// Starts of the search, the given position first.
const STARTS: u64 = 200;

/// A residual below this is that of a closed position.
const CLOSED: f64 = 1e-25;

/// A rate below this part of the largest one of its row is a rounding error.
const ROUNDING: f64 = 1e-24;

/// A wheel whose lean has a smaller cosine lies flat.
const FLAT: f64 = 1e-6;

/// Positions with such a gap that are tried for motion.
const NEAR: usize = 8;

/// A gap below this, relative to the size of the largest loop, would be one of rounded lengths.
const ROUNDED: f64 = 1e-4;

/// A position with its gap, m or rad: the largest row, of the best one the root of the sum of squares.
type OpenPosition = (f64, Vec<Dd>);

/// Returns the position from which the search for a closed one begins.
pub(super) fn given(closure: &Closure, read: &[ReadLoop]) -> Vec<Dd> {
    let mut given = closure.start.clone();
    for (position, value, _) in read.iter().flat_map(|one| &one.near) {
        given[position.0] = *value;
    }
    given
}

/// Sets a closed start, and closed positions at random. `kept` are the velocities that the file names as
/// independent: their positions stay those of the start if they can. Returns by how much the start is open: 0, or a gap
/// within the `tolerance` of a loop.
pub(super) fn assemble(
    closure: &mut Closure,
    read: &[ReadLoop],
    kept: &[CoordinateId],
    faults: &mut Faults,
) -> Option<f64> {
    let given = given(closure, read);
    let rows = closure.position_rows();
    let moving = closure.moving();
    let read_by_rows = read_by(closure, &rows);
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
            let mut steps: Vec<(usize, Dd)> = changed.iter().map(step).collect();
            steps.retain(|(j, _)| read_by_rows.contains(j));
            closure.displace(&mut q, &steps);
        }
        let mut left = closure.assemble(&rows, &mut q, &others);
        if left > CLOSED {
            left = closure.assemble(&rows, &mut q, &moving);
        }
        if left > f64::max(CLOSED, tolerance) {
            if left < rounded && near.len() < NEAR {
                near.push((left, q.clone()));
            }
            let (residuals, _) = closure.values(&rows, &q);
            let squares = residuals.iter().map(|x| x.to_f64() * x.to_f64());
            let distance = squares.sum::<f64>().sqrt();
            if distance < best.0 {
                best = (distance, q);
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
            Some(one) if seed == 0 && is_determined(closure, &read[one]) => {
                report_near(&read[one], faults);
                return None;
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

/// Returns the velocities that these rows read, somewhere; the others stay where they are.
fn read_by(closure: &Closure, rows: &[LoopRow]) -> Vec<usize> {
    let at = closure.open_positions().into_iter();
    let rates = at.flat_map(|q| closure.values(rows, &q).1);
    let sizes = rates.map(|row| row.iter().map(|x| x.to_f64().abs()).collect());
    let sizes: Vec<Vec<f64>> = sizes.collect();
    let reads = |row: &Vec<f64>, j: usize| {
        let largest = row.iter().copied().fold(0.0, f64::max);
        row[j] > ROUNDING * largest
    };
    let mut moving = closure.moving();
    moving.retain(|&j| sizes.iter().any(|row| reads(row, j)));
    moving
}

/// Returns whether the positions in `near` of a loop are more than it leaves free, so that they tell the branch.
fn is_determined(closure: &Closure, one: &ReadLoop) -> bool {
    let own = closure
        .loops
        .iter()
        .position(|closes| closes.name == one.closes.name);
    let rows = closure.position_rows();
    let rows = rows.iter().filter(|row| Some(row.closes) == own).count();
    let velocities: Vec<CoordinateId> = one.closes.velocities().collect();
    let of_loop = |(p, ..): &&(PositionId, Dd, String)| {
        let mut all = velocities.iter();
        all.any(|j| closure.positions[j.0] == Some(*p))
    };
    let given = one.near.iter().filter(of_loop).count();
    one.branch.is_some() && given + rows > velocities.len()
}

/// Reports a branch that contradicts the positions in `near`.
fn report_near(one: &ReadLoop, faults: &mut Faults) {
    let Some(branch) = &one.branch else { return };
    let near = one.near.iter();
    let near: Vec<(String, f64)> = near
        .map(|(_, x, joint)| (joint.clone(), x.to_f64()))
        .collect();
    let words = branch.value.words();
    let fault = wording::branch_contradicts_near(&branch.location, &one.closes.name, words, &near);
    faults.push(fault);
}

/// Returns the first loop that is closed on another branch than that of the file, or turned over.
pub(super) fn on_other_branch(closure: &Closure, read: &[ReadLoop], q: &[Dd]) -> Option<usize> {
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
    let moves = |(left, q): &OpenPosition| rounding::almost_moves(closure, (q, *left), rounded);
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
    let Some((row, size)) = worst else { return };
    let (closes, gap) = closure.widest_gap(&q);
    let one = &closure.loops[closes];
    faults.push(match left < rounded {
        true => {
            let one = &closure.loops[rows[row].closes];
            let names = (one.name.as_str(), rows[row].name);
            wording::loop_closes_to_rounding(&one.location, names, size)
        }
        false => {
            let gap = (gap.distance, gap.angle);
            wording::loop_not_assembled(&one.location, &one.name, gap)
        }
    });
}

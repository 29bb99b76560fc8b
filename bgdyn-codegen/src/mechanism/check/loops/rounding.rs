//! Loops that would move if their lengths were not rounded: at no position they close, or at single ones only.

use bgdyn_runtime::Dd;

use super::rank::{FOLLOWS, best, close_again, keep, least, open_along, split, warn};
use super::read::ReadLoop;
use super::samples;
use crate::fault::{Faults, wording};
use crate::mechanism::closure::Closure;

/// Rows whose pivots are below these follow from others if lengths are rounded; the first that leaves a motion counts.
const FOLLOW: [f64; 14] = [
    1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2,
];

/// A row is open by no more than this, relative to the size of the largest loop, if lengths are rounded.
const ROUNDED: f64 = 2e-4;

/// Gaps of positions near the given one, largest first, over what is rounding: at the first, motions are tried.
const NEAR: [f64; 5] = [1.0, 1e-2, 1e-4, 1e-6, 1e-8];

/// A position that differs from the start by more than this, rad or m, is another one.
const MOVED: f64 = 0.1;

/// What becomes of loops that almost close.
pub(super) struct Almost {
    /// The index of a loop with a row that the others would determine.
    pub(super) closes: usize,
    /// The gap at the position, m or rad.
    pub(super) gap: f64,
    /// The most by which it is open along the motion of the others, m or rad.
    pub(super) open: f64,
}

/// Returns whether loops that stay open by a gap at q would move if they closed: without the rows that almost follow
/// from others they do, and those stay closed to `most`.
pub(super) fn almost_moves(closure: &Closure, (q, gap): (&[Dd], f64), most: f64) -> Option<Almost> {
    if closure.nonholonomic() {
        return None;
    }
    let at = [closure.values(&closure.rows, q).1];
    let order: Vec<usize> = (0..closure.rows.len()).collect();
    let tried = (0..5).map(|k| least(closure, gap * 10_f64.powi(k)));
    tried.into_iter().find_map(|least| {
        let (kept, left) = split(&at, &order, least);
        if left.is_empty() {
            return None;
        }
        let mut trial = closure.clone();
        trial.start = q.to_vec();
        keep(&mut trial, &best(&at, &order, kept.len()), &[]);
        close_again(&mut trial);
        let open = open_along(&trial).into_iter().fold(0.0, f64::max);
        let moves = open <= most && moves(&trial);
        let closes = trial.following.first()?.row.closes;
        moves.then_some(Almost { closes, gap, open })
    })
}

/// Returns whether a sampled position is clearly another one than the start.
fn moves(closure: &Closure) -> bool {
    let moved = |sample: &Vec<Dd>| {
        let mut steps = sample.iter().zip(&closure.start);
        steps.any(|(x, y)| (*x - *y).to_f64().abs() > MOVED)
    };
    closure.samples.iter().any(moved)
}

/// Rows that hold loops by rounded lengths alone.
pub(super) struct Held {
    /// The loops without them.
    pub(super) without: Closure,
    /// The most by which each row left out is open along their motion, m or rad.
    open: Vec<f64>,
}

/// Returns the rows without which closed loops that hold each other would move, and which stay almost closed then: near
/// the `given` position, from which the search for a closed one leads far away if lengths are rounded.
pub(super) fn held_by(closure: &Closure, given: &[Dd]) -> Option<Held> {
    let at = [closure.values(&closure.rows, &closure.start).1];
    let all: Vec<usize> = (0..closure.rows.len()).collect();
    let moves = all.len() < closure.moving().len();
    if moves || closure.nonholonomic() || !split(&at, &all, FOLLOWS).1.is_empty() {
        return None;
    }
    let moving = closure.moving();
    let rounded = ROUNDED * closure.size();
    let near = NEAR.iter().filter_map(|part| {
        let (mut q, enough) = (given.to_vec(), part * rounded);
        let gap = closure.assemble_to(&closure.rows, &mut q, &moving, enough);
        (gap <= enough).then_some(q)
    });
    let mut near = near.chain([closure.start.clone()]);
    near.find_map(|q| held_at(closure, (&all, &q), rounded))
}

/// Returns the same near one position.
fn held_at(closure: &Closure, (all, q): (&[usize], &[Dd]), rounded: f64) -> Option<Held> {
    let at = [closure.values(&closure.rows, q).1];
    FOLLOW.iter().find_map(|&least| {
        let (kept, left) = split(&at, all, least);
        if left.is_empty() {
            return None;
        }
        let mut without = closure.clone();
        without.start = q.to_vec();
        keep(&mut without, &best(&at, all, kept.len()), &[]);
        close_again(&mut without);
        without.samples = samples::around(&without);
        let open = open_along(&without);
        let moves = open.iter().all(|x| *x <= rounded) && moves(&without);
        moves.then_some(Held { without, open })
    })
}

/// Leaves out rows that hold loops by rounded lengths alone. `None` if they do not stay within the `tolerance` of their
/// loops.
pub(super) fn leave_out(
    closure: &mut Closure,
    read: &[ReadLoop],
    held: Held,
    faults: &mut Faults,
) -> Option<()> {
    let rows = closure.rows.len();
    let joints = closure.moving().len();
    for (left, &open) in held.without.following.iter().zip(&held.open) {
        let one = &closure.loops[left.row.closes];
        let tolerance = read[left.row.closes].tolerance;
        if open <= tolerance {
            continue;
        }
        let (location, name) = (&one.location, one.name.as_str());
        faults.push(match tolerance > 0.0 {
            true => wording::tolerance_exceeded(location, name, (open, tolerance)),
            false => {
                let names = (name, left.row.name);
                wording::loop_held_by_rounding(location, names, (rows, joints), open)
            }
        });
        return None;
    }
    *closure = held.without;
    warn(closure, rows, faults);
    Some(())
}

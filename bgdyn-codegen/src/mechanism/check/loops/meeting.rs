//! Starts at which branches of loops meet.

use bgdyn_runtime::Dd;

use super::read::ReadLoop;
use crate::fault::{Faults, wording};
use crate::mechanism::closure::Closure;

/// Branches meet where a row has no larger part that the others do not determine, over its size elsewhere.
const MEET: f64 = 1e-9;

/// Refuses a start at which branches meet: rows follow from others there that do not elsewhere. `None` if they do.
pub(super) fn refuse_at_start(
    closure: &Closure,
    read: &[ReadLoop],
    faults: &mut Faults,
) -> Option<()> {
    let (rows, moving) = (closure.position_rows(), closure.moving());
    let parts = |q: &Vec<Dd>| closure.perpendicular_parts(&rows, &moving, q);
    let sampled: Vec<Vec<(f64, f64)>> = closure.samples.iter().map(parts).collect();
    let size = |row: usize| sampled.iter().map(|at| at[row].1).fold(0.0, f64::max);
    let mut at_start = parts(&closure.start).into_iter().enumerate();
    let Some((row, _)) = at_start.find(|&(row, (part, _))| part < MEET * size(row)) else {
        return Some(());
    };
    let one = &closure.loops[rows[row].closes];
    let branches = read[rows[row].closes]
        .parallelogram
        .then_some("`branch: parallel` or `branch: crossed`");
    faults.push(wording::branches_meet_at_start(
        &one.location,
        &one.name,
        branches,
    ));
    None
}

//! The start of a scene with loops: closed positions, and the independent velocities.
//!
//! The given positions are reached from the closed position of the mechanism in small parts, closed after each, so that
//! the branch stays that of the mechanism.

use bgdyn_runtime::Dd;

use crate::fault::{Fault, Location, wording};
use crate::layout::StateLayout;
use crate::mechanism::closure::{Closure, solve_basic};
use crate::mechanism::{CoordinateId, Mechanism};

/// Parts of the way from the closed position of the mechanism to the given one.
const PARTS: u32 = 32;

/// A residual below this is that of a closed position.
const CLOSED: f64 = 1e-25;

/// Largest difference of a given dependent position or velocity from that of the closed start: rad, m, or per second.
const AGREES: f64 = 1e-3;

/// The reason why a start does not exist.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum NoStart {
    /// A loop stays open by this gap, m or rad, in this row.
    Open {
        /// Its name.
        closes: String,
        /// The row.
        row: &'static str,
        /// The gap.
        gap: f64,
        /// The part of the way from the mechanism's own position up to which the loops close, 0 to 1.
        part: f64,
    },
    /// The way to the given positions leads through a singular position, to another branch.
    OtherBranch,
    /// The loops give a position or a velocity that differs from the given one.
    Contradicts {
        /// The position's index, or that of the velocity in the open tree.
        index: usize,
        /// Whether it is a velocity.
        velocity: bool,
        /// The given number.
        given: f64,
        /// That of the closed start.
        closed: f64,
    },
}

/// Closes positions of which those with the indices `given` are in the file. Positions outside of loops do not change.
pub(super) fn close_positions(
    closure: &Closure,
    q: &mut [Dd],
    given: &[usize],
) -> Result<(), NoStart> {
    let moving = closure.moving();
    let is_given = |j: &usize| closure.positions[*j].is_some_and(|p| given.contains(&p.0));
    let independent = |j: &usize| closure.independents.contains(&CoordinateId(*j));
    let freedoms = moving.iter().filter(|j| independent(j)).count();
    // Given positions are kept, independent ones first, as many as the loops leave free.
    let (first, second): (Vec<usize>, Vec<usize>) = moving
        .iter()
        .copied()
        .filter(|j| is_given(j))
        .partition(|j| independent(j));
    let kept: Vec<usize> = first.into_iter().chain(second).take(freedoms).collect();
    let free: Vec<usize> = moving
        .iter()
        .copied()
        .filter(|j| !kept.contains(j))
        .collect();
    let target = q.to_vec();
    let position = |j: usize| closure.positions[j].map_or(0, |p| p.0);
    for &j in &moving {
        q[position(j)] = closure.start[position(j)];
    }
    for part in 1..=PARTS {
        let share = Dd::from_f64(f64::from(part) / f64::from(PARTS));
        for &j in &kept {
            let (from, to) = (closure.start[position(j)], target[position(j)]);
            // In the scalar of most models.
            q[position(j)] = Dd::from_f64((from + (to - from) * share).to_f64());
        }
        let gap = closure.assemble(&closure.rows, q, &free);
        if gap > CLOSED {
            return Err(open(
                closure,
                q,
                gap,
                f64::from(part - 1) / f64::from(PARTS),
            ));
        }
    }
    if closure.signs_at(q) != closure.signs {
        return Err(NoStart::OtherBranch);
    }
    let given = moving.iter().filter(|j| is_given(j) && !kept.contains(j));
    for p in given.map(|&j| position(j)) {
        agrees(p, false, (target[p], q[p]))?;
    }
    Ok(())
}

fn open(closure: &Closure, q: &[Dd], gap: f64, part: f64) -> NoStart {
    let (residuals, _) = closure.values(&closure.rows, q);
    let sizes = residuals.iter().map(|x| x.to_f64().abs());
    let worst = sizes.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
    let row = closure.rows[worst.map_or(0, |(row, _)| row)];
    NoStart::Open {
        closes: closure.loops[row.closes].name.clone(),
        row: row.name,
        gap,
        part,
    }
}

fn agrees(index: usize, velocity: bool, (given, closed): (Dd, Dd)) -> Result<(), NoStart> {
    let (given, closed) = (given.to_f64(), closed.to_f64());
    match (given - closed).abs() <= AGREES * f64::max(1.0, closed.abs()) {
        true => Ok(()),
        false => Err(NoStart::Contradicts {
            index,
            velocity,
            given,
            closed,
        }),
    }
}

/// Returns the independent velocities for given velocities of the open tree, by index; those that do not follow from
/// the given ones are 0.
pub(super) fn independent_velocities(
    closure: &Closure,
    q: &[Dd],
    given: &[(usize, Dd)],
) -> Result<Vec<Dd>, NoStart> {
    let n = closure.independents.len();
    let Some(map) = closure.velocity_map(q) else {
        return Err(NoStart::OtherBranch);
    };
    let mut u = vec![Dd::ZERO; n];
    let mut fixed = vec![false; n];
    let index = |j: usize| closure.independents.iter().position(|i| i.0 == j);
    for &(j, v) in given {
        if let Some(k) = index(j) {
            (u[k], fixed[k]) = (v, true);
        }
    }
    let of_dependents = || given.iter().filter(|(j, _)| index(*j).is_none());
    let along = |j: usize, u: &[Dd]| {
        let terms = map[j].iter().zip(u);
        terms.fold(Dd::ZERO, |sum, (s, u)| sum + *s * *u)
    };
    let free: Vec<usize> = (0..n).filter(|k| !fixed[*k]).collect();
    let rows = of_dependents().map(|&(j, _)| free.iter().map(|&k| map[j][k]).collect());
    let rows: Vec<Vec<Dd>> = rows.collect();
    let sides: Vec<Dd> = of_dependents().map(|&(j, v)| v - along(j, &u)).collect();
    let found = solve_basic(&rows, &sides, free.len());
    for (&k, x) in free.iter().zip(found) {
        u[k] = x;
    }
    for &(j, v) in of_dependents() {
        agrees(j, true, (v, along(j, &u)))?;
    }
    Ok(u)
}

/// Returns position and velocity of a coordinate, of a joint that follows others, or of one in a loop, in a state.
pub(super) fn motion_of(
    (mechanism, layout): (&Mechanism, &StateLayout),
    name: &str,
    (q, v): (&[Dd], &[Dd]),
) -> Option<(Option<Dd>, Dd)> {
    let Some(joint) = layout.dependent_named(name) else {
        return layout.motion_of(name, q, v);
    };
    let map = mechanism.closure()?.velocity_map(q)?;
    let terms = map[joint.velocity.0].iter().zip(v);
    let velocity = terms.fold(Dd::ZERO, |sum, (s, u)| sum + *s * *u);
    Some((Some(q[joint.position]), velocity))
}

/// Returns the fault of a start that does not exist; `location` is that of an entry of the file.
pub(super) fn fault(
    layout: &StateLayout,
    reason: &NoStart,
    location: impl Fn(&str) -> Location,
) -> Fault {
    match reason {
        NoStart::Open {
            closes,
            row,
            gap,
            part,
        } => wording::start_is_open(&location(""), (closes, row), *gap, *part),
        NoStart::OtherBranch => wording::start_on_other_branch(&location(""), &layout.loops),
        NoStart::Contradicts {
            index,
            velocity,
            given,
            closed,
        } => {
            let (name, unit) = match velocity {
                false => {
                    let position = &layout.positions[*index];
                    (position.name.as_str(), position.dimension.si())
                }
                true => rate(layout, *index),
            };
            wording::start_contradicts(&location(name), name, (*given, *closed), unit)
        }
    }
}

/// Returns name and unit of a velocity of the open tree.
fn rate(layout: &StateLayout, index: usize) -> (&str, &'static str) {
    let mut dependents = layout.dependents.iter();
    let dependent = dependents.find(|joint| joint.velocity.0 == index);
    dependent.map_or(("", ""), |joint| {
        (&joint.rate_name, joint.dimensions[1].si())
    })
}

//! Chooses the independent velocities.

use bgdyn_runtime::Dd;

use super::rank::Jacobian;
use crate::fault::{Faults, wording};
use crate::format::Spec;
use crate::math::Vec3;
use crate::mechanism::closure::{ChainStep, Closure, ClosureBlock, eliminate};
use crate::mechanism::{CoordinateId, Mechanism};

/// Smallest ratios of pivots of the dependent columns, at all sampled positions, that are tried: the first one that
/// a choice meets counts.
const RATIOS: [f64; 6] = [0.1, 0.03, 0.01, 1e-3, 1e-6, 1e-9];

/// Ratios that are tried before, where the first choice is singular at the start.
const BETTER_RATIOS: [f64; 2] = [0.5, 0.3];

/// The smallest ratio at the start with which the first choice stays, if another one is better there.
const LEAST_AT_START: f64 = 1e-3;

/// Returns the velocities that the file names as independent. `None` if a rule is broken.
pub(super) fn named(
    spec: &Spec,
    mechanism: &Mechanism,
    faults: &mut Faults,
) -> Option<Vec<CoordinateId>> {
    let names = mechanism.joint_names();
    let mut kept = Vec::new();
    for name in spec.independent.value().into_iter().flatten() {
        match names.iter().position(|known| *known == name.value) {
            Some(j) => kept.push(CoordinateId(j)),
            None => {
                let known: Vec<&str> = names.iter().map(String::as_str).collect();
                faults.push(wording::unknown_constrained_joint(
                    &name.location,
                    &name.value,
                    &known,
                ));
                return None;
            }
        }
    }
    Some(kept)
}

/// Sets the independent velocities, and one block of all dependent ones.
pub(super) fn choose(
    closure: &mut Closure,
    (spec, mechanism, kept): (&Spec, &Mechanism, &[CoordinateId]),
    faults: &mut Faults,
) -> Option<()> {
    let moving = closure.moving();
    let rows = closure.rows.len();
    let loops = spec.loops.given().map(|given| &given.location);
    let constraints = spec.constraints.given().map(|given| &given.location);
    let location = loops.or(constraints).unwrap_or(&spec.location);
    let names = mechanism.joint_names();
    if rows >= moving.len() && mechanism.nv() == moving.len() {
        faults.push(wording::nothing_left_to_move(location, rows, moving.len()));
        return None;
    }
    let jacobians: Vec<Jacobian> = closure
        .samples
        .iter()
        .map(|q| scaled(closure.solved_rates(q)))
        .collect();
    let fixed: Vec<usize> = moving
        .iter()
        .copied()
        .filter(|j| kept.contains(&CoordinateId(*j)))
        .collect();
    let free: Vec<usize> = moving
        .iter()
        .copied()
        .filter(|j| !kept.contains(&CoordinateId(*j)))
        .collect();
    let Some(more) = free.len().checked_sub(rows) else {
        let listed: Vec<&str> = fixed.iter().map(|&j| names[j].as_str()).collect();
        faults.push(wording::too_many_independents(
            location,
            &listed,
            moving.len() - rows,
        ));
        return None;
    };
    let at_start = scaled(closure.solved_rates(&closure.start));
    let Some(chosen) = regular_choice(&free, more, (jacobians, at_start)) else {
        let listed: Vec<&str> = fixed.iter().map(|&j| names[j].as_str()).collect();
        faults.push(wording::independents_do_not_determine(location, &listed));
        return None;
    };
    let dependents = without(&free, &chosen);
    closure.independents = (0..closure.positions.len())
        .filter(|j| !dependents.contains(j))
        .map(CoordinateId)
        .collect();
    choose_closers(closure, &dependents);
    closure.blocks = vec![ClosureBlock {
        rows: (0..rows).collect(),
        dependents: dependents.into_iter().map(CoordinateId).collect(),
    }];
    Some(())
}

/// Sets the dependent velocities along which positions close: those of the largest pivots of the rows with positions,
/// at the start. One of several displacements of a joint brings the others: their directions turn with the link.
fn choose_closers(closure: &mut Closure, dependents: &[usize]) {
    if !closure.nonholonomic() {
        return;
    }
    let (_, jacobian) = closure.values(&closure.position_rows(), &closure.start);
    let columns = |row: &Vec<Dd>| dependents.iter().map(|&j| row[j]).collect();
    let mut part: Vec<Vec<Dd>> = jacobian.iter().map(columns).collect();
    let (pivots, _) = eliminate(&mut part, dependents.len());
    let chosen: Vec<usize> = pivots.iter().map(|&(_, k)| dependents[k]).collect();
    let displacements = closure.compounds.iter().map(displacements);
    let displacements: Vec<Vec<usize>> = displacements.collect();
    let brought = |j: &usize| {
        let with_it = |all: &&Vec<usize>| all.contains(j);
        let mut joints = displacements.iter().filter(with_it).flatten();
        joints.any(|other| chosen.contains(other))
    };
    let closes = |j: &&usize| chosen.contains(j) || brought(j);
    closure.closers = dependents
        .iter()
        .filter(closes)
        .map(|&j| CoordinateId(j))
        .collect();
}

/// Returns the velocities of a joint along, not about, an axis.
fn displacements(joint: &ChainStep) -> Vec<usize> {
    let columns = joint.degrees.columns(joint.motion, joint.axis).into_iter();
    let still = |v: Vec3<Dd>| v.0.iter().all(|&x| x == Dd::ZERO);
    let along = columns.filter(|(_, column)| still(column.angular));
    along.map(|(j, _)| j.0).collect()
}

/// Returns `count` velocities that can be independent at all sampled positions: the first ones that are so at the start
/// as well, if there are any. The samples are closed positions at random, which may all be regular where the start is
/// singular: those of a ball, which starts at its neutral attitude.
fn regular_choice(
    free: &[usize],
    count: usize,
    (mut jacobians, at_start): (Vec<Jacobian>, Jacobian),
) -> Option<Vec<usize>> {
    let first = |jacobians: &[Jacobian], ratios: &[f64]| {
        let mut ratios = ratios.iter();
        ratios.find_map(|&ratio| first_choice(free, count, (jacobians, ratio)))
    };
    let usual = first(&jacobians, &RATIOS)?;
    if smallest_pivot(&at_start, &without(free, &usual)) >= LEAST_AT_START {
        return Some(usual);
    }
    jacobians.push(at_start);
    let better = first(&jacobians, &BETTER_RATIOS);
    let other = better.or_else(|| first(&jacobians, &RATIOS));
    Some(other.unwrap_or(usual))
}

fn without(all: &[usize], some: &[usize]) -> Vec<usize> {
    let others = all.iter().filter(|j| !some.contains(j));
    others.copied().collect()
}

/// Returns the first `count` velocities that can be independent: each, in the order of the links, whose removal leaves
/// columns with this ratio of pivots at all positions. `None` if there are fewer.
fn first_choice(
    free: &[usize],
    count: usize,
    (jacobians, ratio): (&[Jacobian], f64),
) -> Option<Vec<usize>> {
    let mut chosen: Vec<usize> = Vec::new();
    for &j in free {
        if chosen.len() == count {
            break;
        }
        let left: Vec<usize> = free
            .iter()
            .copied()
            .filter(|k| *k != j && !chosen.contains(k))
            .collect();
        if jacobians
            .iter()
            .all(|jacobian| smallest_pivot(jacobian, &left) >= ratio)
        {
            chosen.push(j);
        }
    }
    (chosen.len() == count
        && jacobians
            .iter()
            .all(|jacobian| smallest_pivot(jacobian, &without(free, &chosen)) >= ratio))
    .then_some(chosen)
}

/// Divides each row by its largest entry.
fn scaled(mut jacobian: Vec<Vec<Dd>>) -> Vec<Vec<Dd>> {
    for row in &mut jacobian {
        let largest = row.iter().map(|x| x.to_f64().abs()).fold(0.0, f64::max);
        if largest > 0.0 {
            row.iter_mut().for_each(|x| *x /= Dd::from_f64(largest));
        }
    }
    jacobian
}

/// Returns the ratio of the smallest pivot in these columns to the largest one; 0 if the rows depend on each other
/// there.
fn smallest_pivot(jacobian: &[Vec<Dd>], columns: &[usize]) -> f64 {
    let mut part: Vec<Vec<Dd>> = jacobian
        .iter()
        .map(|row| columns.iter().map(|&j| row[j]).collect())
        .collect();
    let (pivots, ratio) = eliminate(&mut part, columns.len());
    if pivots.len() < jacobian.len() {
        0.0
    } else {
        ratio
    }
}

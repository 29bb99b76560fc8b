//! Forces and moments of loops and contacts from the multipliers of their rows.

use bgdyn_runtime::Dd;

use super::loop_rows::plane_rows;
use super::subspaces::{ChainLoad, JointLoad, add_chain_loads};
use crate::bond_graph::{ClosedTree, LinkFrame};
use crate::expr::{Builder, Expr};
use crate::math::Vec3;
use crate::mechanism::closure::{Closure, KinematicLoop, LoopRow, RowKind, RowLoad};
use crate::mechanism::{CoordinateId, LinkId, Motion};

/// Returns the rows of a loop with their multipliers.
fn rows_of<'a, 'g>(
    closure: &'a Closure,
    closes: usize,
    lambda: &'a [Expr<'g>],
) -> impl Iterator<Item = (&'a LoopRow, Expr<'g>)> {
    let rows = closure.rows.iter().zip(lambda);
    rows.filter(move |(row, _)| row.closes == closes)
        .map(|(row, &x)| (row, x))
}

/// Returns Σ load · λ of a loop: force and moment in the axes of place a.
fn sum<'g>(
    b: &'g Builder,
    terms: impl Iterator<Item = (RowLoad<Expr<'g>>, Expr<'g>)>,
) -> JointLoad<'g> {
    let zero = Vec3([b.zero(); 3]);
    let none = JointLoad {
        force: zero,
        moment: zero,
    };
    terms.fold(none, |sum, (load, x)| JointLoad {
        force: sum.force + load.linear.scale(x),
        moment: sum.moment + load.angular.scale(x),
    })
}

/// Returns force and moment of each loop on place b about its origin, in the axes of the link of place a; of each wheel
/// and ball on it at its contact, in the axes of the contact; of each knife edge on it, in the axes of its link.
pub(super) fn reactions<'g>(
    b: &'g Builder,
    closure: &Closure,
    (q, lambda): (&[Expr<'g>], &[Expr<'g>]),
) -> Vec<Expr<'g>> {
    let reaction = |(closes, one): (usize, &KinematicLoop)| {
        let mut load = sum(b, std::iter::empty());
        let mut along = |k: usize, x: Expr<'g>| load.force.0[k] = load.force.0[k] + x;
        let at = plane_rows(b, (closure, closes), q);
        let mut turned = Vec::new();
        for (row, x) in rows_of(closure, closes, lambda) {
            match row.kind {
                RowKind::Contact(kind) if kind.contact_axis().is_some() => {
                    kind.contact_axis().into_iter().for_each(|k| along(k, x));
                }
                _ => turned.push((at.load(row.kind), x)),
            }
        }
        if !turned.is_empty() {
            let axes = one.chain.start.rotation.map(|x| b.constant(x));
            let own = sum(b, turned.into_iter());
            load.force = axes * own.force;
            load.moment = axes * own.moment;
        }
        load.force.0.into_iter().chain(load.moment.0)
    };
    let loops = closure.loops.iter().enumerate();
    loops.flat_map(reaction).collect()
}

/// Adds the loads of loops and contacts to those through the joints of the open tree, `entries`. `drives` are the
/// efforts of the drives at dependent joints, by velocity of the tree.
pub(super) fn add_to_joints<'g>(
    b: &'g Builder,
    closed: &ClosedTree,
    (q, lambda): (&[Expr<'g>], &[Expr<'g>]),
    drives: &[Expr<'g>],
    entries: &mut [Expr<'g>],
) {
    let closure = &closed.closure;
    let loops = closure.loops.iter().enumerate().map(|(closes, one)| {
        let at = plane_rows(b, (closure, closes), q);
        let rows = rows_of(closure, closes, lambda);
        let own = sum(b, rows.map(|(row, x)| (at.load(row.kind), x)));
        let axes = one.chain.start.rotation.map(|x| b.constant(x));
        let arm = b.vector(one.chain.start.translation) + axes * at.load_point();
        let (force, moment) = (axes * own.force, axes * own.moment);
        let moment = moment + arm.cross(force);
        // Multipliers of contacts are forces on place a.
        let (force, moment) = match one.contact {
            Some(_) => (-force, -moment),
            None => (force, moment),
        };
        ChainLoad {
            load: JointLoad { force, moment },
            steps: &one.chain.steps,
            beyond: beyond(closed, one),
        }
    });
    let loops: Vec<ChainLoad<'_, 'g>> = loops.collect();
    add_chain_loads(b, (&closed.tree, q), &loops, entries);
    for (at, j, sign) in free_components(closed) {
        entries[at] = drives[j.0] * b.constant(sign);
    }
}

/// Returns the components along free axes of dependent joints where that axis is one of the link's, each with its
/// velocity and the direction of the axis, 1 or −1: they are the efforts of the drives, zero without one.
fn free_components(closed: &ClosedTree) -> Vec<(usize, CoordinateId, Dd)> {
    let frames = &closed.tree.frames;
    let alone = |j: CoordinateId| {
        let moved = frames.iter().filter(|f| f.degrees.velocities.contains(&j));
        moved.count() == 1
    };
    let shown = frames.iter().filter(|frame| !frame.hidden).enumerate();
    let component = |(place, frame): (usize, &LinkFrame)| {
        let dependent = |j: &CoordinateId| closed.closure.dependents().any(|d| d == *j);
        let own = frame.coordinate.filter(|j| dependent(j) && alone(*j))?;
        let part = match frame.motion {
            Motion::Rotation => 3,
            Motion::Translation => 0,
            _ => return None,
        };
        let mut along = (0..3).filter(|&k| frame.axis.0[k] != Dd::ZERO);
        let only = along.next().filter(|_| along.next().is_none())?;
        Some((6 * place + part + only, own, frame.axis.0[only]))
    };
    shown.filter_map(component).collect()
}

/// Returns the links between the one that carries a wheel's axle and the wheel's own, which is the last one.
fn beyond(closed: &ClosedTree, one: &KinematicLoop) -> Vec<LinkId> {
    let frames = &closed.tree.frames;
    let carrier = one.chain.steps.first().and_then(|step| match step.outward {
        true => frames[step.link.0].parent,
        false => Some(step.link),
    });
    let mut links = Vec::new();
    let mut link = one.links[0].filter(|_| one.contact.is_some());
    while let (Some(own), true) = (link, link != carrier) {
        links.push(own);
        link = frames[own.0].parent;
    }
    links.reverse();
    links
}

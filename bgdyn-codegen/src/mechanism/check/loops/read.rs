//! Reads an entry of `loops`: names, places, and the chain of joints from place to place.

use bgdyn_runtime::Dd;

use super::branch::Branch;
use super::placed::{Context, loop_axis, placed};
use super::tree::Tree;
use super::{allowed, branch};
use crate::fault::{Faults, wording};
use crate::format::{Dimension, Located, LoopSpec, check_unit};
use crate::mechanism::closure::KinematicLoop;
use crate::mechanism::{Joint, LinkId, Motion, PositionId};

/// A loop of the file.
pub(super) struct ReadLoop {
    pub(super) closes: KinematicLoop,
    /// The branch that the file names, at the word.
    pub(super) branch: Option<Located<Branch>>,
    /// Whether it is a parallelogram without a branch.
    pub(super) parallelogram: bool,
    /// Positions to start from, with the names of their joints.
    pub(super) near: Vec<(PositionId, Dd, String)>,
    /// Whether its rows may follow from others.
    pub(super) redundant: bool,
    /// The gap by which rows that follow from others may be open, m or rad; 0 without the key.
    pub(super) tolerance: f64,
}

/// Reads a loop. `None` if a rule is broken.
pub(super) fn read(one: &LoopSpec, context: Context<'_>, faults: &mut Faults) -> Option<ReadLoop> {
    let tree = context.1;
    let placed = placed(one, context, faults)?;
    let near = near(one, tree, faults);
    let steps = placed.chain.steps.iter();
    let unsuited = steps.filter(|step| !is_suitable(tree, step.link));
    let unsuited: Vec<LinkId> = unsuited.map(|step| step.link).collect();
    for link in &unsuited {
        unsuitable(one, placed.name, tree, link.0, faults);
    }
    let axis = loop_axis(&placed.chain);
    let branch = branch::read(one, (&placed, tree, axis), faults);
    let redundant = allowed::redundant(one, faults);
    let tolerance = allowed::tolerance(one, faults);
    if !unsuited.is_empty() {
        return None;
    }
    let parallelogram = branch::is_parallelogram(one, (&placed, tree));
    Some(ReadLoop {
        closes: KinematicLoop {
            name: placed.name.to_owned(),
            kind: placed.kind,
            links: placed.links,
            chain: placed.chain,
            length: placed.length,
            axis,
            crossed: matches!(&branch, Some(word) if matches!(word.value, Branch::Crossed(_))),
            reversible: false,
            contact: None,
            location: one.location.clone(),
        },
        parallelogram,
        branch,
        near,
        redundant: redundant?,
        tolerance: tolerance?,
    })
}

/// Reads the positions to start from.
fn near(one: &LoopSpec, tree: Tree<'_>, faults: &mut Faults) -> Vec<(PositionId, Dd, String)> {
    let own = |joint: &&Joint| joint.degrees.own_positions() && joint.kind.one_degree();
    let all = || tree.links().iter().map(|link| &link.joint).filter(own);
    let mut found = Vec::new();
    for (name, number) in one.near.value().into_iter().flatten() {
        let joint = all().find(|joint| joint.name == name.value);
        let Some((joint, &position)) = joint.and_then(|j| Some((j, j.degrees.positions.first()?)))
        else {
            let names: Vec<&str> = all().map(|joint| joint.name.as_str()).collect();
            let fault = wording::unknown_constrained_joint(&name.location, &name.value, &names);
            faults.push(fault);
            continue;
        };
        let dimension = match joint.kind.motion {
            Motion::Translation => Dimension::Length,
            _ => Dimension::Angle,
        };
        match check_unit(number, &[dimension]) {
            Some(fault) => faults.push(fault),
            None => found.push((position, number.value.value, joint.name.clone())),
        }
    }
    found
}

/// Returns whether a loop can go through the joint: its velocities move no joint whose position is not a function of
/// its own.
fn is_suitable(tree: Tree<'_>, link: LinkId) -> bool {
    let joint = &tree.links()[link.0].joint;
    let coupling = joint.degrees.coupling.as_ref();
    let by_velocity = coupling.is_some_and(|coupling| !coupling.of_positions());
    !by_velocity
}

/// Reports a joint that no loop can go through.
fn unsuitable(one: &LoopSpec, name: &str, tree: Tree<'_>, link: usize, faults: &mut Faults) {
    let joint = &tree.links()[link].joint;
    faults.push(wording::loop_through_joint(
        &one.location,
        name,
        &joint.name,
        joint.kind.keyword,
    ));
}

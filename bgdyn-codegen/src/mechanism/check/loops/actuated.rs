//! The joints with drives: those that the file names.

use std::collections::BTreeSet;

use bgdyn_runtime::Dd;

use crate::fault::{Faults, wording};
use crate::format::{Located, Spec};
use crate::mechanism::closure::{Actuated, Closure, eliminate};
use crate::mechanism::{CoordinateId, LinkId, Mechanism, Motion};

/// A pivot below this ratio to the largest one is a rounding error.
const ROUNDING: f64 = 1e-18;

/// Refuses the key where no loop and no contact makes velocities dependent.
pub(super) fn refuse_without_loops(spec: &Spec, faults: &mut Faults) {
    if let Some(list) = spec.actuated.given() {
        faults.push(wording::actuated_without_loops(&list.location));
    }
}

/// Returns the joints that the file names as actuated; `None` if it names none, or breaks a rule.
pub(super) fn read(
    closure: &Closure,
    (spec, mechanism): (&Spec, &Mechanism),
    faults: &mut Faults,
) -> Option<Actuated> {
    let list = spec.actuated.given()?;
    if list.value.is_empty() {
        faults.push(wording::no_actuated_joint(&list.location));
        return None;
    }
    let mut joints = BTreeSet::new();
    let before = faults.count();
    for name in &list.value {
        let found = named(name, mechanism, faults);
        if found.is_some_and(|j| !joints.insert(j)) {
            faults.push(wording::actuated_twice(&name.location, &name.value));
        }
    }
    if faults.count() > before {
        return None;
    }
    let joints: Vec<CoordinateId> = joints.into_iter().collect();
    let efforts = efforts(&joints, mechanism);
    let actuated = Actuated { joints, efforts };
    if let Some((rank, following)) = lacking(closure, &actuated) {
        let names = mechanism.joint_names();
        let name = |j: &CoordinateId| names[j.0].as_str();
        let listed: Vec<&str> = actuated.joints.iter().map(name).collect();
        let following: Vec<&str> = following.iter().map(name).collect();
        faults.push(wording::actuated_do_not_determine(
            &list.location,
            (&listed, &following),
            (rank, closure.independents.len()),
        ));
        return None;
    }
    Some(actuated)
}

/// Returns the velocity with this name in the open tree.
fn named(
    name: &Located<String>,
    mechanism: &Mechanism,
    faults: &mut Faults,
) -> Option<CoordinateId> {
    let names = mechanism.joint_names();
    if let Some(j) = names.iter().position(|known| *known == name.value) {
        return Some(CoordinateId(j));
    }
    let mut joints = mechanism.links().iter().enumerate();
    let own = joints.find(|(_, link)| link.joint.name == name.value);
    faults.push(match own {
        Some((_, link)) if link.joint.degrees.coupling.is_some() => {
            let coupling = link.joint.degrees.coupling.as_ref();
            let leaders = coupling.map_or_else(Vec::new, |coupling| mechanism.leaders(coupling));
            let leaders: Vec<&str> = leaders.iter().map(String::as_str).collect();
            wording::actuated_follower(&name.location, &name.value, &leaders)
        }
        Some((i, _)) if mechanism.is_prescribed(LinkId(i)) => {
            wording::actuated_without_motion(&name.location, &name.value, "is prescribed")
        }
        Some((_, link)) if link.joint.kind.motion == Motion::None => {
            wording::actuated_without_motion(&name.location, &name.value, "does not move")
        }
        _ => {
            let known: Vec<&str> = names.iter().map(String::as_str).collect();
            wording::unknown_actuated_joint(&name.location, &name.value, &known)
        }
    });
    None
}

/// Returns the largest effort of each joint over the largest of all; 1 if one of them has none.
fn efforts(joints: &[CoordinateId], mechanism: &Mechanism) -> Vec<Dd> {
    let limit = |j: &CoordinateId| {
        let joint = mechanism.joint(*j);
        let single = joint.kind.motion.nv() == 1;
        joint.limits.effort.filter(|x| single && *x > 0.0)
    };
    let limits: Option<Vec<f64>> = joints.iter().map(limit).collect();
    let limits = limits.unwrap_or_else(|| vec![1.0; joints.len()]);
    let largest = limits.iter().copied().fold(0.0, f64::max);
    let share = |x: &f64| Dd::from_f64(*x) / Dd::from_f64(largest);
    limits.iter().map(share).collect()
}

/// Returns the rank of Aᵀ, and the joints whose rows follow from others, if there are at least as many joints as
/// velocities of the mechanism and the rank is less: the largest one at the sampled positions.
fn lacking(closure: &Closure, actuated: &Actuated) -> Option<(usize, Vec<CoordinateId>)> {
    let mobility = closure.independents.len();
    if actuated.joints.len() < mobility {
        return None;
    }
    let at = |q: &Vec<Dd>| {
        let mut rows = actuated.rows(&closure.velocity_map(q)?);
        let (mut pivots, _) = eliminate(&mut rows, mobility);
        let size = |&(row, column): &(usize, usize)| rows[row][column].to_f64().abs();
        let largest = pivots.iter().map(size).fold(0.0, f64::max);
        pivots.retain(|place| size(place) > ROUNDING * largest);
        let follows = |k: &usize| pivots.iter().all(|(row, _)| row != k);
        let following = (0..rows.len()).filter(follows);
        let following = following.map(|k| actuated.joints[k]).collect();
        Some((pivots.len(), following))
    };
    let ranks = closure.samples.iter().filter_map(at);
    ranks
        .max_by_key(|(rank, _)| *rank)
        .filter(|(rank, _)| *rank < mobility)
}

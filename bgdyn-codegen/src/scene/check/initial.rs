//! Checks the initial state of a scene.

use std::collections::BTreeMap;

use bgdyn_runtime::Dd;

use super::super::Initial;
use super::super::closed_start::{self, motion_of};
use super::pose;
use crate::declaration::RejectedEffects;
use crate::fault::{Faults, Location, wording};
use crate::format::{Dimension, Raw};
use crate::layout::StateLayout;
use crate::mechanism::Mechanism;
use crate::mechanism::closure::Closure;

/// The names of the joints that begin with a pose, and the positions that poses in the file set, each with
/// its joint.
type Poses<'a> = (Vec<&'a str>, Vec<(usize, &'a str)>);

/// A part of the state by its kind (0 position, 1 velocity, 2 first-order state, 3 mode) and index.
type ByKind = (usize, usize);

/// Reads the poses of spherical and floating joints.
fn poses<'a>(
    layout: &'a StateLayout,
    entries: &[Raw],
    initial: &mut Initial,
    faults: &mut Faults,
) -> Poses<'a> {
    let joints = || {
        layout
            .quasi_joints
            .iter()
            .filter(|j| j.quaternion.is_some())
    };
    let mut set = Vec::new();
    for joint in joints() {
        for raw in entries.iter().filter(|raw| raw.name.value == joint.name) {
            let own = pose::read(raw, joint, &mut initial.q, faults);
            set.extend(own.into_iter().map(|p| (p, joint.name.as_str())));
        }
    }
    (joints().map(|joint| joint.name.as_str()).collect(), set)
}

/// Returns the initial state.
pub(super) fn initial(
    (mechanism, layout): (&Mechanism, &StateLayout),
    entries: &[Raw],
    refused: &RejectedEffects,
    faults: &mut Faults,
) -> Initial {
    let mut initial = Initial {
        q: neutral(mechanism, layout),
        v: vec![Dd::ZERO; layout.nv()],
        x: vec![Dd::ZERO; layout.nx()],
        modes: vec![Dd::ZERO; layout.modes.len()],
    };
    let mut places: BTreeMap<String, (usize, usize, Dimension)> = BTreeMap::new();
    for (i, p) in layout.positions.iter().enumerate() {
        places.insert(p.name.clone(), (0, i, p.dimension));
    }
    for (j, c) in layout.coordinates.iter().enumerate() {
        places.insert(c.rate_name.clone(), (1, j, c.dimensions[1]));
    }
    let mut tree_velocities: Vec<(usize, Dd)> = Vec::new();
    for joint in &layout.dependents {
        let rate = (4, joint.velocity.0, joint.dimensions[1]);
        places.insert(joint.rate_name.clone(), rate);
    }
    for (i, part) in layout.states.iter().enumerate() {
        let given = part.entered.map_or(part.dimension, |e| e.dimension);
        places.insert(part.name.clone(), (2, i, given));
    }
    for (i, part) in layout.modes.iter().enumerate() {
        places.insert(format!("{}_mode", part.name), (3, i, part.dimension));
    }
    let (poses, posed) = poses(layout, entries, &mut initial, faults);
    let mut given: Vec<(usize, usize)> = posed.iter().map(|&(i, _)| (0, i)).collect();
    let mut refused_values = Vec::new();
    for raw in entries {
        let name = &raw.name.value;
        if poses.contains(&name.as_str()) {
            continue;
        }
        let Some(&(kind, i, dimension)) = places.get(name) else {
            if let Some((joint, leaders)) = layout.follower_of(name) {
                let at = &raw.name.location;
                faults.push(wording::initial_of_follower(at, name, (joint, &leaders)));
                continue;
            }
            let mut known: Vec<&str> = places.keys().map(String::as_str).collect();
            known.extend(&poses);
            let fault =
                wording::unknown_initial(&raw.name.location, name, &known, poses.first().copied());
            faults.push(match refused.may_bring(name) {
                true => fault.following(),
                false => fault,
            });
            continue;
        };
        if let Some((_, joint)) = posed.iter().find(|&&(p, _)| (0, p) == (kind, i)) {
            faults.push(wording::position_twice(&raw.name.location, name, joint));
            continue;
        }
        let number = raw.number(&[dimension], faults);
        if number.is_none() {
            refused_values.push((kind, i));
        }
        if let Some(number) = number {
            let value = number.value.value;
            given.push((kind, i));
            let entered = layout.states.get(i).filter(|_| kind == 2);
            if let Some(entered) = entered.and_then(|part| part.entered)
                && value < entered.least
            {
                let least = format!("{} {}", entered.least.to_f64(), entered.dimension.si());
                faults.push(wording::initial_below_least(
                    &number.location,
                    name,
                    (&number.value.text, &least),
                    entered.way_out,
                ));
            }
            match kind {
                0 => initial.q[i] = value,
                1 => initial.v[i] = value,
                2 => initial.x[i] = value,
                3 => initial.modes[i] = value,
                _ => tree_velocities.push((i, value)),
            }
        }
    }
    for (joint, length) in layout.unit_quaternions(&mut initial.q) {
        // A component that was refused makes a length that nobody wrote.
        if joint
            .positions
            .clone()
            .any(|p| refused_values.contains(&(0, p)))
        {
            continue;
        }
        let of_joint = |raw: &&Raw| {
            let name = &raw.name.value;
            *name == joint.name
                || layout.positions[joint.positions.clone()]
                    .iter()
                    .any(|p| p.name == *name)
        };
        let entry = entries.iter().find(of_joint);
        let location = entry.map_or_else(Location::file, |raw| raw.name.location.clone());
        let (name, any) = (&joint.name, joint.any_length);
        faults.push(wording::quaternion_length(&location, name, any, length));
    }
    if let Some(closure) = mechanism.closure().filter(|_| refused_values.is_empty()) {
        close(
            (closure, layout),
            &mut initial,
            (&given, tree_velocities),
            (entries, faults),
        );
    }
    // The default initial position and velocity of a drive are those of its joint.
    for (j, c) in layout.coordinates.iter().enumerate() {
        let name = c.starts_with.as_ref();
        let state = (&initial.q[..], &initial.v[..]);
        let with = name.and_then(|name| motion_of((mechanism, layout), name, state));
        let Some((position, velocity)) = with else {
            continue;
        };
        if let (Some(own), Some(position)) = (c.position, position)
            && !given.contains(&(0, own))
        {
            initial.q[own] = position;
        }
        if !given.contains(&(1, j)) {
            initial.v[j] = velocity;
        }
    }
    initial
}

/// Returns the positions at which all joints are neutral, with the mechanism's own closed positions of loops.
fn neutral(mechanism: &Mechanism, layout: &StateLayout) -> Vec<Dd> {
    let mut q: Vec<Dd> = layout.positions.iter().map(|p| p.neutral).collect();
    if let Some(closure) = mechanism.closure() {
        q[..closure.start.len()].copy_from_slice(&closure.start);
    }
    q
}

/// Closes the loops at the start. `given` are the positions and velocities of the file, by kind and index, and
/// velocities of dependent joints.
fn close(
    (closure, layout): (&Closure, &StateLayout),
    initial: &mut Initial,
    (given, dependents): (&[ByKind], Vec<(usize, Dd)>),
    (entries, faults): (&[Raw], &mut Faults),
) {
    let positions = given.iter().filter(|(kind, _)| *kind == 0).map(|&(_, p)| p);
    let positions: Vec<usize> = positions.collect();
    let in_tree = closure.start.len();
    let closed = closure.reach(&mut initial.q[..in_tree], &positions);
    let closed = closed.and_then(|()| {
        let own = given.iter().filter(|(kind, _)| *kind == 1);
        let own = own.filter_map(|&(_, j)| Some((closure.independents.get(j)?.0, initial.v[j])));
        let all: Vec<(usize, Dd)> = own.chain(dependents).collect();
        closure.independent_velocities(&initial.q[..in_tree], &all, &[])
    });
    match closed {
        Ok(u) => initial.v[..u.len()].copy_from_slice(&u),
        Err(reason) => {
            let location = |name: &str| {
                let entry = entries.iter().find(|raw| raw.name.value == name);
                let entry = entry.or(entries.first());
                entry.map_or_else(Location::file, |raw| raw.name.location.clone())
            };
            faults.push(closed_start::fault(layout, &reason, location));
        }
    }
}

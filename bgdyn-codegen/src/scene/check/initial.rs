//! Checks the initial state of a scene.

use std::collections::BTreeMap;

use bgdyn_runtime::Dd;

use super::super::Initial;
use super::pose;
use crate::declaration::RejectedEffects;
use crate::fault::{Faults, Location, wording};
use crate::format::{Dimension, Raw};
use crate::layout::{QuasiJoint, StateLayout};

/// Returns the initial state.
pub(super) fn initial(
    layout: &StateLayout,
    entries: &[Raw],
    refused: &RejectedEffects,
    faults: &mut Faults,
) -> Initial {
    let mut initial = Initial {
        q: layout.positions.iter().map(|p| p.neutral).collect(),
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
    for (i, part) in layout.states.iter().enumerate() {
        let given = part.entered.map_or(part.dimension, |e| e.dimension);
        places.insert(part.name.clone(), (2, i, given));
    }
    for (i, part) in layout.modes.iter().enumerate() {
        places.insert(format!("{}_mode", part.name), (3, i, part.dimension));
    }
    let mut given: Vec<(usize, usize)> = Vec::new();
    for raw in entries {
        let name = &raw.name.value;
        if let Some(joint) = layout.quasi_joints.iter().find(|j| j.name == *name)
            && joint.quaternion.is_some()
        {
            pose::read(raw, joint, &mut initial.q, faults);
            continue;
        }
        let Some(&(kind, i, dimension)) = places.get(name) else {
            let known: Vec<&str> = places.keys().map(String::as_str).collect();
            let fault = wording::unknown_initial(&raw.name.location, name, &known);
            faults.push(match refused.may_bring(name) {
                true => fault.following(),
                false => fault,
            });
            continue;
        };
        if let Some(number) = raw.number(&[dimension], faults) {
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
                _ => initial.modes[i] = value,
            }
        }
    }
    let place = |joint: &QuasiJoint| {
        let entry = entries
            .iter()
            .find(|raw| raw.name.value.starts_with(&joint.name));
        entry.map_or_else(Location::file, |raw| raw.name.location.clone())
    };
    faults.0.extend(
        layout
            .unit_quaternions(&mut initial.q)
            .into_iter()
            .map(|(joint, length)| wording::quaternion_length(&place(joint), &joint.name, length)),
    );
    // The default initial position and velocity of a drive are those of its joint.
    for (j, c) in layout.coordinates.iter().enumerate() {
        let with = c
            .starts_with
            .as_ref()
            .and_then(|name| layout.coordinate_named(name));
        let Some(k) = with else { continue };
        if let (Some(own), Some(other)) = (c.position, layout.coordinates[k].position)
            && !given.contains(&(0, own))
        {
            initial.q[own] = initial.q[other];
        }
        if !given.contains(&(1, j)) {
            initial.v[j] = initial.v[k];
        }
    }
    initial
}

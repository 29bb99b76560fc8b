//! Checks that the joints whose motion a scene computes torques for determine that motion.

use super::super::signal::InputSource;
use crate::fault::{Faults, wording};
use crate::format::Raw;
use crate::layout::StateLayout;
use crate::mechanism::{CoordinateId, Mechanism};

/// Refuses computed torques of joints in loops if their accelerations do not follow from one set of independent
/// accelerations, or leave some of these open: as many of them as independent velocities that move them, without those
/// that are followed themselves.
pub(super) fn check(
    (mechanism, layout): (&Mechanism, &StateLayout),
    drives: &[InputSource],
    inputs: &[Raw],
    faults: &mut Faults,
) {
    let Some(closure) = mechanism.closure() else {
        return;
    };
    let parts = layout.inputs.iter().zip(drives);
    let followed = parts.filter(|(_, drive)| matches!(drive, InputSource::ComputedTorque { .. }));
    let mut dependents: Vec<usize> = Vec::new();
    let mut independents: Vec<usize> = Vec::new();
    for (part, _) in followed {
        dependents.extend(part.drives_dependent);
        independents.extend(part.drives);
    }
    let Some(&first) = dependents.first() else {
        return;
    };
    let name = |&d: &usize| layout.dependents[d].name.as_str();
    let names: Vec<&str> = dependents.iter().map(name).collect();
    let joints: Vec<CoordinateId> = dependents
        .iter()
        .map(|&d| layout.dependents[d].velocity)
        .collect();
    let movers = closure.movers(&joints);
    let left: Vec<usize> = movers
        .into_iter()
        .filter(|k| !independents.contains(k))
        .collect();
    let ways: Vec<&str> = left
        .iter()
        .map(|&k| layout.coordinates[k].name.as_str())
        .collect();
    let raw = inputs.iter().find(|raw| raw.name.value == name(&first));
    let Some(raw) = raw else { return };
    let location = &raw.name.location;
    if names.len() != ways.len() {
        faults.push(wording::followed_joints_do_not_fit(location, &names, &ways));
        return;
    }
    let rank = closure.rank_along(&joints, &left);
    if rank < names.len() {
        faults.push(wording::followed_joints_do_not_determine(
            location,
            (&names, &ways),
            rank,
        ));
    }
}

//! Parses the initial pose of a spherical or floating joint.
//!
//! It is `free: { xyz: […], rpy: […] }`, with `quaternion` in place of `rpy`.

use bgdyn_runtime::Dd;

use super::super::quaternion_of_rpy;
use crate::fault::wording::expected;
use crate::fault::{Faults, wording};
use crate::format::{Dimension, Raw};
use crate::layout::QuasiJoint;

/// Writes the positions of a joint's initial pose. Returns those that the entry sets.
pub(super) fn read(raw: &Raw, joint: &QuasiJoint, q: &mut [Dd], faults: &mut Faults) -> Vec<usize> {
    let mut set = Vec::new();
    let Some(quaternion) = joint.quaternion else {
        return set;
    };
    let moves = quaternion > joint.positions.start;
    let example = match moves {
        true => expected::POSE,
        false => expected::ROTATION,
    };
    let known: &[&str] = match moves {
        true => &["xyz", "rpy", "quaternion"],
        false => &["rpy", "quaternion"],
    };
    let mut oriented = false;
    for entry in raw.entries(("the pose of a joint", example), faults) {
        let key = entry.name.value.as_str();
        let location = &entry.name.location;
        if !known.contains(&key) {
            faults.push(wording::unknown_pose_key(location, key, known));
            continue;
        }
        if key != "xyz" && std::mem::replace(&mut oriented, true) {
            faults.push(wording::orientation_twice(location, &joint.name));
            continue;
        }
        set.extend(match key {
            "xyz" => joint.positions.start..quaternion,
            _ => quaternion..quaternion + 4,
        });
        match key {
            "xyz" => {
                if let Some(xyz) = numbers::<3>(&entry, Dimension::Length, faults) {
                    q[joint.positions.start..quaternion].copy_from_slice(&xyz);
                }
            }
            "rpy" => {
                if let Some(rpy) = numbers::<3>(&entry, Dimension::Angle, faults) {
                    q[quaternion..quaternion + 4].copy_from_slice(&quaternion_of_rpy(rpy));
                }
            }
            _ => {
                if let Some(given) = numbers::<4>(&entry, Dimension::One, faults) {
                    q[quaternion..quaternion + 4].copy_from_slice(&given);
                }
            }
        }
    }
    set
}

/// Returns the numbers of a list of this length.
fn numbers<const N: usize>(
    entry: &Raw,
    dimension: Dimension,
    faults: &mut Faults,
) -> Option<[Dd; N]> {
    let example = match N {
        3 => expected::THREE_NUMBERS,
        _ => expected::QUATERNION,
    };
    let items = entry.items(("a list of numbers", example), faults)?;
    if items.len() != N {
        let location = &entry.location;
        faults.push(wording::not_so_many_numbers(
            location,
            items.len(),
            N,
            example,
        ));
        return None;
    }
    let mut found = [Dd::ZERO; N];
    for (to, item) in found.iter_mut().zip(&items) {
        *to = item.number(&[dimension], faults)?.value.value;
    }
    Some(found)
}

//! Reads the controllers that hold the pose of a joint with quasi-velocities.
//!
//! Their keys are `free: { hold: { position: …, attitude: … } }`.

use std::ops::Range;

use bgdyn_runtime::{Dd, QuasiJointKind};

use super::super::quaternion_of_rpy;
use super::super::signal::{self, HOLD, InputSource, PoseHold, PoseTarget};
use super::super::waveform::Waveform;
use crate::fault::wording::expected;
use crate::fault::{Faults, wording};
use crate::format::{Dimension, Raw};
use crate::layout::{QuasiJoint, StateLayout};

/// An input of a joint, by its coordinate, and what drives it.
pub(super) type Driven = (usize, InputSource);

/// A part of a pose that a joint holds.
struct Part {
    /// Its key.
    key: &'static str,
    /// Its coordinates among those of the joint.
    coordinates: Range<usize>,
    /// The dimensions of stiffness and damping.
    gains: [Dimension; 2],
}

/// A component of a quaternion below this is a zero that the rounding of π has missed.
const ROUNDED: f64 = 1e-30;

const LINEAR: [Dimension; 2] = [Dimension::Stiffness, Dimension::Damping];
const ANGULAR: [Dimension; 2] = [Dimension::AngularStiffness, Dimension::AngularDamping];

impl Part {
    const fn new(key: &'static str, coordinates: Range<usize>, gains: [Dimension; 2]) -> Self {
        Part {
            key,
            coordinates,
            gains,
        }
    }
}

/// Returns the parts of a joint's pose.
fn parts(joint: &QuasiJoint) -> Vec<Part> {
    match joint.kind {
        QuasiJointKind::Planar => vec![
            Part::new("position", 0..2, LINEAR),
            Part::new("angle", 2..3, ANGULAR),
        ],
        QuasiJointKind::Spherical => vec![Part::new("attitude", 0..3, ANGULAR)],
        QuasiJointKind::Floating => vec![
            Part::new("position", 0..3, LINEAR),
            Part::new("attitude", 3..6, ANGULAR),
        ],
    }
}

/// Returns an example of what a joint holds.
fn example(joint: &QuasiJoint) -> &'static str {
    match joint.kind {
        QuasiJointKind::Planar => expected::HOLD_OF_ANGLE,
        _ => expected::HOLD_OF_ATTITUDE,
    }
}

/// Returns the coordinates whose efforts an entry of this joint drives; mistakes are reported by [`read`].
pub(super) fn driven(raw: &Raw, joint: &QuasiJoint, layout: &StateLayout) -> Vec<usize> {
    if !joint.is_independent(layout) {
        return vec![];
    }
    let mut unread = Faults::default();
    let entries = raw.entries(("", ""), &mut unread).into_iter();
    let holds = entries.filter(|entry| entry.name.value == HOLD);
    let keys = holds.flat_map(|hold| hold.entries(("", ""), &mut unread));
    let keys: Vec<String> = keys.map(|key| key.name.value).collect();
    let all = parts(joint).into_iter();
    let held = all.filter(|part| keys.iter().any(|key| key == part.key));
    let of_joint = |k: usize| joint.coordinates.start + k;
    held.flat_map(|part| part.coordinates.map(of_joint))
        .collect()
}

/// Returns what drives the efforts of a joint.
pub(super) fn read(
    raw: &Raw,
    joint: &QuasiJoint,
    layout: &StateLayout,
    faults: &mut Faults,
) -> Vec<Driven> {
    if !joint.is_independent(layout) {
        let location = &raw.name.location;
        faults.push(wording::hold_of_constrained(location, &joint.name));
        return vec![];
    }
    let example = example(joint);
    let entries = match raw.is_mapping() {
        true => raw.entries(("what drives the joint", example), faults),
        false => vec![],
    };
    let only = match entries.as_slice() {
        [only] if only.name.value == HOLD => only,
        _ => {
            let kind = keyword(joint);
            let first = &layout.coordinates[joint.coordinates.start].name;
            faults.push(wording::not_a_hold(
                &raw.name.location,
                (&joint.name, kind),
                first,
                example,
            ));
            return vec![];
        }
    };
    let all = parts(joint);
    let known: Vec<&'static str> = all.iter().map(|part| part.key).collect();
    let given = only.entries(("what a joint is held at", example), faults);
    if given.is_empty() {
        faults.push(wording::hold_of_nothing(&only.location, &known));
    }
    let mut found = Vec::new();
    for entry in &given {
        let key = entry.name.value.as_str();
        match all.iter().find(|part| part.key == key) {
            Some(part) => found.extend(held(entry, part, (joint, layout), faults)),
            None => faults.push(wording::unknown_part_of_pose(
                &entry.name.location,
                key,
                (&joint.name, keyword(joint)),
                &known,
            )),
        }
    }
    found
}

/// Returns the word of the joint's type.
fn keyword(joint: &QuasiJoint) -> &'static str {
    match joint.kind {
        QuasiJointKind::Planar => "planar",
        QuasiJointKind::Spherical => "spherical",
        QuasiJointKind::Floating => "floating",
    }
}

/// Reads one part of a pose: target and gains.
fn held(
    raw: &Raw,
    part: &Part,
    (joint, layout): (&QuasiJoint, &StateLayout),
    faults: &mut Faults,
) -> Vec<Driven> {
    let shown = expected::HOLD;
    let count = part.coordinates.len();
    let (mut target, mut broken) = (None, false);
    let mut gains = [None, Some(vec![Dd::ZERO; count])];
    for entry in &raw.entries(("what is held", shown), faults) {
        match entry.name.value.as_str() {
            "target" => {
                target = self::target(entry, part, (joint, layout), faults);
                broken |= target.is_none();
            }
            key @ ("stiffness" | "damping") => {
                let k = usize::from(key == "damping");
                gains[k] = self::gains(entry, count, part.gains[k], faults);
                broken |= gains[k].is_none();
            }
            other => {
                let known = &["target", "stiffness", "damping"];
                faults.push(wording::unknown_key(&entry.name.location, other, known));
                broken = true;
            }
        }
    }
    if let (Some(target), [Some(stiffness), Some(damping)]) = (&target, &gains) {
        let source = |k: usize| match target {
            Target::Pose(target) => {
                let hold = PoseHold {
                    joint: joint.clone(),
                    target: target.clone(),
                    stiffness: stiffness.clone(),
                    damping: damping.clone(),
                };
                InputSource::Hold(Box::new(hold), k)
            }
            Target::Angle(target) => InputSource::Pd {
                target: target.clone(),
                stiffness: stiffness[k],
                damping: damping[k],
            },
        };
        let first = joint.coordinates.start + part.coordinates.start;
        return (0..count).map(|k| (first + k, source(k))).collect();
    }
    let missing = [
        ("target", target.is_none()),
        ("stiffness", gains[0].is_none()),
    ];
    for (key, _) in missing.into_iter().filter(|(_, none)| *none && !broken) {
        faults.push(wording::hold_without_key(&raw.location, part.key, key));
    }
    vec![]
}

/// What a part of a pose is held at.
enum Target {
    Pose(PoseTarget),
    /// The angle of a planar joint.
    Angle(Waveform),
}

fn target(
    raw: &Raw,
    part: &Part,
    (joint, layout): (&QuasiJoint, &StateLayout),
    faults: &mut Faults,
) -> Option<Target> {
    match part.key {
        "angle" => signal::signal(raw, Dimension::Angle, faults).map(Target::Angle),
        "position" => {
            let courses = courses(raw, part.coordinates.len(), Dimension::Length, faults)?;
            Some(Target::Pose(PoseTarget::Position(courses)))
        }
        _ => orientation(raw, joint, layout, faults).map(Target::Pose),
    }
}

/// Reads `{ rpy: […] }` or `{ quaternion: […] }`.
fn orientation(
    raw: &Raw,
    joint: &QuasiJoint,
    layout: &StateLayout,
    faults: &mut Faults,
) -> Option<PoseTarget> {
    let entries = raw.entries(expected::ORIENTATION, faults);
    let [only] = entries.as_slice() else {
        faults.push(wording::not_one_orientation(&raw.location));
        return None;
    };
    match only.name.value.as_str() {
        "rpy" => {
            let courses = courses(only, 3, Dimension::Angle, faults)?;
            let courses: [Waveform; 3] = courses.try_into().ok()?;
            let fixed = courses.each_ref().map(|course| match course {
                Waveform::Constant(x) => Some(*x),
                _ => None,
            });
            Some(match fixed {
                [Some(x), Some(y), Some(z)] => {
                    let exact = |x: Dd| match x.to_f64().abs() < ROUNDED {
                        true => Dd::ZERO,
                        false => x,
                    };
                    PoseTarget::Quaternion(quaternion_of_rpy([x, y, z]).map(exact))
                }
                _ => PoseTarget::Rpy(courses),
            })
        }
        "quaternion" => quaternion(only, joint, layout, faults).map(PoseTarget::Quaternion),
        other => {
            let known = &["rpy", "quaternion"];
            faults.push(wording::unknown_key(&only.name.location, other, known));
            None
        }
    }
}

/// Reads a quaternion under the rule for those of the start.
fn quaternion(
    raw: &Raw,
    joint: &QuasiJoint,
    layout: &StateLayout,
    faults: &mut Faults,
) -> Option<[Dd; 4]> {
    let items = items(raw, 4, "x, y, z, w: `[0, 0, 0, 1]`", faults)?;
    let first = joint.quaternion?;
    let mut positions: Vec<Dd> = layout.positions.iter().map(|p| p.neutral).collect();
    for (to, item) in positions[first..].iter_mut().zip(&items) {
        *to = item.number(&[Dimension::One], faults)?.value.value;
    }
    if let Some((joint, length)) = layout.unit_quaternions(&mut positions).pop() {
        let (name, any) = (&joint.name, joint.any_length);
        faults.push(wording::target_quaternion_length(
            &raw.location,
            name,
            any,
            length,
        ));
        return None;
    }
    positions[first..first + 4].try_into().ok()
}

/// Reads courses in time: a list of this length.
fn courses(
    raw: &Raw,
    count: usize,
    dimension: Dimension,
    faults: &mut Faults,
) -> Option<Vec<Waveform>> {
    let example = match count {
        2 => expected::TWO_NUMBERS,
        _ => expected::THREE_NUMBERS,
    };
    let items = items(raw, count, example, faults)?;
    let read = items
        .iter()
        .map(|item| signal::signal(item, dimension, faults));
    // Every item is read, so that all mistakes are reported.
    let read: Vec<Option<Waveform>> = read.collect();
    read.into_iter().collect()
}

/// Returns the items of a list of this length.
fn items(raw: &Raw, count: usize, example: &str, faults: &mut Faults) -> Option<Vec<Raw>> {
    let items = raw.items(("a list", example), faults)?;
    if items.len() == count {
        return Some(items);
    }
    let (location, found) = (&raw.location, items.len());
    faults.push(wording::target_of_other_length(
        location, found, count, example,
    ));
    None
}

/// Reads one gain for all axes, or a list of one for each.
fn gains(raw: &Raw, count: usize, fit: Dimension, faults: &mut Faults) -> Option<Vec<Dd>> {
    let key = raw.name.value.as_str();
    let one = |raw: &Raw, faults: &mut Faults| {
        let number = raw.number(&[fit], faults)?.value;
        if number.value < Dd::ZERO {
            faults.push(wording::negative_gain(&raw.location, key, &number.text));
            return None;
        }
        Some(number.value)
    };
    if !raw.is_list() {
        return one(raw, faults).map(|gain| vec![gain; count]);
    }
    let items = items(raw, count, "one for each axis: `[8, 8, 4]`", faults)?;
    let read: Vec<Option<Dd>> = items.iter().map(|item| one(item, faults)).collect();
    read.into_iter().collect()
}

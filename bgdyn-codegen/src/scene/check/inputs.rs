//! Checks the inputs of a scene and their sources.

use super::super::signal::{self, InputSource};
use super::hold;
use crate::declaration::RejectedEffects;
use crate::fault::{Faults, wording};
use crate::format::Raw;
use crate::layout::{Level, QuasiJoint, StateCoordinate, StateLayout};

/// Adds as inputs the drives of coordinates that the scene names, or whose pose it holds.
pub(super) fn add_efforts(layout: &mut StateLayout, inputs: &[Raw]) {
    for raw in inputs {
        let names = match joint_of(layout, raw) {
            Some(joint) => {
                let driven = hold::driven(raw, joint, layout).into_iter();
                driven.map(|j| layout.coordinates[j].name.clone()).collect()
            }
            None => vec![raw.name.value.clone()],
        };
        for name in names {
            let known = layout.inputs.iter().any(|input| input.name == name);
            let own = |c: &StateCoordinate| c.name == name && c.moves();
            if !known && layout.coordinates.iter().any(own) {
                let about = format!("effort at `{name}`");
                layout.drive(name.clone(), &name, &name, about);
                continue;
            }
            let dependent = layout
                .dependents
                .iter()
                .position(|joint| joint.name == name);
            if let Some(joint) = dependent.filter(|_| !known) {
                layout.drive_dependent(joint, format!("effort at `{name}`"));
            }
        }
    }
}

/// Returns the prescribed joint of which an input is the rate or the acceleration.
fn derivative_of<'a>(layout: &'a StateLayout, input: &str) -> Option<&'a str> {
    let is = |joint: &&String| {
        let levels = [Level::Rate, Level::Acceleration];
        levels.iter().any(|level| level.name(joint) == input)
    };
    layout.prescribed.iter().find(is).map(String::as_str)
}

/// Returns the joint with quasi-velocities that an entry drives as a whole.
fn joint_of<'a>(layout: &'a StateLayout, raw: &Raw) -> Option<&'a QuasiJoint> {
    let name = &raw.name.value;
    let input = layout.inputs.iter().any(|input| input.name == *name);
    let mut joints = layout.quasi_joints.iter();
    joints.find(|joint| joint.name == *name && !input)
}

/// Returns the inputs that the entries of whole joints drive, each with its joint, and sets their sources.
fn holds<'a>(
    layout: &'a StateLayout,
    inputs: &[Raw],
    drives: &mut [InputSource],
    faults: &mut Faults,
) -> Vec<(usize, &'a str)> {
    let mut held = Vec::new();
    for raw in inputs {
        let Some(joint) = joint_of(layout, raw) else {
            continue;
        };
        for (j, source) in hold::read(raw, joint, layout, faults) {
            let name = &layout.coordinates[j].name;
            if let Some(i) = layout.inputs.iter().position(|part| part.name == *name) {
                drives[i] = source;
                held.push((i, joint.name.as_str()));
            }
        }
    }
    held
}

/// Returns the source of each input.
pub(super) fn drives(
    layout: &StateLayout,
    inputs: &[Raw],
    refused: &RejectedEffects,
    faults: &mut Faults,
) -> Vec<InputSource> {
    let mut drives = vec![InputSource::Given; layout.inputs.len()];
    let held = holds(layout, inputs, &mut drives, faults);
    for raw in inputs.iter().filter(|raw| joint_of(layout, raw).is_none()) {
        let name = &raw.name.value;
        let Some(i) = layout.inputs.iter().position(|part| part.name == *name) else {
            let known: Vec<&str> = layout.inputs.iter().map(|p| p.name.as_str()).collect();
            let efforts = layout.coordinates.iter().filter(|c| c.moves());
            let joints = layout.quasi_joints.iter().map(|joint| joint.name.as_str());
            let others = efforts
                .map(|c| c.name.as_str())
                .chain(layout.dependents.iter().map(|joint| joint.name.as_str()))
                .chain(joints);
            // The effort of a driven joint is an input already.
            let mut all = known;
            for name in others {
                if !all.contains(&name) {
                    all.push(name);
                }
            }
            let fault = wording::unknown_input(&raw.name.location, name, &all);
            faults.push(match refused.may_bring(name) {
                true => fault.following(),
                false => fault,
            });
            continue;
        };
        if let Some((_, joint)) = held.iter().find(|(held, _)| *held == i) {
            faults.push(wording::input_held_too(&raw.name.location, name, joint));
            continue;
        }
        if let Some(joint) = derivative_of(layout, name) {
            faults.push(wording::rate_of_prescribed(&raw.name.location, name, joint));
            continue;
        }
        let part = &layout.inputs[i];
        let follows = part.follows.as_ref().map(|name| layout.position_of(name));
        let effort = part.drives.is_some_and(|j| layout.coordinates[j].moves());
        let effort = effort || part.drives_dependent.is_some();
        if let Some(drive) = signal::drive(raw, part.dimension, follows, effort, faults) {
            let followed = part.follows.as_ref();
            let quasi = followed.filter(|name| {
                let found = layout.coordinate_named(name);
                found.is_some_and(|j| layout.coordinates[j].is_quasi_velocity())
            });
            let dependent = followed.and_then(|name| layout.dependent_named(name));
            let dependent = dependent.filter(|joint| joint.position.is_none());
            if let (Some(joint), true) = (dependent, drive.is_controller()) {
                let location = &raw.name.location;
                faults.push(wording::controller_of_dependent(location, &joint.name));
                continue;
            }
            if let (Some(velocity), true) = (quasi, drive.is_controller()) {
                let location = &raw.name.location;
                let index = layout.coordinate_named(velocity).unwrap_or_default();
                let mut joints = layout.quasi_joints.iter();
                let joint = joints.find(|joint| joint.coordinates.contains(&index));
                let joint = joint.map_or("", |joint| &joint.name);
                faults.push(wording::controller_of_quasi_velocity(
                    location, velocity, joint,
                ));
                continue;
            }
            if let InputSource::Waveform(course) = &drive
                && course.rate_jumps()
                && layout.prescribed.contains(name)
            {
                let (location, step) = (&raw.location, course.jumps());
                faults.push(wording::prescribed_with_corners(location, name, step));
                continue;
            }
            drives[i] = drive;
        }
    }
    // A reference's derivatives follow from its signal: first its rate, then the rate of its rate.
    for (name, of) in [("_acceleration", "_rate"), ("_rate", "")] {
        for i in 0..drives.len() {
            let base = layout.inputs[i].name.strip_suffix(name);
            let base = base.map(|base| format!("{base}{of}"));
            let found = |base: String| layout.inputs.iter().position(|p| p.name == base);
            if let (Some(base), InputSource::Given) = (base.and_then(found), &drives[i]) {
                drives[i] = InputSource::RateOf(base);
            }
        }
    }
    // The caller also provides the derivatives of inputs that the caller provides.
    for i in 0..drives.len() {
        let mut root = i;
        while let InputSource::RateOf(base) = drives[root] {
            root = base;
        }
        if drives[root] == InputSource::Given {
            drives[i] = InputSource::Given;
        }
    }
    drives
}

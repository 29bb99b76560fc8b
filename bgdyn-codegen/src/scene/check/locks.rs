//! Checks the locked joints of a scene.

use bgdyn_runtime::Dd;

use super::super::closed_start;
use super::{effects, joints, state};
use crate::fault::{Fault, Faults, Location, wording};
use crate::format::{Located, SceneSpec};
use crate::machine::{Machine, NotLocked};
use crate::mechanism::{Joint, LinkId, Mechanism, Motion};

/// Returns the mechanism of the machine with the joints locked that the scene locks. Faults are those of the entries,
/// and of loops that do not close with the joints there.
pub(super) fn locked(spec: &SceneSpec, machine: &Machine, faults: &mut Faults) -> Mechanism {
    let locks = locks(spec, &machine.mechanism, faults);
    let all: Vec<(LinkId, Dd)> = locks.iter().map(|(link, at, _)| (*link, *at)).collect();
    machine.locked(&all).unwrap_or_else(|reason| {
        let entry = |name: &str| locks.iter().find(|(_, _, entry)| entry.value == name);
        let first = effects::given(&spec.lock).first().map(|raw| &raw.name);
        let place = |name: &str| entry(name).map(|(.., entry)| entry).or(first);
        let location = |name: &str| place(name).map_or_else(Location::file, |n| n.location.clone());
        match reason {
            NotLocked::Unreached(reason) => {
                let layout = state::layout(&machine.mechanism, &[]);
                faults.push(closed_start::fault(&layout, &reason, location));
            }
            NotLocked::Refused(found) => {
                let why = found.0.first().map_or("", |fault| &fault.message);
                let names: Vec<&str> = locks.iter().map(|(.., name)| name.value.as_str()).collect();
                faults.push(wording::locks_contradict(&location(""), &names, why));
            }
        }
        machine.mechanism.clone()
    })
}

/// Returns the links whose joints are locked, with the positions of the joints, and their names in the file.
fn locks(
    spec: &SceneSpec,
    mechanism: &Mechanism,
    faults: &mut Faults,
) -> Vec<(LinkId, Dd, Located<String>)> {
    let mut locked = Vec::new();
    for raw in effects::given(&spec.lock) {
        let name = &raw.name.value;
        let mut links = mechanism.links().iter().map(|link| &link.joint).enumerate();
        match links.find(|(_, joint)| joint.name == *name && lockable(joint)) {
            Some((link, joint)) => {
                let [position, ..] = joints::dimensions(joint.kind.motion == Motion::Translation);
                let at = raw.number(&[position], faults);
                locked.extend(at.map(|at| (LinkId(link), at.value.value, raw.name.clone())));
            }
            None => faults.push(not_lockable(mechanism, &raw.name.location, name)),
        }
    }
    locked
}

/// Returns whether a joint has one degree and follows no other: also a dependent one of loops, and a prescribed one, of
/// whose motion `lock` is the constant case.
fn lockable(joint: &Joint) -> bool {
    joint.kind.motion.nv() == 1 && joint.degrees.coupling.is_none()
}

/// Returns the fault of a name that is not that of a joint with coordinates: a velocity of a joint with
/// several, a follower, or unknown.
fn not_lockable(mechanism: &Mechanism, location: &Location, name: &str) -> Fault {
    let names = mechanism.joint_names();
    if let Some(j) = names.iter().position(|own| own == name) {
        let joint = &mechanism.links()[mechanism.coordinates()[j].0].joint;
        return wording::lock_of_several(location, &joint.name, joint.kind.keyword);
    }
    let mut joints = mechanism.links().iter().map(|link| &link.joint);
    let found = joints.find(|joint| joint.name == name);
    if let Some(joint) = found.filter(|joint| joint.kind.motion.nv() > 1) {
        return wording::lock_of_several(location, name, joint.kind.keyword);
    }
    if let Some(coupling) = found.and_then(|joint| joint.degrees.coupling.as_ref()) {
        return wording::lock_of_follower(location, name, &mechanism.leaders(coupling));
    }
    let joints = mechanism.links().iter().map(|link| &link.joint);
    let known = joints.filter(|joint| lockable(joint));
    let known: Vec<&str> = known.map(|joint| joint.name.as_str()).collect();
    wording::unknown_locked_joint(location, name, &known)
}

//! Checks the locked joints of a scene.

use bgdyn_runtime::Dd;

use super::{effects, joints};
use crate::fault::{Fault, Faults, Location, wording};
use crate::format::{Dimension, SceneSpec};
use crate::mechanism::{LinkId, Mechanism, Motion};

/// Returns the links whose joints are locked, with the positions of the joints.
pub(super) fn locks(
    spec: &SceneSpec,
    mechanism: &Mechanism,
    faults: &mut Faults,
) -> Vec<(LinkId, Dd)> {
    let mut locked = Vec::new();
    if let (Some(closure), Some(raw)) = (mechanism.closure(), effects::given(&spec.lock).first()) {
        let loops: Vec<&str> = closure.loops.iter().map(|one| one.name.as_str()).collect();
        let name = &raw.name;
        faults.push(wording::lock_with_loops(
            &name.location,
            &name.value,
            &loops,
        ));
        return locked;
    }
    for raw in effects::given(&spec.lock) {
        let name = &raw.name.value;
        let links = mechanism.coordinates().iter().copied();
        let found = links
            .enumerate()
            .find(|(_, l)| mechanism.links()[l.0].joint.name == *name);
        let Some((j, link)) = found else {
            // `lock` is the constant case of a prescribed motion.
            match prescribed(mechanism, name) {
                Some((link, position)) => {
                    let at = raw.number(&[position], faults);
                    locked.extend(at.map(|at| (link, at.value.value)));
                }
                None => faults.push(not_lockable(mechanism, &raw.name.location, name)),
            }
            continue;
        };
        let joint = &mechanism.links()[link.0].joint;
        if joint.degrees.velocities.len() > 1 {
            let keyword = joint.kind.keyword;
            faults.push(wording::lock_of_several(&raw.name.location, name, keyword));
            continue;
        }
        let [position, ..] =
            joints::dimensions(mechanism.linear(crate::mechanism::CoordinateId(j)));
        if let Some(at) = raw.number(&[position], faults) {
            locked.push((link, at.value.value));
        }
    }
    locked
}

/// Returns the link of a prescribed joint, and the dimension of its position.
fn prescribed(mechanism: &Mechanism, name: &str) -> Option<(LinkId, Dimension)> {
    let mut all = mechanism.prescribed().iter();
    let found = all.find(|p| mechanism.prescribed_joint(p).name == name)?;
    let joint = mechanism.prescribed_joint(found);
    let [position, ..] = joints::dimensions(joint.kind.motion == Motion::Translation);
    Some((found.link, position))
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
    let follower = joints.find(|joint| joint.name == name);
    if let Some(coupling) = follower.and_then(|joint| joint.degrees.coupling.as_ref()) {
        return wording::lock_of_follower(location, name, &mechanism.leaders(coupling));
    }
    let known = mechanism.one_degree_names();
    let known: Vec<&str> = known.iter().map(String::as_str).collect();
    wording::unknown_locked_joint(location, name, &known)
}

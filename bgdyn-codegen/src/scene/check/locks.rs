//! Checks the locked joints of a scene.

use bgdyn_runtime::Dd;

use super::super::lock::locked_pose;
use super::{effects, joints};
use crate::fault::{Fault, Faults, Location, wording};
use crate::format::SceneSpec;
use crate::mechanism::{LinkId, Mechanism, Pose};

/// Returns the locked joints, with the poses of their links, and the joints that follow them.
pub(super) fn locks(
    spec: &SceneSpec,
    mechanism: &Mechanism,
    faults: &mut Faults,
) -> Vec<(LinkId, Pose)> {
    let mut locked = Vec::new();
    for raw in effects::given(&spec.lock) {
        let name = &raw.name.value;
        let links = mechanism.coordinates().iter().copied();
        let found = links
            .enumerate()
            .find(|(_, l)| mechanism.links()[l.0].joint.name == *name);
        let Some((j, link)) = found else {
            faults.push(not_lockable(mechanism, &raw.name.location, name));
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
            let at = at.value.value;
            locked.push((link, locked_pose(joint, at)));
            locked.extend(followers(mechanism, link, at));
        }
    }
    locked
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
    if let Some(mimic) = follower.and_then(|joint| joint.degrees.mimic) {
        let leader = &mechanism.links()[mimic.leader.0].joint.name;
        return wording::lock_of_follower(location, name, leader);
    }
    let known = mechanism.one_degree_names();
    let known: Vec<&str> = known.iter().map(String::as_str).collect();
    wording::unknown_locked_joint(location, name, &known)
}

/// Returns the links whose joints follow a locked one, with their poses.
fn followers(
    mechanism: &Mechanism,
    leader: LinkId,
    at: Dd,
) -> impl Iterator<Item = (LinkId, Pose)> {
    let links = mechanism.links().iter().enumerate();
    links.filter_map(move |(i, link)| {
        let mimic = link.joint.degrees.mimic.filter(|m| m.leader == leader)?;
        let at = mimic.ratio * at + mimic.offset;
        Some((LinkId(i), locked_pose(&link.joint, at)))
    })
}

//! Closed loops of a robot: their names, their links, and what they need to be a mechanism.

use super::joint_type::JointType;
use super::model::{Joint, Loop, LoopPlace, Model};
use super::naming::{free_name, identifier};
use super::writing::{Allowed, NamedLoop};
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::name::WORLD;
use std::collections::HashSet;

/// Returns identifiers for the loops that are not taken.
pub(super) fn names(model: &Model, mut taken: HashSet<String>) -> Vec<String> {
    let name = |one: &Loop| {
        let name = free_name(&identifier(&one.name, "loop"), &taken);
        taken.insert(name.clone());
        name
    };
    model.loops.iter().map(name).collect()
}

/// Returns the loops with their names and those of their links.
pub(super) fn placed<'a>(
    model: &'a Model,
    links: &'a [String],
    names: &'a [String],
) -> Vec<NamedLoop<'a>> {
    let link = |place: &LoopPlace| {
        let index = |name: &String| model.links.iter().position(|link| link.name == *name);
        let found = place.link.as_ref().and_then(index);
        found.map_or(WORLD, |i| links[i].as_str())
    };
    let loops = model.loops.iter().zip(names);
    let loops = loops.map(|(one, name)| (one, name.as_str(), [link(&one.a), link(&one.b)]));
    loops.collect()
}

/// Returns the text of a mechanism, and the mechanism if it is valid: with loops, the first of the texts that is, in which
/// as little as possible is allowed to them.
pub(super) fn accepted(
    text: impl Fn(Allowed) -> String,
    closed: bool,
) -> (String, Option<Mechanism>) {
    let read = |allowed: Allowed| {
        let yaml = text(allowed);
        let (mechanism, _) = bgdyn_codegen::read(&yaml, Some("robot"));
        (yaml, mechanism)
    };
    let first = read(Allowed::Nothing);
    if first.1.is_some() || !closed {
        return first;
    }
    let others = [Allowed::Redundant, Allowed::Rounded].into_iter();
    let mut others = others
        .map(read)
        .filter(|(_, mechanism)| mechanism.is_some());
    others.next().unwrap_or(first)
}

/// Returns the moving joints on the way from one link to another.
pub(super) fn joints_between<'a>(
    model: &'a Model,
    a: &Option<String>,
    b: &Option<String>,
) -> Vec<&'a Joint> {
    let to_world = |link: &Option<String>| {
        let mut at = link.clone();
        let mut passed = Vec::new();
        while let Some(name) = at {
            let Some(index) = model.joints.iter().position(|joint| joint.child == name) else {
                break;
            };
            passed.push(index);
            at = model.joints[index].parent.clone();
        }
        passed
    };
    let [a, b] = [a, b].map(to_world);
    let alone = |own: &[usize], other: &[usize]| -> Vec<usize> {
        let own = own.iter().copied();
        own.filter(|joint| !other.contains(joint)).collect()
    };
    let way = [alone(&a, &b), alone(&b, &a)].concat();
    let joints = way.into_iter().map(|joint| &model.joints[joint]);
    joints
        .filter(|joint| joint.kind != JointType::Fixed)
        .collect()
}

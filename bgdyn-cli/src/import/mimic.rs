//! Joints that follow others: reading of `<mimic>`, checks, and followers of a locked joint.

use super::attributes::finite;
use super::joint_type::JointType;
use super::model::{Joint, Mimic, Model};
use super::naming::shown;
use super::number::Num;
use super::xml::{Element, fault};
use anyhow::Result;
use bgdyn_runtime::Dd;

/// Reads the `<mimic>` of a URDF's joint: multiplier 1 and offset 0 by default.
pub(super) fn read(element: &Element) -> Result<Mimic> {
    let number = |attribute: &str, default: f64| match element.get(attribute) {
        Some(_) => finite(element, attribute),
        None => Ok(Num::computed(default)),
    };
    let Some(joint) = element.get("joint") else {
        let message = "this `<mimic>` names no joint: `joint=…` is missing";
        return Err(fault(element.at, message));
    };
    Ok(Mimic {
        joint: joint.to_owned(),
        ratio: number("multiplier", 1.0)?,
        offset: number("offset", 0.0)?,
    })
}

/// Returns the positions of the followers of a joint for a position of it, with their indices.
pub(super) fn followers(model: &Model, leader: usize, position: &Num) -> Vec<(usize, Num)> {
    let name = &model.joints[leader].name;
    let follows = |(index, joint): (usize, &Joint)| {
        let mimic = joint.mimic.as_ref().filter(|it| it.joint == *name)?;
        if index == leader {
            return None;
        }
        let value = mimic.ratio.exact() * position.exact() + mimic.offset.exact();
        Some((index, Num::computed(value.to_f64())))
    };
    let joints = model.joints.iter().enumerate();
    joints.filter_map(follows).collect()
}

/// A follower's relation to the joint at the end of its chain of leaders.
pub(super) struct Relation {
    /// The index of the leader.
    pub(super) leader: usize,
    pub(super) ratio: Dd,
    pub(super) offset: Dd,
}

/// Returns the relation of a follower to the joint that has the coordinate; `None` for other joints and for
/// circles.
pub(super) fn relation(model: &Model, joint: &Joint) -> Option<Relation> {
    let (mut ratio, mut offset) = (Dd::ONE, Dd::ZERO);
    let mut next = joint.mimic.as_ref()?;
    for _ in 0..model.joints.len() {
        offset += ratio * next.offset.exact();
        ratio *= next.ratio.exact();
        let leader = model.joints.iter().position(|it| it.name == next.joint)?;
        match &model.joints[leader].mimic {
            Some(mimic) => next = mimic,
            None => {
                return Some(Relation {
                    leader,
                    ratio,
                    offset,
                });
            }
        }
    }
    None
}

/// Checks that followers and leaders have one coordinate each, and that no relation is circular; returns
/// one error for all faults.
pub(super) fn check(model: &Model) -> Result<()> {
    let mut first = None;
    let mut wrong = Vec::new();
    for joint in &model.joints {
        if let Some(what) = joint.mimic.as_ref().and_then(|it| judge(model, joint, it)) {
            first = first.or(Some(joint.at));
            wrong.push(what);
        }
    }
    if wrong.is_empty() {
        for joint in &model.joints {
            if let Some(circle) = circle(model, joint) {
                return Err(fault(joint.at, circle));
            }
        }
    }
    match first {
        Some(at) => Err(fault(at, wrong.join("; "))),
        None => Ok(()),
    }
}

/// Returns what is wrong with a follower, its leader or its ratio.
fn judge(model: &Model, joint: &Joint, mimic: &Mimic) -> Option<String> {
    let (name, leader) = (shown(&joint.name), shown(&mimic.joint));
    let of = |kind: JointType| match kind {
        JointType::Fixed => "is fixed".to_owned(),
        kind => format!("is {} and has several coordinates", kind.keyword()),
    };
    if !joint.kind.is_scalar() {
        let what = of(joint.kind);
        return Some(format!(
            "joint `{name}` has `<mimic>` and {what}: a follower is revolute, continuous or prismatic, remove the element"
        ));
    }
    let offset = &mimic.offset.text;
    if model.loops.iter().any(|it| it.name == mimic.joint) {
        return Some(format!(
            "joint `{name}` follows `{leader}`, which closes a loop and has no coordinate: exchange the joints in the file, so that another one closes it"
        ));
    }
    let Some(found) = model.joints.iter().find(|it| it.name == mimic.joint) else {
        return Some(format!(
            "joint `{name}` follows `{leader}`, and there is no such joint here: correct the name, or fix the follower with `--lock {name}`"
        ));
    };
    if !found.kind.is_scalar() {
        let what = of(found.kind);
        return Some(format!(
            "joint `{name}` follows `{leader}`, which {what}: `--lock {name}={offset}` fixes the follower"
        ));
    }
    mimic.ratio.is_zero().then(|| {
        format!(
            "joint `{name}` follows `{leader}` with the multiplier 0: `--lock {name}={offset}` fixes it where it rests"
        )
    })
}

/// Returns the fault of a joint that follows itself by way of others.
fn circle(model: &Model, joint: &Joint) -> Option<String> {
    let mut names = vec![shown(&joint.name)];
    let mut at = joint;
    for _ in 0..model.joints.len() {
        let mimic = at.mimic.as_ref()?;
        at = model.joints.iter().find(|it| it.name == mimic.joint)?;
        names.push(shown(&at.name));
        if at.name == joint.name {
            let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
            let path = names.join(" follows ");
            return Some(format!(
                "{path}: the joints follow each other in a circle, remove one of these relations"
            ));
        }
    }
    None
}

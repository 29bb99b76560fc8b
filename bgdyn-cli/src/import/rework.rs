//! Changes of a robot before it is written: locked joints, an extracted chain, links turned into frames.

use super::joint_type::JointType;
use super::naming::{identifier, shown};
use super::number::Num;
use super::options::{Lock, Options};
use super::placement::{Placement, displaced, turned};
use super::reading::{Frame, Joint, Limits, Model};
use super::tree::{Tree, order};
use crate::quantity;
use anyhow::{Result, bail};
use bgdyn_codegen::format::Dimension;
use bgdyn_codegen::math::Vec3;
use bgdyn_codegen::unit::UnitFactor;

/// The word for every link that can be a frame.
const ALL: &str = "all";

/// Applies the options to the robot, and returns messages about omitted parts.
pub(super) fn rework(model: &mut Model, options: &Options) -> Result<Vec<String>> {
    let mut told = Vec::new();
    for asked in &options.lock {
        lock(model, asked)?;
    }
    if let Some([base, tip]) = &options.chain {
        told = chain(model, base, tip)?;
    }
    if !options.frames.is_empty() {
        frames(model, &options.frames)?;
    }
    Ok(told)
}

/// Returns whether a name of the robot matches the caller's name: that in the file, or that in the
/// mechanism.
fn is_called(name: &str, asked: &str, kind: &str) -> bool {
    name == asked || identifier(name, kind) == asked
}

fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<String> = names.map(|name| format!("`{}`", shown(name))).collect();
    match names.as_slice() {
        [] => "none".into(),
        names => names.join(", "),
    }
}

/// Returns the only link of this name; the names in the file have priority.
fn link(model: &Model, asked: &str, option: &str) -> Result<usize> {
    let exact = model.links.iter().position(|link| link.name == asked);
    let called = |link: &super::reading::Link| is_called(&link.name, asked, "link");
    if let Some(found) = exact.or_else(|| model.links.iter().position(called)) {
        return Ok(found);
    }
    let known = listed(model.links.iter().map(|link| link.name.as_str()));
    bail!(
        "{option}: there is no link `{}`; the links are {known}",
        shown(asked)
    )
}

/// Fixes a joint at a value of its coordinate.
fn lock(model: &mut Model, asked: &Lock) -> Result<()> {
    let Lock { joint, value, unit } = asked;
    let moves = |it: &Joint| it.kind != JointType::Fixed;
    let exact = model.joints.iter().position(|it| it.name == *joint);
    let called = |it: &Joint| is_called(&it.name, joint, "joint");
    let Some(found) = exact.or_else(|| model.joints.iter().position(called)) else {
        let known = model.joints.iter().filter(|it| moves(it));
        let known = listed(known.map(|it| it.name.as_str()));
        bail!(
            "--lock: there is no joint `{}`; those that move are {known}",
            shown(joint)
        );
    };
    let found = &mut model.joints[found];
    if !moves(found) {
        bail!(
            "--lock: the joint `{}` is fixed already",
            shown(&found.name)
        );
    }
    let (own, does) = match found.kind {
        JointType::Prismatic => (Dimension::Length, "slides"),
        _ => (Dimension::Angle, "turns"),
    };
    if let Some(unit) = unit.filter(|unit| *unit != own) {
        let units: Vec<&str> = own.units().collect();
        bail!(
            "--lock: the joint `{}` {does}, and its value is {unit}: write {own}, in {}",
            shown(&found.name),
            units.join(" or ")
        );
    }
    let axis = Vec3(found.axis.each_ref().map(Num::exact));
    let by = value.exact();
    if !value.is_zero() {
        let moved = match found.kind {
            JointType::Prismatic => displaced(super::placement::unit(axis).scale(by).0),
            _ => turned(axis, by),
        };
        found.origin = found.origin.then(&moved.placement());
    }
    found.kind = JointType::Fixed;
    found.limits = Limits::default();
    (found.damping, found.friction) = (None, None);
    Ok(())
}

/// Returns the joint of each link.
fn carriers(model: &Model, tree: &Tree) -> Vec<Option<usize>> {
    let mut carriers = vec![None; model.links.len()];
    for (joint, (_, child)) in tree.ends.iter().enumerate() {
        carriers[*child] = Some(joint);
    }
    carriers
}

/// Retains the links from one to the other, and everything fixed to them.
fn chain(model: &mut Model, base: &str, tip: &str) -> Result<Vec<String>> {
    let tree = order(model)?;
    let (base, tip) = (link(model, base, "--chain")?, link(model, tip, "--chain")?);
    let carriers = carriers(model, &tree);
    let mut kept = vec![false; model.links.len()];
    let mut at = tip;
    let mut passed = vec![tip];
    kept[tip] = true;
    while at != base {
        let Some(joint) = carriers[at] else {
            let [from, to] = [base, tip].map(|link| shown(&model.links[link].name));
            let below = listed(passed.iter().map(|link| model.links[*link].name.as_str()));
            bail!(
                "--chain: `{from}` does not carry `{to}`; from the tip to its root these do: {below}"
            );
        };
        at = tree.ends[joint].0;
        passed.push(at);
        kept[at] = true;
    }
    // The base is in its position with every joint at 0, so that the direction of gravity is correct.
    let mut place = Placement::identity();
    let mut below = base;
    while let Some(joint) = carriers[below] {
        place = model.joints[joint].origin.then(&place);
        below = tree.ends[joint].0;
    }
    keep_fixed(model, &tree, &mut kept);
    let mut told = without(model, &tree, &kept);
    if below != base {
        let name = shown(&model.links[base].name);
        told.push(format!(
            "--chain: `{name}` is fixed to the world where it is with every joint at 0"
        ));
    }
    model.links[base].place = Some(place);
    let mut keep = kept.iter();
    model
        .links
        .retain(|_| keep.next().copied().unwrap_or(false));
    let mut joints = tree
        .ends
        .iter()
        .map(|(parent, child)| kept[*parent] && kept[*child]);
    model.joints.retain(|_| joints.next().unwrap_or(false));
    Ok(told)
}

/// Retains everything that fixed joints connect to a retained link, away from the base.
fn keep_fixed(model: &Model, tree: &Tree, kept: &mut [bool]) {
    let mut more = true;
    while more {
        more = false;
        for (joint, (parent, child)) in model.joints.iter().zip(&tree.ends) {
            if joint.kind == JointType::Fixed && kept[*parent] && !kept[*child] {
                kept[*child] = true;
                more = true;
            }
        }
    }
}

/// Lists the parts that a chain omits.
fn without(model: &Model, tree: &Tree, kept: &[bool]) -> Vec<String> {
    let left = model.links.iter().zip(kept).filter(|(_, kept)| !**kept);
    let left: Vec<_> = left.map(|(link, _)| link).collect();
    if left.is_empty() {
        return Vec::new();
    }
    let mass = left.iter().filter_map(|link| link.inertial.as_ref());
    let mass: f64 = mass.map(|inertial| inertial.mass.value).sum();
    let joints = model.joints.iter().zip(&tree.ends);
    let moving =
        joints.filter(|(joint, (_, child))| joint.kind != JointType::Fixed && !kept[*child]);
    let names = listed(left.iter().map(|link| link.name.as_str()));
    vec![format!(
        "--chain: left out, with {} kg in all and {} moving joints: {names}",
        super::doubts::six_digits(mass),
        moving.count(),
    )]
}

/// Converts links without inertia to frames of their parents.
fn frames(model: &mut Model, asked: &[String]) -> Result<()> {
    let tree = order(model)?;
    let carriers = carriers(model, &tree);
    let fits = |link: usize| {
        let joint = carriers[link].map(|joint| &model.joints[joint]);
        !model.links[link].is_body() && joint.is_some_and(|joint| joint.kind == JointType::Fixed)
    };
    let mut frame = vec![false; model.links.len()];
    for name in asked {
        if name == ALL {
            (0..frame.len()).for_each(|i| frame[i] |= fits(i));
            continue;
        }
        let found = link(model, name, "--frames")?;
        if !fits(found) {
            bail!(
                "--frames: the link `{}` is no frame: a frame has no inertia, and a fixed joint joins it to a link",
                shown(&model.links[found].name)
            );
        }
        frame[found] = true;
    }
    // A link that carries a body or a joint remains a link; if it was selected by name, that is an error.
    loop {
        let carries = tree
            .ends
            .iter()
            .find(|(parent, child)| frame[*parent] && !frame[*child]);
        let Some((parent, child)) = carries else {
            break;
        };
        let [parent_name, child] = [parent, child].map(|link| &model.links[*link].name);
        if asked
            .iter()
            .any(|name| is_called(parent_name, name, "link"))
        {
            let [parent, child] = [parent_name, child].map(|name| shown(name));
            bail!("--frames: the link `{parent}` carries `{child}`, so it stays a link");
        }
        frame[*parent] = false;
    }
    for i in (0..frame.len()).filter(|i| frame[*i]) {
        let (mut at, mut place) = (i, Placement::identity());
        while let Some(joint) = carriers[at].filter(|_| frame[at]) {
            place = model.joints[joint].origin.then(&place);
            at = tree.ends[joint].0;
        }
        model.frames.push(Frame {
            name: model.links[i].name.clone(),
            link: model.links[at].name.clone(),
            place,
        });
    }
    let mut joints = tree.ends.iter().map(|(_, child)| !frame[*child]);
    model.joints.retain(|_| joints.next().unwrap_or(false));
    let mut links = frame.iter().map(|frame| !frame);
    model.links.retain(|_| links.next().unwrap_or(false));
    Ok(())
}

impl Lock {
    /// Parses `JOINT` or `JOINT=VALUE`.
    ///
    /// # Errors
    /// If the value is no finite number, or its unit is neither that of an angle nor that of a length.
    pub fn parse(text: &str) -> Result<Lock, String> {
        let (joint, value) = text.rsplit_once('=').unwrap_or((text, "0"));
        let text = value.trim();
        let read = quantity::read(text, &[Dimension::Angle, Dimension::Length])
            .map_err(|what| format!("`{joint}`: {what}"))?;
        let number = match read.unit {
            Some(unit) if unit.factor == UnitFactor::Degree => {
                Num::degrees(text.trim_end_matches(unit_of_degrees))
            }
            Some(_) => Some(Num::computed(read.value.to_f64())),
            None => Num::parse(text),
        };
        let number = number.filter(|number| number.value.is_finite());
        let value = number.ok_or_else(|| format!("`{value}` is no number"))?;
        Ok(Lock {
            joint: joint.trim().to_owned(),
            value,
            unit: read.unit.map(|unit| unit.dimension),
        })
    }
}

/// Returns whether a character belongs to the unit of degrees: `deg`, `°`.
fn unit_of_degrees(c: char) -> bool {
    "deg° ".contains(c)
}

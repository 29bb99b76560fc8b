//! Changes of a robot before it is written: locked joints, an extracted chain, links turned into frames.

use super::joint_type::JointType;
use super::model::{Frame, Link, Loop, Model};
use super::naming::{is_called, listed, shown};
use super::options::{Lock, Options};
use super::placement::Placement;
use super::tree::{Tree, order};
use super::{locks, mimic};
use anyhow::{Result, bail};

/// The word for every link that can be a frame.
const ALL: &str = "all";

/// Applies the options to the robot, and returns messages about omitted parts.
pub(super) fn rework(model: &mut Model, options: &Options) -> Result<Vec<String>> {
    let mut messages = Vec::new();
    // Followers first: locked by themselves they follow no more.
    let mut locks: Vec<&Lock> = options.lock.iter().collect();
    locks.sort_by_key(|asked| !locks::follows(model, asked));
    for asked in locks {
        messages.extend(locks::lock(model, asked)?);
    }
    if let Some([base, tip]) = &options.chain {
        messages.extend(chain(model, base, tip)?);
    }
    mimic::check(model)?;
    if !options.frames.is_empty() {
        frames(model, &options.frames)?;
    }
    Ok(messages)
}

/// Returns the only link of this name; the names in the file have priority.
fn link(model: &Model, asked: &str, option: &str) -> Result<usize> {
    let exact = model.links.iter().position(|link| link.name == asked);
    let called = |link: &Link| is_called(&link.name, asked, "link");
    if let Some(found) = exact.or_else(|| model.links.iter().position(called)) {
        return Ok(found);
    }
    let known = listed(model.links.iter().map(|link| link.name.as_str()));
    bail!(
        "{option}: there is no link `{}`; the links are {known}",
        shown(asked)
    )
}

/// Retains the links from one to the other, and everything fixed to them.
fn chain(model: &mut Model, base: &str, tip: &str) -> Result<Vec<String>> {
    let tree = order(model)?;
    let (base, tip) = (link(model, base, "--chain")?, link(model, tip, "--chain")?);
    let carriers = tree.carriers();
    let mut kept = vec![false; model.links.len()];
    let mut at = tip;
    let mut passed = vec![tip];
    kept[tip] = true;
    while at != base {
        let Some((_, parent)) = carriers[at] else {
            let [from, to] = [base, tip].map(|link| shown(&model.links[link].name));
            let below = listed(passed.iter().map(|link| model.links[*link].name.as_str()));
            bail!(
                "--chain: `{from}` does not carry `{to}`; from the tip to its root these do: {below}"
            );
        };
        at = parent;
        passed.push(at);
        kept[at] = true;
    }
    // The base is in its position with every joint at 0, so that the direction of gravity is correct.
    let mut place = Placement::identity();
    let mut below = Some(base);
    while let Some(link) = below {
        let joint = tree.joint_of(link);
        let origin = match joint {
            Some(joint) => Some(&model.joints[joint].origin),
            None => model.links[link].place.as_ref(),
        };
        place = origin.map_or(place.clone(), |origin| origin.then(&place));
        below = joint.and_then(|joint| tree.ends[joint].0);
    }
    keep_fixed(model, &tree, &mut kept);
    let mut messages = without(model, &tree, &kept);
    if tree.joint_of(base).is_some() {
        let name = shown(&model.links[base].name);
        messages.push(format!(
            "--chain: `{name}` is fixed to the world where it is with every joint at 0"
        ));
    }
    model.links[base].place = Some(place);
    let names: Vec<String> = model.links.iter().map(|link| link.name.clone()).collect();
    let stays = |link: &String| {
        names
            .iter()
            .zip(&kept)
            .any(|(name, kept)| name == link && *kept)
    };
    model
        .frames
        .retain(|frame| frame.link.as_ref().is_none_or(stays));
    let open = |one: &Loop| {
        ![&one.a, &one.b]
            .into_iter()
            .all(|it| it.link.as_ref().is_none_or(stays))
    };
    let opened = model.loops.iter().filter(|one| open(one));
    let opened: Vec<&str> = opened.map(|one| one.name.as_str()).collect();
    if !opened.is_empty() {
        messages.push(format!(
            "--chain: loops with links that are left out: {}",
            listed(opened.into_iter())
        ));
    }
    model.loops.retain(|one| !open(one));
    let mut keep = kept.iter();
    model
        .links
        .retain(|_| keep.next().copied().unwrap_or(false));
    let inside = |(parent, child): &(Option<usize>, usize)| {
        parent.is_some_and(|parent| kept[parent]) && kept[*child] && *child != base
    };
    let mut joints = tree.ends.iter().map(inside);
    model.joints.retain(|_| joints.next().unwrap_or(false));
    Ok(messages)
}

/// Retains everything that fixed joints connect to a retained link, away from the base.
fn keep_fixed(model: &Model, tree: &Tree, kept: &mut [bool]) {
    let mut more = true;
    while more {
        more = false;
        for (joint, (parent, child)) in model.joints.iter().zip(&tree.ends) {
            let carried = parent.is_some_and(|parent| kept[parent]);
            if joint.kind == JointType::Fixed && carried && !kept[*child] {
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
    let carriers = tree.carriers();
    let fits = |link: usize| {
        let joint = carriers[link].map(|(joint, _)| &model.joints[joint]);
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
        let ends = tree.ends.iter();
        let mut ends = ends.filter_map(|(parent, child)| Some(((*parent)?, *child)));
        let carries = ends.find(|(parent, child)| frame[*parent] && !frame[*child]);
        let Some((parent, child)) = carries else {
            break;
        };
        let [parent_name, child] = [parent, child].map(|link| &model.links[link].name);
        if asked
            .iter()
            .any(|name| is_called(parent_name, name, "link"))
        {
            let [parent, child] = [parent_name, child].map(|name| shown(name));
            bail!("--frames: the link `{parent}` carries `{child}`, so it stays a link");
        }
        frame[parent] = false;
    }
    let found = |i: usize| {
        let (mut at, mut place) = (i, Placement::identity());
        while let Some((joint, parent)) = carriers[at].filter(|_| frame[at]) {
            place = model.joints[joint].origin.then(&place);
            at = parent;
        }
        (model.links[at].name.clone(), place)
    };
    // Sites and ends of loops on a link that becomes a frame.
    let index = |name: &String| model.links.iter().position(|link| link.name == *name);
    let carrier = |link: &Option<String>| link.as_ref().and_then(index).map(found);
    let moved: Vec<_> = model.frames.iter().map(|it| carrier(&it.link)).collect();
    let ends = model.loops.iter().flat_map(|one| [&one.a, &one.b]);
    let ends: Vec<_> = ends.map(|it| carrier(&it.link)).collect();
    let new = (0..frame.len()).filter(|i| frame[*i]).map(|i| {
        let (link, place) = found(i);
        Frame {
            name: model.links[i].name.clone(),
            link: Some(link),
            place,
        }
    });
    let new: Vec<Frame> = new.collect();
    for (site, moved) in model.frames.iter_mut().zip(moved) {
        if let Some((link, place)) = moved {
            site.place = place.then(&site.place);
            site.link = Some(link);
        }
    }
    let loops = model
        .loops
        .iter_mut()
        .flat_map(|one| [&mut one.a, &mut one.b]);
    for (end, moved) in loops.zip(ends) {
        if let Some((link, place)) = moved {
            end.place = place.then(&end.place);
            end.link = Some(link);
        }
    }
    model.frames.extend(new);
    let mut joints = tree.ends.iter().map(|(_, child)| !frame[*child]);
    model.joints.retain(|_| joints.next().unwrap_or(false));
    let mut links = frame.iter().map(|frame| !frame);
    model.links.retain(|_| links.next().unwrap_or(false));
    Ok(())
}

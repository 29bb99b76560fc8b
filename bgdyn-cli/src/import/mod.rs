//! `bgdyn import`: converts a URDF, an MJCF, an SDF or a table of Denavit–Hartenberg parameters into a mechanism.
//!
//! Text → elements with their positions (`xml`) → the part that a mechanism can represent; the rest is
//! counted (`select`) → links and joints (`reading`; of an MJCF `mjcf`, of an SDF `sdf`, of a table `dh`), with planes
//! (`planar`), followers (`mimic`), `limits` and `effects` → changes by options (`rework`: `locks`, `base`) →
//! their order (`tree`) and names (`naming`) → YAML (`writing`). `doubts` warns about suspicious data,
//! `placement` computes poses; `loops` decides what closed loops need.

mod attributes;
mod base;
mod command;
mod defaults;
mod dh;
mod doubts;
mod effects;
mod groups;
mod inertia;
mod joint_type;
mod limits;
mod locks;
mod loops;
mod mimic;
mod mjcf;
mod model;
mod naming;
mod number;
mod options;
mod placement;
mod planar;
mod reading;
mod rework;
mod sdf;
mod select;
mod tally;
mod tree;
mod writing;
mod xml;

use crate::commands::check::snapped_words;
use anyhow::Result;
use bgdyn_codegen::name::WORLD;
use joint_type::JointType;
use model::{Joint, Model};
use naming::{free_name, identifiers, shown};
use number::Num;
use std::collections::HashSet;
use tally::plural;
use writing::Allowed;

pub use base::Base;
pub use command::{ImportArgs, run};
pub use dh::Convention;
pub use options::{Lock, Options};

/// A mechanism made from a file, with messages.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Import {
    /// The mechanism, format 1. It has no `name:`: its name is that of its file.
    pub yaml: String,
    /// The robot's name as an identifier: a suitable stem for the file.
    pub name: String,
    /// The names that were changed, one line each for robot, links and joints: ``links `Upper-Arm` →
    /// `upper_arm`, `Hand 1` → `hand_1` ``.
    pub notes: Vec<String>,
    /// Omitted and suspicious data, one line each.
    pub warnings: Vec<String>,
    /// A summary on one line: the numbers of links, joints, frames and effects, and what is fixed to the
    /// world.
    pub written: String,
}

/// Converts the text of a URDF, an MJCF or an SDF to a mechanism; the root element decides which it is.
///
/// Links are in the order of their joints, numbers have their original text. An error starts with
/// `LINE:COLUMN: `.
pub fn import(text: &str) -> Result<Import> {
    import_with(text, &Options::default())
}

/// [`import`] with options.
///
/// # Errors
/// The error of the text, prefixed by `LINE:COLUMN: `, or of an option, prefixed by its name.
pub fn import_with(text: &str, options: &Options) -> Result<Import> {
    let root = xml::parse(text)?;
    let model = match root.name.as_str() {
        mjcf::ROOT => mjcf::read(&root, options.folder.as_deref())?,
        sdf::ROOT => sdf::read(&root)?,
        _ => reading::read(&root)?,
    };
    made(model, options)
}

/// Converts a table of Denavit–Hartenberg parameters to a mechanism: comma-separated values with the names
/// of the columns in the first line (`docs/import.md`). `convention` is the default for rows without one,
/// `name` the robot's name.
///
/// # Errors
/// As [`import_with`].
pub fn import_table(
    text: &str,
    name: &str,
    convention: Option<Convention>,
    options: &Options,
) -> Result<Import> {
    made(dh::read(text, name, convention)?, options)
}

fn made(mut model: Model, options: &Options) -> Result<Import> {
    let dusty = doubts::without_dust(&mut model);
    // Errors of the file are reported first.
    tree::order(&model)?;
    let mut messages: Vec<String> = planar::turn_links(&mut model).into_iter().collect();
    messages.extend(rework::rework(&mut model, options)?);
    let tree = tree::order(&model)?;
    match options.base {
        Some(base) => base::free(&mut model, &tree, base)?,
        None if model.free_roots => base::free_all(&mut model, &tree),
        None => {}
    }
    let tree = tree::order(&model)?;
    let named = Identifiers::new(&model);

    let mut warnings = doubts::doubtful(&model, &tree);
    warnings.extend(messages);
    warnings.extend(dusty);
    let mut allowed = vec![false; model.links.len()];
    for (link, allowed) in model.links.iter().zip(&mut allowed) {
        if let Some(inertial) = &link.inertial {
            *allowed = doubts::judge_inertial(&shown(&link.name), inertial, &mut warnings);
        }
    }

    let mut taken: HashSet<String> = named.joints.iter().chain(&named.loops).cloned().collect();
    let entries = entries(&model, &tree, &named, &allowed, &mut taken);
    let frames = frames(&model, &named);
    let effects = match options.no_effects {
        true => Vec::new(),
        false => {
            taken.extend(named.links.iter().chain(&named.frames).cloned());
            warnings.extend(effects::moved(&model));
            effects::effects(&model, &named.joints, taken)
        }
    };
    if options.no_effects && model.joints.iter().any(|joint| !joint.effects.is_empty()) {
        warnings
            .push("damping, friction, springs and rotors of joints are left out, as asked".into());
    }
    let snap = options.snap.map(|snap| Num::computed(snap).text);
    let loops = loops::placed(&model, &named.links, &named.loops);
    let text = |allowed: Allowed| {
        writing::head(&model, snap.as_deref())
            + &entries.join("\n")
            + &writing::frames(&frames)
            + &writing::loops(&loops, allowed)
            + &writing::effects(&effects)
    };
    let (yaml, mechanism) = loops::accepted(text, !loops.is_empty());
    let snapped = mechanism.as_ref().and_then(|m| m.snapped());
    warnings.extend(snapped.map(|snapped| format!("snapped: {}", snapped_words(snapped))));
    let written = written(&model, &tree, &named, effects.len());
    let notes = named.notes(&model);
    warnings.extend(model.warnings);
    Ok(Import {
        yaml,
        name: named.robot,
        notes,
        warnings,
        written,
    })
}

/// The names of the mechanism, in the order of the model's.
struct Identifiers {
    robot: String,
    links: Vec<String>,
    joints: Vec<String>,
    frames: Vec<String>,
    loops: Vec<String>,
}

impl Identifiers {
    fn new(model: &Model) -> Self {
        let places = model.links.iter().map(|link| link.name.as_str());
        let places: Vec<&str> = places
            .chain(model.frames.iter().map(|frame| frame.name.as_str()))
            .collect();
        let mut links = identifiers(&places, "link");
        let frames = links.split_off(model.links.len());
        let joints = model.joints.iter().map(|joint| joint.name.as_str());
        let joints: Vec<&str> = joints.collect();
        let mut joints = identifiers(&joints, "joint");
        let kinds = model.joints.iter().map(|joint| joint.kind.endings());
        naming::separate(&mut joints, &kinds.collect::<Vec<_>>());
        let taken = [&links, &frames, &joints].into_iter().flatten().cloned();
        let loops = loops::names(model, taken.collect());
        Identifiers {
            robot: naming::identifier(&model.name, "robot"),
            links,
            joints,
            frames,
            loops,
        }
    }

    /// Lists the names that changed.
    fn notes(&self, model: &Model) -> Vec<String> {
        let links = model.links.iter().map(|link| &link.name);
        let joints = model.joints.iter().map(|joint| &joint.name);
        let frames = model.frames.iter().map(|frame| &frame.name);
        let loops = model.loops.iter().map(|one| &one.name);
        let notes = [
            renamed("robot", [(&model.name, &self.robot)].into_iter()),
            renamed("links", links.zip(&self.links)),
            renamed("joints", joints.zip(&self.joints)),
            renamed("frames", frames.zip(&self.frames)),
            renamed("loops", loops.zip(&self.loops)),
        ];
        notes.into_iter().flatten().collect()
    }
}

/// Returns the links as text, those without a joint first; adds the names of their joints to the used
/// names.
fn entries(
    model: &Model,
    tree: &tree::Tree,
    named: &Identifiers,
    allowed: &[bool],
    taken: &mut HashSet<String>,
) -> Vec<String> {
    let entry = |link: usize| writing::LinkEntry {
        link: &model.links[link],
        name: &named.links[link],
        parent: None,
        joint: None,
        leader: None,
        mount: None,
        allow_nonphysical: allowed[link],
    };
    let mut entries = Vec::new();
    for root in &tree.roots {
        // By default, the joint of a root has this name: find another name if a joint has it already.
        let default = format!("{}_mount", named.links[*root]);
        let mount = taken.contains(&default).then(|| free_name(&default, taken));
        taken.insert(mount.clone().unwrap_or(default));
        entries.push(writing::entry(&writing::LinkEntry {
            mount,
            ..entry(*root)
        }));
    }
    for ((joint, name), (parent, child)) in model.joints.iter().zip(&named.joints).zip(&tree.ends) {
        entries.push(writing::entry(&writing::LinkEntry {
            parent: parent.map(|parent| named.links[parent].as_str()),
            joint: Some((joint, name.as_str())),
            leader: leader(model, named, joint),
            ..entry(*child)
        }));
    }
    entries
}

/// Returns the name of the joint that a follower follows, and whether both turn or both slide.
fn leader<'a>(model: &Model, named: &'a Identifiers, joint: &Joint) -> Option<(&'a str, bool)> {
    let name = &joint.mimic.as_ref()?.joint;
    let index = model.joints.iter().position(|it| it.name == *name)?;
    let slides = |joint: &Joint| joint.kind == JointType::Prismatic;
    let alike = slides(joint) == slides(&model.joints[index]);
    Some((&named.joints[index], alike))
}

/// Returns the frames with their names and those of their links.
fn frames<'a>(
    model: &'a Model,
    named: &'a Identifiers,
) -> Vec<(&'a model::Frame, &'a str, &'a str)> {
    let link = |name: &Option<String>| {
        let index = |name: &String| model.links.iter().position(|link| link.name == *name);
        let found = name.as_ref().and_then(index);
        found.map_or(WORLD, |i| named.links[i].as_str())
    };
    let frames = model.frames.iter().zip(&named.frames);
    let frames = frames.map(|(frame, name)| (frame, name.as_str(), link(&frame.link)));
    frames.collect()
}

/// Returns the summary of the mechanism, on one line.
fn written(model: &Model, tree: &tree::Tree, named: &Identifiers, effects: usize) -> String {
    let moving = model
        .joints
        .iter()
        .filter(|joint| joint.kind != JointType::Fixed);
    let roots = tree
        .roots
        .iter()
        .map(|root| format!("`{}`", named.links[*root]));
    let roots = match roots.collect::<Vec<String>>() {
        roots if roots.is_empty() => "none".to_owned(),
        roots => roots.join(", "),
    };
    let ends = model.joints.iter().zip(&named.joints).zip(&tree.ends);
    let free = ends.filter(|(_, (parent, _))| parent.is_none());
    let free = free.map(|((joint, name), (_, child))| {
        format!(
            "`{}` by `{name}` ({})",
            named.links[*child],
            joint.kind.keyword()
        )
    });
    let free = match free.collect::<Vec<String>>() {
        free if free.is_empty() => String::new(),
        free => format!("; moving in the world: {}", free.join(", ")),
    };
    let followers = model.joints.iter().filter(|joint| joint.mimic.is_some());
    let followers = match followers.count() {
        0 => String::new(),
        count => format!(", of them {}", plural(count, "follower")),
    };
    format!(
        "{}, {} ({} moving{followers}), {}, {}; fixed to the world: {roots}{free}",
        plural(model.links.len(), "link"),
        plural(model.joints.len(), "joint"),
        moving.count(),
        plural(model.frames.len(), "frame"),
        plural(effects, "effect"),
    )
}

/// Returns the names that changed, on one line.
fn renamed<'a>(
    what: &str,
    names: impl Iterator<Item = (&'a String, &'a String)>,
) -> Option<String> {
    let changed = names.filter(|(old, new)| old != new);
    let shown = changed.map(|(old, new)| format!("`{}` → `{new}`", shown(old)));
    let shown: Vec<String> = shown.collect();
    (!shown.is_empty()).then(|| format!("{what} {}", shown.join(", ")))
}

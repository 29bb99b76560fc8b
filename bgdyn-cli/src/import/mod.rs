//! `bgdyn import`: a mechanism from a URDF.
//!
//! Text → elements with their places (`xml`) → the part a mechanism can hold, the rest counted (`select`) →
//! links and joints (`reading`) → their order (`tree`) and names (`naming`) → YAML (`writing`).

mod attributes;
mod defaults;
mod groups;
mod inertia;
mod naming;
mod number;
mod reading;
mod select;
mod tree;
mod writing;
mod xml;

use crate::output::{print, tell};
use crate::spec_file::read_text;
use anyhow::{Context, Result, anyhow};
use inertia::{DUST, Verdict, is_dust, judge};
use naming::{identifiers, shown};
use number::Num;
use reading::{Inertial, Model};
use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

/// A mechanism made from a URDF, and what there is to say about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Import {
    /// The mechanism, format 1. It has no `name:`: it is called after the file it is put into.
    pub yaml: String,
    /// The robot's name as an identifier: the stem of a file that fits.
    pub name: String,
    /// The names that were changed, a line each for robot, links and joints:
    /// ``links `Upper-Arm` → `upper_arm`, `Hand 1` → `hand_1` ``.
    pub notes: Vec<String>,
    /// What was not taken over, and what looks wrong, one line each.
    pub warnings: Vec<String>,
}

/// Makes a mechanism from the text of a URDF.
///
/// Links keep the order of their joints, numbers their decimal text. An error starts with `LINE:COLUMN: `.
pub fn import(urdf_text: &str) -> Result<Import> {
    let mut model = reading::read(urdf_text)?;
    let dusty = without_dust(&mut model);
    let tree = tree::order(&model)?;

    let original: Vec<&str> = model.links.iter().map(|link| link.name.as_str()).collect();
    let links = identifiers(&original, "link");
    let original: Vec<&str> = model
        .joints
        .iter()
        .map(|joint| joint.name.as_str())
        .collect();
    let joints = identifiers(&original, "joint");
    let name = naming::identifier(&model.name, "robot");

    let mut warnings = doubtful(&model, &tree);
    warnings.extend(dusty);
    let mut allowed = vec![false; model.links.len()];
    for (link, allowed) in model.links.iter().zip(&mut allowed) {
        if let Some(inertial) = &link.inertial {
            *allowed = judge_inertial(&shown(&link.name), inertial, &mut warnings);
        }
    }

    let mut taken: HashSet<String> = joints.iter().cloned().collect();
    let entry = |link: usize| writing::Entry {
        link: &model.links[link],
        name: &links[link],
        parent: None,
        joint: None,
        mount: None,
        allow_nonphysical: allowed[link],
    };
    let mut entries = Vec::new();
    for root in &tree.roots {
        // Without a joint of its own the root's would be called so: find another name where a joint has that one.
        let default = format!("{}_mount", links[*root]);
        let free = (2..)
            .map(|number| format!("{default}_{number}"))
            .find(|name| !taken.contains(name));
        let mount = if taken.contains(&default) { free } else { None };
        taken.insert(mount.clone().unwrap_or(default));
        entries.push(writing::entry(&writing::Entry {
            mount,
            ..entry(*root)
        }));
    }
    for ((joint, name), (parent, child)) in model.joints.iter().zip(&joints).zip(&tree.ends) {
        let (parent, joint) = (Some(links[*parent].as_str()), Some((joint, name.as_str())));
        entries.push(writing::entry(&writing::Entry {
            parent,
            joint,
            ..entry(*child)
        }));
    }

    let old = model.links.iter().map(|link| &link.name);
    let of_links = renamed("links", old.zip(&links));
    let old = model.joints.iter().map(|joint| &joint.name);
    let of_joints = renamed("joints", old.zip(&joints));
    let of_robot = renamed("robot", [(&model.name, &name)].into_iter());
    let notes = [of_robot, of_links, of_joints].into_iter().flatten();
    let notes = notes.collect();
    let yaml = writing::head(&model.name) + &entries.join("\n");
    warnings.extend(model.warnings);
    Ok(Import {
        yaml,
        name,
        notes,
        warnings,
    })
}

/// The names that changed, on one line.
fn renamed<'a>(
    what: &str,
    names: impl Iterator<Item = (&'a String, &'a String)>,
) -> Option<String> {
    let changed = names.filter(|(old, new)| old != new);
    let shown = changed.map(|(old, new)| format!("`{}` → `{new}`", shown(old)));
    let shown: Vec<String> = shown.collect();
    (!shown.is_empty()).then(|| format!("{what} {}", shown.join(", ")))
}

/// Warnings about the robot as a whole.
fn doubtful(model: &Model, tree: &tree::Tree) -> Vec<String> {
    let mut warnings = Vec::new();
    if model.name.is_empty() {
        warnings.push("the robot has no name".into());
    }
    if tree.roots.len() > 1 {
        let roots: Vec<String> = tree
            .roots
            .iter()
            .map(|root| format!("`{}`", shown(&model.links[*root].name)))
            .collect();
        warnings.push(format!(
            "several links have no joint, all are fixed to the world: {}",
            roots.join(", ")
        ));
    }
    let mut times = HashMap::new();
    for joint in &model.joints {
        let times = times.entry(&joint.name).or_insert(0);
        *times += 1;
        if *times == 2 {
            warnings.push(format!(
                "several joints are called `{}`",
                shown(&joint.name)
            ));
        }
    }
    warnings
}

/// Sets tensors to zero that are what rounding left of one, and says of which links.
fn without_dust(model: &mut Model) -> Option<String> {
    let mut names = Vec::new();
    for link in &mut model.links {
        let Some(inertial) = &mut link.inertial else {
            continue;
        };
        if is_dust(inertial.tensor.each_ref().map(|entry| entry.value)) {
            inertial.tensor = std::array::from_fn(|_| Num::zero());
            names.push(format!("`{}`", shown(&link.name)));
        }
    }
    let names = (!names.is_empty()).then(|| names.join("; "));
    names.map(|names| {
        format!("tensors that no body has, all entries below {DUST:e} kg·m², taken as 0: {names}")
    })
}

/// Warns of an inertial that no body has; true where the mechanism must allow it.
fn judge_inertial(link: &str, inertial: &Inertial, warnings: &mut Vec<String>) -> bool {
    if inertial.mass.value < 0.0 {
        let mass = &inertial.mass.text;
        warnings.push(format!(
            "link `{link}`: the mass {mass} kg is negative; `bgdyn check` will refuse it"
        ));
    }
    let verdict = judge(inertial.tensor.each_ref().map(|entry| entry.value));
    let (moments, fault) = match &verdict {
        Verdict::Physical => return false,
        Verdict::NoTriangle(moments) => (
            moments,
            "break the triangle inequality; kept, with `nonphysical: allow`",
        ),
        Verdict::Indefinite(moments) => (
            moments,
            "are not all positive or zero; kept, but `bgdyn check` will refuse them",
        ),
    };
    let [a, b, c] = moments.map(|moment| Num::computed(rounded(moment)).text);
    warnings.push(format!(
        "link `{link}`: the principal moments {a}, {b}, {c} kg·m² {fault}"
    ));
    matches!(verdict, Verdict::NoTriangle(_))
}

/// Rounded to six digits, for reading.
fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// Make a mechanism from a URDF
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Example:\n  bgdyn import ur5.urdf -o specs/ur5.yaml\n\n\
    The mechanism's module is called after the file it is written to. Changed names and what is not taken over are \
    told on stderr.")]
pub struct ImportArgs {
    /// The URDF; a xacro file must be expanded first
    #[arg(value_name = "FILE.urdf")]
    pub file: PathBuf,
    /// Where to write the mechanism; stdout if not given
    #[arg(short, long, value_name = "FILE.yaml")]
    pub output: Option<PathBuf>,
}

/// Runs `bgdyn import`.
pub fn run(args: ImportArgs) -> Result<()> {
    let path = args.file.display();
    let text = read_text(&args.file)?;
    let mut made = import(&text).map_err(|error| anyhow!("{path}:{error}"))?;
    match &args.output {
        Some(output) => {
            std::fs::write(output, &made.yaml)
                .with_context(|| format!("{} cannot be written", output.display()))?;
            made.warnings.extend(unfit_stem(output, &made.name));
        }
        None => print(&made.yaml)?,
    }
    for note in &made.notes {
        tell(&format!("renamed: {note}\n"));
    }
    for warning in &made.warnings {
        tell(&format!("warning: {warning}\n"));
    }
    Ok(())
}

/// A warning where the module could not be called after the file.
fn unfit_stem(output: &Path, name: &str) -> Option<String> {
    let file = output.file_name()?.to_string_lossy().into_owned();
    let stem = file.split('.').next().unwrap_or_default();
    let unfit = !naming::is_identifier(stem);
    unfit.then(|| {
        format!("a module cannot be called `{stem}`: rename {file}, for example to {name}.yaml")
    })
}

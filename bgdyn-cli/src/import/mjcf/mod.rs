//! Reads an MJCF, the format of MuJoCo.
//!
//! Included files (`include`) → settings (`settings`) and default classes (`defaults`) → the tree of bodies
//! (`builder`, `bodies`, `content`, `mount`), with poses (`pose`), joints (`joints`), inertia given
//! (`inertial`) or that of geoms (`solids`) → loops (`loops`) and followers (`equality`). `report` counts what is not
//! imported.
//!
//! A body's link has its origin at the anchor of the body's last joint, since the axes of a link are those of
//! its joint; MuJoCo's body frame may be anywhere.

mod bodies;
mod builder;
mod content;
mod defaults;
mod equality;
mod include;
mod inertial;
mod joints;
mod known;
mod loops;
mod mount;
mod pose;
mod report;
mod settings;
mod solids;

use super::model::Model;
use super::xml::{Element, fault};
use anyhow::Result;
use builder::Builder;
use defaults::Defaults;
use report::Report;
use settings::Settings;
use std::collections::HashSet;
use std::path::Path;

/// The root element of an MJCF.
pub(super) const ROOT: &str = "mujoco";

/// Sections whose elements are counted one by one.
const SECTIONS: [&str; 9] = [
    "actuator",
    "tendon",
    "contact",
    "sensor",
    "asset",
    "keyframe",
    "custom",
    "deformable",
    "extension",
];

/// Sections that are read.
const READ: [&str; 6] = [
    "compiler",
    "option",
    "default",
    "worldbody",
    "equality",
    // Sizes of MuJoCo's memory.
    "size",
];

/// Reads an MJCF from its root element. `folder` is that of the files it includes.
pub(super) fn read(root: &Element, folder: Option<&Path>) -> Result<Model> {
    let root = include::expand(root, folder)?;
    if root.child("worldbody").is_none() {
        let message = "this `<mujoco>` has no `<worldbody>`: import the file that includes it";
        return Err(fault(root.at, message));
    }
    let mut report = Report::default();
    report.attributes(&root, &["model"]);
    let settings = Settings::read(&root, &mut report)?;
    let defaults = Defaults::read(&root, &mut report)?;
    let mut model = Model {
        name: root.get("model").unwrap_or_default().to_owned(),
        source: "an MJCF".into(),
        gravity: settings::gravity(&root, &mut report)?,
        moving_base: false,
        free_roots: false,
        links: Vec::new(),
        joints: Vec::new(),
        frames: Vec::new(),
        loops: Vec::new(),
        incomplete: Vec::new(),
        warnings: Vec::new(),
    };
    let mut builder = Builder {
        settings: &settings,
        defaults: &defaults,
        report: &mut report,
        model: &mut model,
        links: HashSet::new(),
        joints: HashSet::new(),
        references: Vec::new(),
        bodies: Vec::new(),
        count: 0,
    };
    for world in root.all("worldbody") {
        names(world, &["body"], &mut builder.links);
        names(world, &["joint", "freejoint"], &mut builder.joints);
    }
    for world in root.all("worldbody") {
        builder.world(world)?;
    }
    builder.loops(&root)?;
    let references = builder.references;
    report.check()?;
    if let Some(total) = &settings.total_mass {
        let factor = inertial::scale(&mut model.links, total);
        let factor = factor.map(super::doubts::six_digits).unwrap_or_default();
        let item = format!("{} kg, by {factor}", total.text);
        report.groups.add("masses scaled to `settotalmass`", item);
    }
    equality::read(&root, &mut model, (&references, &defaults), &mut report)?;
    for section in &root.children {
        let name = section.name.as_str();
        if SECTIONS.contains(&name) {
            report.children(section, &[]);
        } else if !READ.contains(&name) {
            report.element(section, ROOT);
        }
    }
    model.warnings = report.lines();
    Ok(model)
}

/// Collects the names of elements of these kinds at any depth.
fn names(element: &Element, kinds: &[&str], found: &mut HashSet<String>) {
    for child in &element.children {
        if kinds.contains(&child.name.as_str()) {
            found.extend(child.get("name").map(str::to_owned));
        }
        names(child, kinds, found);
    }
}

//! Which model of an SDF is imported.

use super::report::SdfReport;
use super::values::{flag, numbers};
use crate::import::naming::{listed, shown};
use crate::import::number::Num;
use crate::import::xml::{Element, fault};
use anyhow::Result;

/// The model, and the gravity of its world.
pub(super) struct Selected<'e> {
    pub(super) model: &'e Element,
    pub(super) gravity: Option<[Num; 3]>,
}

const INCLUDED: &str = "models and lights from other files beside the model, not imported";
const STATIC: &str = "models that are static, not imported";

/// Returns the version of the format.
pub(super) fn version(root: &Element) -> (u32, u32) {
    let parse = |text: &str| {
        let (major, minor) = text.trim().split_once('.')?;
        let minor = minor.split('.').next()?;
        Some((major.parse().ok()?, minor.parse().ok()?))
    };
    root.get("version").and_then(parse).unwrap_or((1, 12))
}

/// Returns the only model of the file that is not static.
pub(super) fn select<'e>(root: &'e Element, report: &mut SdfReport) -> Result<Selected<'e>> {
    report.children(root, &["model", "world", "include"]);
    let model = moving(root, report)?;
    for child in &model.children {
        match child.name.as_str() {
            "model" => report.refuse(
                child.at,
                format!(
                    "model `{}` is inside of `{}`: nested models are not imported, write its links and joints into that model",
                    name(child),
                    name(model)
                ),
            ),
            "include" => refuse_include(child, report),
            _ => {}
        }
    }
    report.children(
        model,
        &[
            "pose", "static", "link", "joint", "frame", "model", "include",
        ],
    );
    let is_own = |it: &Element| std::ptr::eq(it, model);
    let mut worlds = root.all("world");
    let world = worlds.find(|world| world.all("model").any(is_own));
    let gravity = world.map(|world| gravity(world, model, version(root), report));
    let gravity = gravity.transpose()?;
    report.check()?;
    Ok(Selected { model, gravity })
}

/// Returns the only model that is not static, and refuses what connects it with others.
fn moving<'e>(root: &'e Element, report: &mut SdfReport) -> Result<&'e Element> {
    let inside = root.all("world").flat_map(|world| &world.children);
    let (mut moving, mut included) = (Vec::new(), Vec::new());
    for element in root.children.iter().chain(inside) {
        match element.name.as_str() {
            "model" => match flag(element, "static")? {
                Some(true) => report.groups.add(STATIC, format!("`{}`", name(element))),
                _ => moving.push(element),
            },
            "include" => included.push(element),
            "joint" => report.refuse(
                element.at,
                format!(
                    "joint `{}` connects models of a world: write it into one model",
                    name(element)
                ),
            ),
            _ => {}
        }
    }
    for element in included {
        match moving.is_empty() {
            true => refuse_include(element, report),
            false => report.groups.add(INCLUDED, format!("`{}`", uri(element))),
        }
    }
    match moving.as_slice() {
        [model] => Ok(model),
        [] => {
            report.check()?;
            let message =
                "this file has no model that moves: a mechanism is a `<model>` that is not static";
            Err(fault(root.at, message))
        }
        several => {
            let names = listed(several.iter().filter_map(|model| model.get("name")));
            let message = format!(
                "{} models move: {names}; a mechanism is one of them, so leave the others out",
                several.len()
            );
            Err(fault(several[1].at, message))
        }
    }
}

/// Returns the gravity of the world of a model, whose pose must be relative to the world.
fn gravity(
    world: &Element,
    model: &Element,
    version: (u32, u32),
    report: &mut SdfReport,
) -> Result<[Num; 3]> {
    report.children(world, &["model", "include", "joint", "gravity"]);
    let relative = model.child("pose").and_then(|pose| pose.get("relative_to"));
    if let Some(other) = relative.filter(|other| !other.is_empty() && *other != "world") {
        let what = format!(
            "the pose of model `{}` is relative to `{}`: write it relative to the world",
            name(model),
            shown(other)
        );
        report.refuse(model.at, what);
    }
    // It moved from the physics to the world with version 1.6.
    let physics = world.child("physics").filter(|_| version < (1, 6));
    let older = physics.and_then(|physics| physics.child("gravity"));
    match older.or(world.child("gravity")) {
        Some(stated) => numbers::<3>(stated),
        // The default of the format.
        None => Ok([0.0, 0.0, -9.8].map(Num::computed)),
    }
}

fn refuse_include(element: &Element, report: &mut SdfReport) {
    let what = format!(
        "`{}` is included from another file: write its links and joints into this model",
        uri(element)
    );
    report.refuse(element.at, what);
}

fn uri(include: &Element) -> String {
    let uri = include.child("uri").map_or("", |uri| uri.text.as_str());
    shown(uri)
}

fn name(model: &Element) -> String {
    shown(model.get("name").unwrap_or_default())
}

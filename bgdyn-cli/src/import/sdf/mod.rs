//! Reads an SDF, the format of Gazebo.
//!
//! The model of the file (`selection`) → its frames (`frames`) → links (`links`) and joints (`joints`) → the tree (`layout`,
//! `carriers`): a joint that carries no link closes a loop (`loops`). `values` reads the text of
//! elements, `report` collects what is left out or refused.
//!
//! A link's origin and axes are those of the joint that carries it, unless that is fixed; SDF's link frame may be
//! anywhere.

mod carriers;
mod frames;
mod joints;
mod layout;
mod links;
mod loops;
mod report;
mod selection;
mod values;

use super::joint_type::JointType;
use super::model::{Joint, Link, Model};
use super::naming::shown;
use super::xml::Element;
use anyhow::Result;
use frames::Frames;
use joints::{JointAxis, Motion};
use layout::{ModelLayout, ReadJoint, read_joint};
use report::SdfReport;

/// The root element of an SDF.
pub(super) const ROOT: &str = "sdf";

const REVERSED: &str = "joints that carry their parent here, with the opposite axis (a ball turns the other way round)";

/// Reads an SDF from its root element.
pub(super) fn read(root: &Element) -> Result<Model> {
    let mut report = SdfReport::default();
    let version = selection::version(root);
    let selected = selection::select(root, &mut report)?;
    let element = selected.model;
    let frames = Frames::read(element, version)?;
    let links: Vec<&Element> = element.all("link").collect();
    let mut joints = Vec::new();
    for joint in element.all("joint") {
        joints.extend(read_joint(joint, (&frames, &links), version, &mut report)?);
    }
    report.check()?;
    let carrier = carriers::carriers(&mut joints, links.len());
    let layout = ModelLayout::new((element, frames, links), &joints, carrier)?;
    for joint in joints.iter().filter(|joint| joint.reversed) {
        report
            .groups
            .add(REVERSED, format!("`{}`", shown(joint.name)));
    }
    let mut model = Model {
        name: element.get("name").unwrap_or_default().to_owned(),
        source: "an SDF".into(),
        gravity: selected.gravity,
        moving_base: false,
        free_roots: true,
        links: links::read(&layout, &mut report)?,
        joints: Vec::new(),
        frames: Vec::new(),
        loops: Vec::new(),
        incomplete: Vec::new(),
        warnings: Vec::new(),
    };
    let mut closing = Vec::new();
    for (j, joint) in joints.into_iter().enumerate() {
        match layout.carrier[joint.child] == Some(j) {
            true => add_joint(joint, &layout, &mut model),
            false => closing.push(joint),
        }
    }
    loops::add(closing, &layout, &mut model, &mut report);
    for frame in element.all("frame") {
        model.frames.push(layout.named(frame)?);
    }
    report.check()?;
    model.warnings = report.lines();
    Ok(model)
}

/// Adds a joint that carries a link: two, with a link without inertia between them, if it has two axes.
fn add_joint(joint: ReadJoint<'_>, layout: &ModelLayout<'_>, model: &mut Model) {
    let parent = joint.parent.map(|link| layout.name(link));
    let child = layout.name(joint.child);
    let (name, at) = (joint.name, joint.element.at);
    let second_name = joints::second_name(name);
    let names = match joint.reversed {
        false => [name, &second_name],
        true => [&second_name, name],
    };
    let origin = layout.place(layout.own[joint.child], joint.parent);
    let named = |name, kind, child: &str| Joint {
        kind,
        origin: origin.clone(),
        ..Joint::fixed(name, at, parent, child)
    };
    let placed = |kind, child: &str| named(name, kind, child);
    let about = |axis: JointAxis, joint: Joint| Joint {
        axis: axis.direction,
        limits: axis.limits,
        mimic: axis.mimic,
        effects: axis.effects,
        ..joint
    };
    match joint.motion {
        Motion::Fixed => model.joints.push(placed(JointType::Fixed, child)),
        Motion::Ball => model.joints.push(placed(JointType::Spherical, child)),
        Motion::Single(kind, axis, lead) => {
            let joint = about(*axis, placed(kind, child));
            model.joints.push(Joint { lead, ..joint });
        }
        Motion::Double(axes) => {
            let [first, second] = *axes;
            let taken = model.links.iter().map(|link| link.name.clone());
            let cross = super::naming::free_name(&format!("{name}_cross"), &taken.collect());
            model.links.push(Link {
                name: cross.clone(),
                at,
                inertial: None,
                place: None,
            });
            let kind = JointType::Revolute;
            model
                .joints
                .push(about(first, named(names[0], kind, &cross)));
            let turning = Joint {
                kind,
                ..Joint::fixed(names[1], at, Some(&cross), child)
            };
            model.joints.push(about(second, turning));
        }
    }
}

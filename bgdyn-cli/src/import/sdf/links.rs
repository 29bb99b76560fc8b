//! The links of an SDF with their inertia.

use super::layout::ModelLayout;
use super::report::SdfReport;
use super::values::{flag, number, pose};
use crate::import::attributes::name;
use crate::import::model::{Inertial, Link};
use crate::import::naming::shown;
use crate::import::number::Num;
use crate::import::placement::Placement;
use crate::import::xml::Element;
use anyhow::Result;

const NO_INERTIAL: &str =
    "links without `<inertial>`, to which the format gives 1 kg and 1 kg·m² about each axis";
const NO_INERTIA: &str =
    "links without `<inertia>`, to which the format gives 1 kg·m² about each axis";
const NO_GRAVITY: &str =
    "links on which no gravity acts in the file (`<gravity>`); it acts on them here";

/// Reads the links; those without a joint have their pose in the world.
pub(super) fn read(layout: &ModelLayout<'_>, report: &mut SdfReport) -> Result<Vec<Link>> {
    let mut links = Vec::new();
    for (index, element) in layout.links.iter().enumerate() {
        let own = name(element)?;
        let label = format!("`{}`", shown(own));
        report.children(element, &["pose", "inertial", "gravity"]);
        if flag(element, "gravity")? == Some(false) {
            report.groups.add(NO_GRAVITY, label.clone());
        }
        match element.child("inertial") {
            None => report.groups.add(NO_INERTIAL, label),
            Some(inertial) if inertial.child("inertia").is_none() => {
                report.groups.add(NO_INERTIA, label);
            }
            Some(_) => {}
        }
        let frame = layout.frames.own(element);
        let inertial = inertial(element, report)?;
        let place = layout.carrier[index]
            .is_none()
            .then(|| layout.place(layout.own[index], None));
        links.push(Link {
            name: own.to_owned(),
            at: element.at,
            inertial: Some(inertial.shifted(&layout.place(frame, Some(index)))),
            place: place.filter(|place| !place.is_identity()),
        });
    }
    Ok(links)
}

/// Reads the inertia of a link in its own frame: 1 kg and 1 kg·m² by default.
fn inertial(link: &Element, report: &mut SdfReport) -> Result<Inertial> {
    let empty = Element::empty("inertial", link.at);
    let element = link.child("inertial").unwrap_or(&empty);
    report.children(element, &["mass", "pose", "inertia"]);
    if element
        .get("auto")
        .is_some_and(|auto| auto == "true" || auto == "1")
    {
        let what = format!(
            "the inertia of link `{}` is that of its collisions (`auto`), which is not computed here: write mass, pose and inertia",
            shown(link.get("name").unwrap_or_default())
        );
        report.refuse(element.at, what);
    }
    let place = element.child("pose").map(pose).transpose()?;
    let Placement { xyz: com, rpy } = place.unwrap_or_else(Placement::identity);
    let none = Element::empty("inertia", element.at);
    let tensor = element.child("inertia").unwrap_or(&none);
    report.children(tensor, &["ixx", "iyy", "izz", "ixy", "ixz", "iyz"]);
    let or = |parent: &Element, name: &str, default: f64| -> Result<Num> {
        let stated = number(parent, name)?.filter(|x| x.value.is_finite());
        Ok(stated.unwrap_or(Num::computed(default)))
    };
    Ok(Inertial {
        mass: or(element, "mass", 1.0)?,
        com,
        rpy,
        tensor: [
            or(tensor, "ixx", 1.0)?,
            or(tensor, "iyy", 1.0)?,
            or(tensor, "izz", 1.0)?,
            or(tensor, "ixy", 0.0)?,
            or(tensor, "ixz", 0.0)?,
            or(tensor, "iyz", 0.0)?,
        ],
    })
}

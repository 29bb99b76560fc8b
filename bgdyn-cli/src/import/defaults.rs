//! Fills in default values for elements that a URDF requires but does not have.

use super::groups::Groups;
use super::naming::shown;
use super::select::version;
use super::xml::Element;

/// The parts of an inertial, besides its origin.
pub(super) const INERTIAL: [(&str, &[&str]); 2] = [
    ("mass", &["value"]),
    ("inertia", &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]),
];

/// Adds missing required elements, and records them.
pub(super) fn complete(root: &mut Element, groups: &mut Groups) {
    let velocity_needed = version(root) < (1, 2);
    for element in &mut root.children {
        let name = shown(element.get("name").unwrap_or_default());
        let moving = element.get("type").is_some_and(|kind| kind != "fixed");
        for child in &mut element.children {
            if child.name == "inertial" {
                let missing = complete_inertial(child);
                if !missing.is_empty() {
                    let item = format!("`{name}`: {}", missing.join(", "));
                    groups.add("inertials without all their parts, read as 0", item);
                }
            } else if child.name == "limit" && velocity_needed {
                let missing = |attribute: &&str| child.get(attribute).is_none();
                let missing: Vec<&str> =
                    ["velocity", "effort"].into_iter().filter(missing).collect();
                if moving && !missing.is_empty() {
                    let item = format!("`{name}`: {}", missing.join(", "));
                    groups.add(
                        "joints whose `<limit>` lacks what a URDF must give, none written",
                        item,
                    );
                }
            }
        }
    }
}

fn complete_inertial(inertial: &mut Element) -> Vec<String> {
    let mut all_missing = Vec::new();
    for (part, attributes) in INERTIAL {
        let index = inertial
            .children
            .iter()
            .position(|child| child.name == part);
        let index = index.unwrap_or_else(|| {
            inertial.children.push(Element::empty(part, inertial.at));
            all_missing.push(format!("<{part}>"));
            inertial.children.len() - 1
        });
        let reported = all_missing
            .last()
            .is_some_and(|last| *last == format!("<{part}>"));
        let element = &mut inertial.children[index];
        for attribute in attributes {
            if element.get(attribute).is_none() {
                element.attributes.push((attribute.to_string(), "0".into()));
                if !reported {
                    all_missing.push(format!("{attribute} of <{part}>"));
                }
            }
        }
    }
    all_missing
}

//! Selects the elements of a URDF that a mechanism can represent, and counts all others by name.

use super::tally::Tally;
use super::xml::{Element, fault};
use anyhow::Result;

/// An element that is imported: its attributes, and the elements inside it.
struct Kind {
    name: &'static str,
    attributes: Attributes,
    children: &'static [Kind],
    /// Whether its parent may have only one.
    once: bool,
}

enum Attributes {
    These(&'static [&'static str]),
    /// All of them: the reader of the element reports their use.
    Any,
}
use Attributes::{Any, These};

const fn leaf(name: &'static str, attributes: &'static [&'static str]) -> Kind {
    Kind {
        name,
        attributes: These(attributes),
        children: &[],
        once: true,
    }
}

const fn reported(name: &'static str) -> Kind {
    Kind {
        name,
        attributes: Any,
        children: &[],
        once: true,
    }
}

const ORIGIN: Kind = leaf("origin", &["xyz", "rpy", "quat_xyzw"]);

const LINK: &[Kind] = &[Kind {
    name: "inertial",
    attributes: These(&[]),
    children: &[
        ORIGIN,
        leaf("mass", &["value"]),
        leaf("inertia", &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]),
    ],
    once: true,
}];

const JOINT: &[Kind] = &[
    ORIGIN,
    leaf("parent", &["link"]),
    leaf("child", &["link"]),
    leaf("axis", &["xyz"]),
    leaf("limit", &["lower", "upper", "velocity", "effort"]),
    leaf("mimic", &["joint", "multiplier", "offset"]),
    reported("dynamics"),
];

const ROBOT: Kind = Kind {
    name: "robot",
    attributes: These(&["name", "version"]),
    children: &[
        Kind {
            name: "link",
            attributes: These(&["name"]),
            children: LINK,
            once: false,
        },
        Kind {
            name: "joint",
            attributes: These(&["name", "type"]),
            children: JOINT,
            once: false,
        },
    ],
    once: true,
};

/// Returns the part of the robot that can be imported, and one line for each kind of element that cannot.
pub(super) fn select(root: &Element) -> Result<(Element, Vec<String>)> {
    if root.name != ROBOT.name {
        return Err(fault(
            root.at,
            format_args!(
                "the root of a URDF is `<robot>`, that of an MJCF `<mujoco>`, that of an SDF `<sdf>`; this is `<{}>`",
                root.name
            ),
        ));
    }
    let mut ignored = Tally::default();
    let quaternions = version(root) >= (1, 1);
    let kept = keep(root, &ROBOT, quaternions, &mut ignored)?;
    Ok((kept, ignored.lines().collect()))
}

fn keep(element: &Element, kind: &Kind, quaternions: bool, ignored: &mut Tally) -> Result<Element> {
    let Element { name, at, .. } = element;
    let mut kept = Element::empty(name, *at);
    if !element.text.is_empty() {
        ignored.count(format!("text in `<{name}>`"), 0);
    }
    for (attribute, value) in &element.attributes {
        let known = match kind.attributes {
            These(list) => list.contains(&attribute.as_str()),
            Any => true,
        };
        if known && (attribute != "quat_xyzw" || quaternions) {
            kept.attributes.push((attribute.clone(), value.clone()));
        } else {
            ignored.count(format!("attribute `{attribute}` of `<{name}>`"), 0);
        }
    }
    for child in &element.children {
        match kind.children.iter().find(|kind| kind.name == child.name) {
            Some(kind) if kind.once && kept.child(&child.name).is_some() => {
                let message = format!(
                    "a second `<{}>` in the `<{name}>` of line {}",
                    child.name, at.0
                );
                return Err(fault(child.at, message));
            }
            Some(kind) => kept.children.push(keep(child, kind, quaternions, ignored)?),
            None => ignored.count(
                format!("`<{}>` in `<{name}>`", child.name),
                child.count("mesh"),
            ),
        }
    }
    Ok(kept)
}

/// Returns the version of the format; 1.0 if it is missing or malformed.
pub(super) fn version(root: &Element) -> (u32, u32) {
    let parse = |text: &str| {
        let (major, minor) = text.trim().split_once('.')?;
        Some((major.parse().ok()?, minor.parse().ok()?))
    };
    root.get("version").and_then(parse).unwrap_or((1, 0))
}

//! Parses URDF text into links and joints, with the original text of numbers.

use super::attributes::{end, finite, name, numbers, place, turn};
use super::defaults::{INERTIAL, complete};
use super::groups::Groups;
use super::joint_type::JointType;
use super::limits::{check_limit, limits};
use super::mimic;
use super::model::{Inertial, Joint, JointEffects, Limits, Link, Model};
use super::naming::shown;
use super::number::Num;
use super::placement::Placement;
use super::select::{select, version};
use super::xml::{Element, fault};
use anyhow::Result;

/// Reads a URDF from its root element, by the rules of the version in the file.
pub(super) fn read(root: &Element) -> Result<Model> {
    let (mut root, ignored) = select(root)?;
    refuse_types(&root)?;
    let mut groups = Groups::default();
    complete(&mut root, &mut groups);
    let links = root.all("link").map(link).collect::<Result<_>>()?;
    let strict = version(&root) >= (1, 2);
    let joints = root.all("joint");
    let joints = joints
        .map(|element| joint(element, strict, &mut groups))
        .collect::<Result<_>>()?;
    Ok(Model {
        name: root.get("name").unwrap_or_default().to_string(),
        source: "a URDF".into(),
        gravity: None,
        moving_base: false,
        free_roots: false,
        links,
        joints,
        frames: Vec::new(),
        loops: Vec::new(),
        incomplete: Vec::new(),
        warnings: groups.lines().chain(ignored).collect(),
    })
}

/// Returns one error for all joints of types that a mechanism does not have.
fn refuse_types(root: &Element) -> Result<()> {
    let mut first = None;
    let mut wrong = Vec::new();
    for joint in root.all("joint") {
        let name = shown(name(joint)?);
        match joint.get("type") {
            Some(kind) if JointType::of_urdf(kind).is_some() => continue,
            Some(kind) => wrong.push(format!("joint `{name}` is `{}`", shown(kind))),
            None => wrong.push(format!("joint `{name}` has no type")),
        }
        first = first.or(Some(joint.at));
    }
    let Some(at) = first else { return Ok(()) };
    let wrong = wrong.join(", ");
    Err(fault(
        at,
        format_args!(
            "{wrong}: the types of a URDF are revolute, continuous, prismatic, fixed, floating and planar; \
             change the type, or build the motion of several such joints"
        ),
    ))
}

fn link(element: &Element) -> Result<Link> {
    let inertial = element
        .child("inertial")
        .map(|inertial| -> Result<Inertial> {
            let origin = inertial.child("origin");
            let [mass, inertia] =
                INERTIAL.map(|(part, _)| inertial.child(part).unwrap_or(inertial));
            let entry = |attribute| finite(inertia, attribute);
            Ok(Inertial {
                mass: finite(mass, "value")?,
                com: place(origin)?,
                rpy: origin.map_or(Ok(Num::zeros()), turn)?,
                tensor: [
                    entry("ixx")?,
                    entry("iyy")?,
                    entry("izz")?,
                    entry("ixy")?,
                    entry("ixz")?,
                    entry("iyz")?,
                ],
            })
        });
    Ok(Link {
        name: name(element)?.to_string(),
        at: element.at,
        inertial: inertial.transpose()?,
        place: None,
    })
}

/// The default axis of a joint without `<axis>`: x.
const DEFAULT_AXIS: [f64; 3] = [1.0, 0.0, 0.0];

/// Parses one joint. `strict`: the file's version is 1.2 or later.
fn joint(element: &Element, strict: bool, groups: &mut Groups) -> Result<Joint> {
    let joint_name = name(element)?;
    let label = format!("`{}`", shown(joint_name));
    let kind = element.get("type").and_then(JointType::of_urdf);
    // Other types were refused.
    let kind = kind.unwrap_or(JointType::Fixed);
    let (parent, child) = (end(element, "parent")?, end(element, "child")?);
    let origin = element.child("origin");
    let origin = Placement {
        rpy: origin.map_or(Ok(Num::zeros()), turn)?,
        xyz: place(origin)?,
    };
    if let Some(limit) = element.child("limit") {
        check_limit(limit, strict, &label)?;
    }
    let axis = match element.child("axis") {
        Some(axis) => numbers(axis, "xyz")?,
        None => DEFAULT_AXIS.map(Num::computed),
    };
    let fixed = kind == JointType::Fixed;
    for (part, unused) in [
        ("axis", !kind.has_axis() && kind != JointType::Planar),
        ("limit", !kind.is_scalar()),
        ("mimic", fixed),
    ] {
        if unused && element.child(part).is_some() {
            let item = format!("<{part}> of {label}");
            groups.add(without_meaning(kind), item);
        }
    }
    if (kind.has_axis() || kind == JointType::Planar) && axis.iter().all(Num::is_zero) {
        let at = element.child("axis").map_or(element.at, |axis| axis.at);
        return Err(fault(at, format_args!("the axis of joint {label} is zero")));
    }
    let limits = match kind.is_scalar() {
        true => limits(element, kind, strict, &label, groups)?,
        false => Limits::default(),
    };
    Ok(Joint {
        name: joint_name.to_string(),
        at: element.at,
        kind,
        parent: Some(parent.to_string()),
        child: child.to_string(),
        origin,
        axis,
        lead: None,
        limits,
        mimic: match element.child("mimic") {
            Some(mimic) if !fixed => Some(mimic::read(mimic)?),
            _ => None,
        },
        effects: dynamics(element, kind, &label, groups),
    })
}

/// Returns the words for parts that a joint of this type does not use.
fn without_meaning(kind: JointType) -> &'static str {
    match kind {
        JointType::Floating => "without meaning on floating joints, left out",
        JointType::Planar => "of planar joints, which have no limits here, left out",
        _ => "without meaning on fixed joints, left out",
    }
}

/// Parses a joint's damping and friction; reports values that a mechanism cannot represent.
fn dynamics(element: &Element, kind: JointType, label: &str, groups: &mut Groups) -> JointEffects {
    let mut effects = JointEffects::default();
    let Some(dynamics) = element.child("dynamics") else {
        return effects;
    };
    let mut left = Vec::new();
    for (name, value) in &dynamics.attributes {
        let number = Num::parse(value);
        if number.as_ref().is_some_and(Num::is_zero) {
            continue;
        }
        let sound = number.filter(|x| x.value.is_finite() && x.value > 0.0);
        let slot = match name.as_str() {
            "damping" => Some(&mut effects.damping),
            "friction" => Some(&mut effects.friction),
            _ => None,
        };
        match (slot, sound) {
            (Some(slot), Some(sound)) if kind.is_scalar() => *slot = Some(sound),
            _ => left.push((name.clone(), value.clone())),
        }
    }
    if !left.is_empty() {
        groups.add(
            "of `<dynamics>`, not imported",
            format!("{label} ({})", values(&left)),
        );
    }
    effects
}

fn values(attributes: &[(String, String)]) -> String {
    let show = |(name, value): &(String, String)| format!("{name} {}", shown(value.trim()));
    attributes.iter().map(show).collect::<Vec<_>>().join(", ")
}

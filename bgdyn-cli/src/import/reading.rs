//! Parses URDF text into links and joints, with the original text of numbers.

use super::attributes::{bound, end, finite, name, numbers, place, turn};
use super::defaults::{INERTIAL, complete};
use super::groups::Groups;
use super::joint_type::JointType;
use super::naming::shown;
use super::number::Num;
use super::placement::Placement;
use super::select::{select, version};
use super::xml::{At, Element, fault, parse};
use anyhow::Result;

/// The part of a robot that a mechanism can represent.
pub(super) struct Model {
    pub(super) name: String,
    /// Its source: the first words of the mechanism's comment.
    pub(super) source: String,
    pub(super) links: Vec<Link>,
    /// In the order of the file.
    pub(super) joints: Vec<Joint>,
    /// Sites on links that are no bodies.
    pub(super) frames: Vec<Frame>,
    pub(super) warnings: Vec<String>,
}

pub(super) struct Link {
    pub(super) name: String,
    pub(super) at: At,
    pub(super) inertial: Option<Inertial>,
    /// Pose in the world of a link without a joint; by default its origin.
    pub(super) place: Option<Placement>,
}

/// A named site on a link.
pub(super) struct Frame {
    pub(super) name: String,
    /// The name of its link.
    pub(super) link: String,
    pub(super) place: Placement,
}

impl Link {
    /// Returns whether it has a mass or a tensor.
    pub(super) fn is_body(&self) -> bool {
        let inertial = self.inertial.as_ref();
        inertial.is_some_and(|it| !it.mass.is_zero() || !it.tensor.iter().all(Num::is_zero))
    }
}

pub(super) struct Inertial {
    pub(super) mass: Num,
    pub(super) com: [Num; 3],
    pub(super) rpy: [Num; 3],
    /// xx, yy, zz, xy, xz, yz.
    pub(super) tensor: [Num; 6],
}

pub(super) struct Joint {
    pub(super) name: String,
    pub(super) at: At,
    pub(super) kind: JointType,
    pub(super) parent: String,
    pub(super) child: String,
    pub(super) origin: Placement,
    pub(super) axis: [Num; 3],
    pub(super) limits: Limits,
    /// Viscous damping, N·m·s/rad or N·s/m; `None` if it is 0.
    pub(super) damping: Option<Num>,
    /// Coulomb friction, N·m or N; `None` if it is 0.
    pub(super) friction: Option<Num>,
}

#[derive(Default)]
pub(super) struct Limits {
    pub(super) lower: Option<Num>,
    pub(super) upper: Option<Num>,
    pub(super) velocity: Option<Num>,
    pub(super) effort: Option<Num>,
}

/// Parses a URDF, by the rules of the version in the file.
pub(super) fn read(text: &str) -> Result<Model> {
    let (mut root, ignored) = select(&parse(text)?)?;
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
        links,
        joints,
        frames: Vec::new(),
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
            Some(kind) if JointType::parse(kind).is_some() => continue,
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
            "{wrong}: a mechanism's joints are revolute, continuous, prismatic or fixed; \
             change the type (`fixed` for a base that is to stand), or build the motion of several such joints"
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
    let kind = element.get("type").and_then(JointType::parse);
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
    let mut limits = Limits::default();
    if kind == JointType::Fixed {
        for part in ["axis", "limit"]
            .into_iter()
            .filter(|part| element.child(part).is_some())
        {
            groups.add(
                "without meaning on fixed joints, left out",
                format!("<{part}> of {label}"),
            );
        }
    } else {
        if axis.iter().all(Num::is_zero) {
            let at = element.child("axis").map_or(element.at, |axis| axis.at);
            return Err(fault(at, format_args!("the axis of joint {label} is zero")));
        }
        limits = self::limits(element, kind, strict, &label, groups)?;
    }
    let [damping, friction] = dynamics(element, kind, &label, groups);
    Ok(Joint {
        name: joint_name.to_string(),
        at: element.at,
        kind,
        parent: parent.to_string(),
        child: child.to_string(),
        origin,
        axis,
        limits,
        damping,
        friction,
    })
}

/// Checks that every limit is a number. Since version 1.2 no range may be empty, and no velocity or effort
/// negative.
fn check_limit(limit: &Element, strict: bool, label: &str) -> Result<()> {
    let bounds = ["lower", "upper", "velocity", "effort"].map(|attribute| bound(limit, attribute));
    let [lower, upper, velocity, effort] = bounds;
    let (lower, upper) = (lower?, upper?);
    let at_least_zero = [("velocity", velocity?), ("effort", effort?)];
    if !strict {
        return Ok(());
    }
    if let (Some(lower), Some(upper)) = (lower, upper)
        && upper.value < lower.value
    {
        let (lower, upper) = (lower.text, upper.text);
        let message = format_args!(
            "the upper limit {upper} of joint {label} is below the lower one, {lower}"
        );
        return Err(fault(limit.at, message));
    }
    for (attribute, value) in at_least_zero {
        if let Some(value) = value.filter(|value| value.value < 0.0) {
            let message = format!(
                "the {attribute} limit {} of joint {label} is negative",
                value.text
            );
            return Err(fault(limit.at, message));
        }
    }
    Ok(())
}

/// Parses the limits of a joint that moves. Before version 1.2 a missing position limit is 0, since then
/// there is none.
fn limits(
    element: &Element,
    kind: JointType,
    strict: bool,
    label: &str,
    groups: &mut Groups,
) -> Result<Limits> {
    let continuous = kind == JointType::Continuous;
    let Some(limit) = element.child("limit") else {
        if !continuous {
            groups.add(
                "joints without `<limit>`, taken over without limits",
                label.to_string(),
            );
        }
        return Ok(Limits::default());
    };
    let mut limits = Limits::default();
    for attribute in ["lower", "upper"] {
        let given = bound(limit, attribute)?;
        if continuous {
            if given.is_some() {
                let item = format!("{attribute} of {label}");
                groups.add("position limits of continuous joints, not taken over", item);
            }
            continue;
        }
        if given.is_none() && !strict {
            let item = format!("{attribute} of {label}");
            groups.add(
                "position limits that the URDF leaves out, which it defines to be 0",
                item,
            );
        }
        let value = given.or_else(|| (!strict).then(Num::zero));
        let slot = if attribute == "lower" {
            &mut limits.lower
        } else {
            &mut limits.upper
        };
        *slot = value.filter(|value| value.value.is_finite());
    }
    for attribute in ["velocity", "effort"] {
        let value =
            bound(limit, attribute)?.filter(|value| value.value.is_finite() || value.value < 0.0);
        if value.as_ref().is_some_and(|value| value.value < 0.0) {
            let item = format!("{attribute} of {label}");
            groups.add("negative limits, not taken over", item);
            continue;
        }
        let slot = if attribute == "velocity" {
            &mut limits.velocity
        } else {
            &mut limits.effort
        };
        *slot = value;
    }
    if let (Some(lower), Some(upper)) = (&limits.lower, &limits.upper)
        && lower.value > upper.value
    {
        let item = format!("{label} from {} to {}", lower.text, upper.text);
        groups.add(
            "lower limit above the upper one, which `bgdyn check` may refuse",
            item,
        );
    }
    Ok(limits)
}

/// Parses a joint's damping and friction; reports values that a mechanism cannot represent.
fn dynamics(
    element: &Element,
    kind: JointType,
    label: &str,
    groups: &mut Groups,
) -> [Option<Num>; 2] {
    if let Some(mimic) = element.child("mimic") {
        let item = format!("{label} ({})", values(&mimic.attributes));
        groups.add(
            "mimic is not taken over, the joints become independent",
            item,
        );
    }
    let Some(dynamics) = element.child("dynamics") else {
        return [None, None];
    };
    let mut taken = [None, None];
    let mut left = Vec::new();
    for (name, value) in &dynamics.attributes {
        let number = Num::parse(value);
        if number.as_ref().is_some_and(Num::is_zero) {
            continue;
        }
        let sound = number.filter(|x| x.value.is_finite() && x.value > 0.0);
        let slot = ["damping", "friction"]
            .iter()
            .position(|known| known == name);
        match (slot, sound) {
            (Some(slot), Some(sound)) if kind != JointType::Fixed => taken[slot] = Some(sound),
            _ => left.push((name.clone(), value.clone())),
        }
    }
    if !left.is_empty() {
        groups.add(
            "of `<dynamics>`, not taken over",
            format!("{label} ({})", values(&left)),
        );
    }
    taken
}

fn values(attributes: &[(String, String)]) -> String {
    let show = |(name, value): &(String, String)| format!("{name} {}", shown(value.trim()));
    attributes.iter().map(show).collect::<Vec<_>>().join(", ")
}

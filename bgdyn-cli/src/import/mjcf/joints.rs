//! Joints of a body: their motion, limits, and what acts at them.

use super::pose::exact;
use super::report::Report;
use super::settings::{Settings, one_of};
use crate::import::attributes::{finite, numbers};
use crate::import::joint_type::JointType;
use crate::import::model::{JointEffects, Limits};
use crate::import::naming::shown;
use crate::import::number::{Num, all_zero};
use crate::import::placement::{Placement, Pose, displaced, turned, unit};
use crate::import::xml::{At, Element, fault};
use anyhow::Result;

/// A joint in the axes of its body.
pub(super) struct MjcfJoint {
    /// The name in the file; empty without one.
    pub(super) name: String,
    pub(super) at: At,
    pub(super) kind: JointType,
    /// The anchor in the body's axes.
    pub(super) anchor: [Num; 3],
    /// In the body's axes.
    pub(super) axis: [Num; 3],
    /// The position at which the body has the pose of the file.
    pub(super) reference: Num,
    pub(super) limits: Limits,
    pub(super) effects: JointEffects,
}

/// Reads a `<joint>`, given with the attributes of its class, or a `<freejoint>`. `frame` is the pose of its
/// `<frame>` in the body.
pub(super) fn read(
    element: &Element,
    frame: &Placement,
    settings: &Settings,
    report: &mut Report,
) -> Result<MjcfJoint> {
    let kinds = [
        ("free", JointType::Floating),
        ("ball", JointType::Spherical),
        ("slide", JointType::Prismatic),
        ("hinge", JointType::Revolute),
    ];
    let kind = match (element.name.as_str(), element.get("type")) {
        ("freejoint", _) => JointType::Floating,
        (_, None) => JointType::Revolute,
        (_, Some(_)) => one_of(element, "type", &kinds)?,
    };
    let name = element.get("name").unwrap_or_default();
    let label = match name {
        "" => format!("the {} joint of line {}", kind.keyword(), element.at.0),
        name => format!("`{}`", shown(name)),
    };
    let [mut anchor, mut axis] = [Num::zeros(), [0.0, 0.0, 1.0].map(Num::computed)];
    for (attribute, slot) in [("pos", &mut anchor), ("axis", &mut axis)] {
        if element.get(attribute).is_some() {
            *slot = numbers(element, attribute)?;
        }
    }
    if axis.iter().all(Num::is_zero) {
        let message = format!("the axis of joint {label} is zero");
        return Err(fault(element.at, message));
    }
    let plain = |xyz| Placement {
        xyz,
        rpy: Num::zeros(),
    };
    if !all_zero(&frame.rpy) {
        let turned = frame.pose().rotation * exact(&axis);
        axis = displaced(turned.0).placement().xyz;
    }
    let anchor = frame.then(&plain(anchor)).xyz;
    let mut joint = MjcfJoint {
        name: name.to_owned(),
        at: element.at,
        kind,
        anchor,
        axis,
        reference: Num::zero(),
        limits: Limits::default(),
        effects: JointEffects::default(),
    };
    if kind.is_scalar() {
        let angle = |number: Num| match kind {
            JointType::Revolute => settings.angle(&number),
            _ => number,
        };
        if element.get("ref").is_some() {
            joint.reference = angle(finite(element, "ref")?);
        }
        joint.limits = limits(element, settings, &angle)?;
        joint.effects = effects(element, &label, &angle, report)?;
    } else {
        for attribute in ["range", "stiffness", "damping", "frictionloss", "armature"] {
            if acts(element, attribute) {
                let value = shown(element.get(attribute).unwrap_or_default().trim());
                let item = format!("{attribute} {value} of {label}");
                let kind = "of ball and free joints, not imported";
                report.groups.add(kind, item);
            }
        }
    }
    Ok(joint)
}

/// Returns whether an attribute has a number that is not 0.
fn acts(element: &Element, attribute: &str) -> bool {
    let mut texts = element
        .get(attribute)
        .unwrap_or_default()
        .split_whitespace();
    texts.any(|text| Num::parse(text).is_none_or(|number| !number.is_zero()))
}

/// Returns the range of a limited joint.
fn limits(element: &Element, settings: &Settings, angle: &impl Fn(Num) -> Num) -> Result<Limits> {
    let ranged = element.get("range").is_some();
    let limited = match element.get("limited") {
        // A range that is empty limits nothing: so a joint undoes the range of its class.
        None | Some("auto") => {
            let wide = |[lower, upper]: [Num; 2]| lower.value < upper.value;
            ranged && settings.autolimits && wide(numbers::<2>(element, "range")?)
        }
        Some(_) => one_of(element, "limited", &[("true", true), ("false", false)])?,
    };
    if !limited {
        return Ok(Limits::default());
    }
    if !ranged {
        let message = "this joint is limited and has no `range`";
        return Err(fault(element.at, message));
    }
    let [lower, upper] = numbers::<2>(element, "range")?.map(angle);
    Ok(Limits {
        lower: Some(lower),
        upper: Some(upper),
        ..Limits::default()
    })
}

/// Returns what acts at a joint with one coordinate.
fn effects(
    element: &Element,
    label: &str,
    angle: &impl Fn(Num) -> Num,
    report: &mut Report,
) -> Result<JointEffects> {
    let mut number = |attribute: &str| -> Result<Option<Num>> {
        if !acts(element, attribute) {
            return Ok(None);
        }
        let text = element.get(attribute).unwrap_or_default();
        if text.split_whitespace().count() > 1 {
            // Coefficients of a polynomial.
            let item = format!("{attribute} {} of {label}", shown(text.trim()));
            let kind = "polynomials, not imported";
            report.groups.add(kind, item);
            return Ok(None);
        }
        let number = finite(element, attribute)?;
        if number.value < 0.0 {
            let item = format!("{attribute} {} of {label}", number.text);
            report.groups.add("negative, not imported", item);
            return Ok(None);
        }
        Ok(Some(number))
    };
    let stiffness = number("stiffness")?;
    let [damping, friction] = [number("damping")?, number("frictionloss")?];
    let rotor = number("armature")?;
    let rest = match element.get("springref") {
        Some(_) if stiffness.is_some() => Some(angle(finite(element, "springref")?)),
        _ => None,
    };
    Ok(JointEffects {
        damping,
        friction,
        stiffness,
        rest,
        rotor,
    })
}

impl MjcfJoint {
    /// Returns the pose, in the joint's axes at its reference, of its axes at the coordinate 0.
    pub(super) fn at_zero(&self) -> Placement {
        if self.reference.is_zero() {
            return Placement::identity();
        }
        let (axis, back) = (exact(&self.axis), -self.reference.exact());
        let moved: Pose = match self.kind {
            JointType::Prismatic => displaced(unit(axis).scale(back).0),
            _ => turned(axis, back),
        };
        moved.placement()
    }
}

//! The joints of an SDF: their types, axes, limits, and what acts at them.

use super::frames::{Frames, OWN};
use super::report::SdfReport;
use super::values::{flag, number, numbers};
use crate::import::joint_type::JointType;
use crate::import::model::{JointEffects, Limits, Mimic};
use crate::import::naming::shown;
use crate::import::number::Num;
use crate::import::placement::displaced;
use crate::import::xml::{Element, fault};
use anyhow::Result;
use bgdyn_codegen::math::Vec3;
use bgdyn_runtime::Dd;

/// The motion of a joint, with what its axes have.
pub(super) enum Motion {
    Fixed,
    Ball,
    /// One axis: a rotation, a translation or a screw with its lead.
    Single(JointType, Box<JointAxis>, Option<Num>),
    /// Two rotations, one after the other; whether the second axis is meant to be perpendicular.
    Double(Box<[JointAxis; 2]>),
}

impl Motion {
    /// Converts it to that of the parent relative to the child: the same coordinates about the opposite axes.
    pub(super) fn reverse(&mut self) {
        match self {
            Motion::Fixed | Motion::Ball => {}
            Motion::Single(_, axis, _) => axis.negate(),
            Motion::Double(axes) => {
                axes.swap(0, 1);
                axes.iter_mut().for_each(JointAxis::negate);
            }
        }
    }

    /// Returns its axes.
    pub(super) fn axes(&self) -> &[JointAxis] {
        match self {
            Motion::Fixed | Motion::Ball => &[],
            Motion::Single(_, axis, _) => std::slice::from_ref(&**axis),
            Motion::Double(axes) => &**axes,
        }
    }
}

/// An axis with what a mechanism needs of it.
pub(super) struct JointAxis {
    /// In the axes of the joint's frame.
    pub(super) direction: [Num; 3],
    pub(super) limits: Limits,
    pub(super) effects: JointEffects,
    pub(super) mimic: Option<Mimic>,
}

impl JointAxis {
    fn negate(&mut self) {
        for x in &mut self.direction {
            *x = x.negated();
        }
    }
}

/// Limits of this size mean that there is none.
const NO_LIMIT: f64 = 1e16;

const INITIAL: &str =
    "`<initial_position>`, which a mechanism does not have (a scene has `initial`)";
const OLD_FRAME: &str =
    "`<use_parent_model_frame>`, which has no effect since version 1.7 (write `expressed_in`)";
const NEGATIVE: &str = "of `<dynamics>`, not imported";

/// Reads the motion of a joint with this frame; `None` for a type that a mechanism does not have, which the report
/// refuses.
pub(super) fn motion(
    element: &Element,
    (frames, frame): (&Frames, usize),
    version: (u32, u32),
    report: &mut SdfReport,
) -> Result<Option<Motion>> {
    let mut axis = |name: &str| read_axis(element, name, (frames, frame), version, report);
    let stated = element.get("type").unwrap_or_default();
    let kind = stated.to_ascii_lowercase();
    let label = shown(element.get("name").unwrap_or_default());
    let single = |kind, axis, lead| Ok(Some(Motion::Single(kind, Box::new(axis), lead)));
    match kind.as_str() {
        "fixed" => Ok(Some(Motion::Fixed)),
        "ball" => Ok(Some(Motion::Ball)),
        "revolute" => single(JointType::Revolute, axis("axis")?, None),
        "continuous" => {
            let mut axis = axis("axis")?;
            (axis.limits.lower, axis.limits.upper) = (None, None);
            single(JointType::Continuous, axis, None)
        }
        "prismatic" => single(JointType::Prismatic, axis("axis")?, None),
        "screw" => {
            let lead = lead(element)?;
            match lead.is_zero() {
                true => single(JointType::Revolute, axis("axis")?, None),
                false => single(JointType::Helical, axis("axis")?, Some(lead)),
            }
        }
        "universal" | "revolute2" => {
            let both = [axis("axis")?, axis("axis2")?];
            Ok(Some(Motion::Double(Box::new(both))))
        }
        "gearbox" => {
            let what = format!(
                "joint `{label}` is a gearbox: leave it out, and write a constraint of type `gear` into the mechanism"
            );
            report.refuse(element.at, what);
            Ok(None)
        }
        _ => {
            let what = format!(
                "joint `{label}` is `{}`: the types are revolute, continuous, prismatic, screw, universal, revolute2, ball and fixed",
                shown(stated)
            );
            report.refuse(element.at, what);
            Ok(None)
        }
    }
}

/// Returns the displacement of a screw for each turn: 1 m by default. The older `thread_pitch` is in rad/m, and counts
/// the other way round.
fn lead(element: &Element) -> Result<Num> {
    if let Some(lead) = number(element, "screw_thread_pitch")? {
        return Ok(lead);
    }
    let Some(pitch) = number(element, "thread_pitch")? else {
        return Ok(Num::computed(1.0));
    };
    if pitch.is_zero() {
        return Err(fault(
            element.at,
            "`<thread_pitch>` of 0 rad/m is no screw: write a prismatic joint",
        ));
    }
    let lead = -(Dd::PI * Dd::from_f64(2.0)) / pitch.exact();
    Ok(Num::computed(lead.to_f64()))
}

fn read_axis(
    joint: &Element,
    name: &str,
    (frames, frame): (&Frames, usize),
    version: (u32, u32),
    report: &mut SdfReport,
) -> Result<JointAxis> {
    let label = match name {
        "axis" => format!("`{}`", shown(joint.get("name").unwrap_or_default())),
        _ => format!("`{}` (axis2)", shown(joint.get("name").unwrap_or_default())),
    };
    let Some(element) = joint.child(name) else {
        let message = format!("joint {label} has no `<{name}>`");
        return Err(fault(joint.at, message));
    };
    let direction = direction(element, (frames, frame), version)?;
    if direction.iter().all(Num::is_zero) {
        let message = format!("the axis of joint {label} is zero");
        return Err(fault(element.at, message));
    }
    if version >= (1, 7) && flag(element, "use_parent_model_frame")? == Some(true) {
        report.groups.add(OLD_FRAME, label.clone());
    }
    if number(element, "initial_position")?.is_some_and(|x| !x.is_zero()) {
        report.groups.add(INITIAL, label.clone());
    }
    report.children(
        element,
        &[
            "xyz",
            "limit",
            "dynamics",
            "mimic",
            "use_parent_model_frame",
            "initial_position",
        ],
    );
    Ok(JointAxis {
        direction,
        limits: limits(element)?,
        effects: effects(element, &label, report)?,
        mimic: element.child("mimic").map(mimic).transpose()?,
    })
}

/// Returns the direction of an axis in the joint's frame. Up to version 1.4 it is given in the model's frame, up to 1.6 if
/// the file says so, since then in the frame that it names.
fn direction(
    element: &Element,
    (frames, frame): (&Frames, usize),
    version: (u32, u32),
) -> Result<[Num; 3]> {
    let xyz = element.child("xyz");
    let given = match xyz {
        Some(xyz) => numbers::<3>(xyz)?,
        None => [Num::zero(), Num::zero(), Num::computed(1.0)],
    };
    let of_model = match flag(element, "use_parent_model_frame")? {
        Some(stated) => stated && version < (1, 7),
        None => version < (1, 5),
    };
    let stated = xyz.and_then(|xyz| xyz.get("expressed_in"));
    let expressed = match (stated.filter(|name| !name.is_empty()), xyz) {
        (Some(name), Some(xyz)) => frames.named(name, xyz, "the axis")?,
        _ if of_model => OWN,
        _ => return Ok(given),
    };
    let turn = frames.relative(expressed, frame);
    if crate::import::number::all_zero(&turn.rpy) {
        return Ok(given);
    }
    let turned = turn.pose().rotation * Vec3(given.each_ref().map(Num::exact));
    Ok(displaced(turned.0).placement().xyz)
}

fn limits(axis: &Element) -> Result<Limits> {
    let Some(limit) = axis.child("limit") else {
        return Ok(Limits::default());
    };
    let bounded = |x: &Num| x.value.abs() < NO_LIMIT;
    let position = |name| Ok::<_, anyhow::Error>(number(limit, name)?.filter(bounded));
    // A negative one means that there is none.
    let size = |name| {
        let stated = number(limit, name)?;
        Ok::<_, anyhow::Error>(stated.filter(|x| x.value >= 0.0 && bounded(x)))
    };
    Ok(Limits {
        lower: position("lower")?,
        upper: position("upper")?,
        velocity: size("velocity")?,
        effort: size("effort")?,
    })
}

fn effects(axis: &Element, label: &str, report: &mut SdfReport) -> Result<JointEffects> {
    let Some(dynamics) = axis.child("dynamics") else {
        return Ok(JointEffects::default());
    };
    let mut positive = |name: &str| {
        let value = number(dynamics, name)?.filter(|x| !x.is_zero());
        if let Some(wrong) = value
            .as_ref()
            .filter(|x| x.value < 0.0 || !x.value.is_finite())
        {
            let item = format!("{label} ({name} {})", wrong.text);
            report.groups.add(NEGATIVE, item);
        }
        Ok::<_, anyhow::Error>(value.filter(|x| x.value > 0.0 && x.value.is_finite()))
    };
    let (damping, friction) = (positive("damping")?, positive("friction")?);
    let stiffness = positive("spring_stiffness")?;
    let rest = number(dynamics, "spring_reference")?;
    Ok(JointEffects {
        damping,
        friction,
        rest: rest.filter(|x| stiffness.is_some() && !x.is_zero()),
        stiffness,
        rotor: None,
    })
}

/// Reads the relation to a leader: position = multiplier · (leader − reference) + offset.
fn mimic(element: &Element) -> Result<Mimic> {
    let Some(joint) = element.get("joint") else {
        return Err(fault(
            element.at,
            "this `<mimic>` names no joint: `joint=…` is missing",
        ));
    };
    let or = |name, default: f64| {
        let stated = number(element, name)?.filter(|x| x.value.is_finite());
        Ok::<_, anyhow::Error>(stated.unwrap_or(Num::computed(default)))
    };
    let (ratio, reference) = (or("multiplier", 1.0)?, or("reference", 0.0)?);
    let mut offset = or("offset", 0.0)?;
    if !reference.is_zero() {
        let shifted = offset.exact() - ratio.exact() * reference.exact();
        offset = Num::computed(shifted.to_f64());
    }
    let joint = match element.get("axis") {
        Some("axis2") => second_name(joint),
        _ => joint.to_owned(),
    };
    Ok(Mimic {
        joint,
        ratio,
        offset,
    })
}

/// Returns the name of the joint about the second axis of a joint with two.
pub(super) fn second_name(joint: &str) -> String {
    format!("{joint}_axis2")
}

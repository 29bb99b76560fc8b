//! `--lock`: joints fixed at a position, with those that follow them.

use super::joint_type::JointType;
use super::mimic::followers;
use super::model::{Joint, Model};
use super::naming::{is_called, listed, shown};
use super::number::Num;
use super::options::Lock;
use super::placement::{displaced, turned, unit};
use crate::quantity;
use anyhow::{Result, bail};
use bgdyn_codegen::format::Dimension;
use bgdyn_codegen::math::Vec3;
use bgdyn_codegen::unit::UnitFactor;
use bgdyn_runtime::Dd;

/// Fixes a joint at a value of its coordinate, and its followers at theirs; returns a line that names these.
pub(super) fn lock(model: &mut Model, asked: &Lock) -> Result<Option<String>> {
    let Lock { joint, value, unit } = asked;
    let moves = |it: &Joint| it.kind != JointType::Fixed;
    let Some(found) = find(model, joint) else {
        let known = model.joints.iter().filter(|it| moves(it));
        let known = listed(known.map(|it| it.name.as_str()));
        bail!(
            "--lock: there is no joint `{}`; those that move are {known}",
            shown(joint)
        );
    };
    check(&model.joints[found], value, *unit)?;
    let mut fixed = Vec::new();
    let mut waiting = vec![(found, value.clone())];
    while let Some((index, value)) = waiting.pop() {
        let followers = followers(model, index, &value);
        fix(&mut model.joints[index], &value);
        // One that is fixed by now follows no more.
        for (index, value) in followers {
            fixed.push(format!(
                "`{}` at {}",
                shown(&model.joints[index].name),
                value.text
            ));
            waiting.push((index, value));
        }
    }
    let fixed = (!fixed.is_empty()).then(|| fixed.join(", "));
    Ok(fixed.map(|fixed| {
        format!(
            "--lock: `{}` fixes its followers too: {fixed}",
            shown(joint)
        )
    }))
}

/// Returns the index of the joint of this name.
fn find(model: &Model, name: &str) -> Option<usize> {
    let exact = model.joints.iter().position(|it| it.name == name);
    let called = |it: &Joint| is_called(&it.name, name, "joint");
    exact.or_else(|| model.joints.iter().position(called))
}

/// Returns whether the joint to lock follows another one.
pub(super) fn follows(model: &Model, asked: &Lock) -> bool {
    find(model, &asked.joint).is_some_and(|index| model.joints[index].mimic.is_some())
}

/// Checks that a joint can be fixed at a value.
fn check(joint: &Joint, value: &Num, unit: Option<Dimension>) -> Result<()> {
    let name = shown(&joint.name);
    let (own, does) = match joint.kind {
        JointType::Fixed => bail!("--lock: the joint `{name}` is fixed already"),
        JointType::Prismatic => (Dimension::Length, "slides"),
        JointType::Revolute | JointType::Continuous | JointType::Helical => {
            (Dimension::Angle, "turns")
        }
        kind if value.is_zero() => {
            debug_assert!(!kind.is_scalar());
            return Ok(());
        }
        kind => bail!(
            "--lock: the joint `{name}` is {} and has several coordinates: it can be fixed in its neutral position \
             only, without a value",
            kind.keyword()
        ),
    };
    if let Some(unit) = unit.filter(|unit| *unit != own) {
        let units: Vec<&str> = own.units().collect();
        bail!(
            "--lock: the joint `{name}` {does}, and its value is {unit}: write {own}, in {}",
            units.join(" or ")
        );
    }
    Ok(())
}

/// Fixes a joint at a value of its coordinate.
fn fix(joint: &mut Joint, value: &Num) {
    if !value.is_zero() {
        let axis = Vec3(joint.axis.each_ref().map(Num::exact));
        let by = value.exact();
        let moved = match joint.kind {
            JointType::Prismatic => displaced(unit(axis).scale(by).0),
            JointType::Helical => {
                let lead = joint.lead.as_ref().map_or(Dd::ZERO, Num::exact);
                let along = lead * by / (Dd::PI * Dd::from_f64(2.0));
                displaced(unit(axis).scale(along).0).then(&turned(axis, by))
            }
            _ => turned(axis, by),
        };
        joint.origin = joint.origin.then(&moved.placement());
    }
    joint.fix();
}

impl Lock {
    /// Parses `JOINT` or `JOINT=VALUE`.
    ///
    /// # Errors
    /// If the value is no finite number, or its unit is neither that of an angle nor that of a length.
    pub fn parse(text: &str) -> Result<Lock, String> {
        let (joint, value) = text.rsplit_once('=').unwrap_or((text, "0"));
        let text = value.trim();
        let read = quantity::read(text, &[Dimension::Angle, Dimension::Length])
            .map_err(|what| format!("`{joint}`: {what}"))?;
        let number = match read.unit {
            Some(unit) if unit.factor == UnitFactor::Degree => {
                Num::degrees(text.trim_end_matches(unit_of_degrees))
            }
            Some(_) => Some(Num::computed(read.value.to_f64())),
            None => Num::parse(text),
        };
        let number = number.filter(|number| number.value.is_finite());
        let value = number.ok_or_else(|| format!("`{value}` is no number"))?;
        Ok(Lock {
            joint: joint.trim().to_owned(),
            value,
            unit: read.unit.map(|unit| unit.dimension),
        })
    }
}

/// Returns whether a character belongs to the unit of degrees: `deg`, `°`.
fn unit_of_degrees(c: char) -> bool {
    "deg° ".contains(c)
}

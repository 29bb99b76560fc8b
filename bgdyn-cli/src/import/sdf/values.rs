//! Numbers, words and poses in the text of elements.

use crate::import::naming::shown;
use crate::import::number::Num;
use crate::import::placement::{Placement, turned_by_quaternion};
use crate::import::xml::{Element, fault};
use anyhow::Result;

/// Returns N finite numbers in the text of an element.
pub(super) fn numbers<const N: usize>(element: &Element) -> Result<[Num; N]> {
    let texts = element.text.split_whitespace();
    let parse = |text| Num::parse(text).filter(|number| number.value.is_finite());
    let numbers: Option<Vec<Num>> = texts.map(parse).collect();
    let numbers = numbers.and_then(|numbers| numbers.try_into().ok());
    numbers.ok_or_else(|| {
        let wanted = match N {
            1 => "a finite number".to_owned(),
            _ => format!("{N} finite numbers"),
        };
        let message = format!(
            "`<{}>` must be {wanted}, not `{}`",
            element.name,
            shown(&element.text)
        );
        fault(element.at, message)
    })
}

/// Returns the number in the child of this name, which may be infinite; `None` without it.
pub(super) fn number(parent: &Element, name: &str) -> Result<Option<Num>> {
    let Some(child) = parent.child(name) else {
        return Ok(None);
    };
    let wrong = || {
        let message = format!("`<{name}>` must be a number, not `{}`", shown(&child.text));
        fault(child.at, message)
    };
    Num::parse(&child.text).map(Some).ok_or_else(wrong)
}

/// Returns whether the child of this name says so; `None` without it.
pub(super) fn flag(parent: &Element, name: &str) -> Result<Option<bool>> {
    let Some(child) = parent.child(name) else {
        return Ok(None);
    };
    truth(&child.text).map(Some).ok_or_else(|| {
        let message = format!(
            "`<{name}>` must be true or false, not `{}`",
            shown(&child.text)
        );
        fault(child.at, message)
    })
}

fn truth(text: &str) -> Option<bool> {
    match text.to_ascii_lowercase().as_str() {
        "true" | "1" => Some(true),
        "false" | "0" => Some(false),
        _ => None,
    }
}

/// Returns the pose in an element, in the axes that it is relative to: zero for an empty text.
pub(super) fn pose(element: &Element) -> Result<Placement> {
    let quaternion = match element.get("rotation_format") {
        None | Some("euler_rpy") => false,
        Some("quat_xyzw") => true,
        Some(other) => {
            let message = format!(
                "`rotation_format` is euler_rpy or quat_xyzw, not `{}`",
                shown(other)
            );
            return Err(fault(element.at, message));
        }
    };
    let degrees = match element.get("degrees") {
        None => false,
        Some(text) => truth(text.trim()).ok_or_else(|| {
            let message = format!("`degrees` is true or false, not `{}`", shown(text));
            fault(element.at, message)
        })?,
    };
    if element.text.is_empty() {
        return Ok(Placement::identity());
    }
    if quaternion {
        let [x, y, z, turn @ ..] = numbers::<7>(element)?;
        if turn.iter().all(Num::is_zero) {
            return Err(fault(element.at, "the quaternion of this `<pose>` is zero"));
        }
        let turned = turned_by_quaternion(turn.each_ref().map(Num::exact));
        return Ok(Placement {
            xyz: [x, y, z],
            rpy: turned.placement().rpy,
        });
    }
    let [x, y, z, rpy @ ..] = numbers::<6>(element)?;
    let angle = |number: Num| match degrees {
        true => Num::degrees(&number.text).unwrap_or(number),
        false => number,
    };
    Ok(Placement {
        xyz: [x, y, z],
        rpy: rpy.map(angle),
    })
}

//! Reads attributes of XML elements, and reports the line of a missing or malformed one.

use super::naming::shown;
use super::number::Num;
use super::placement::turned_by_quaternion;
use super::xml::{EXPAND, Element, fault};
use anyhow::Result;

/// Returns the name, which every link and joint must have.
pub(super) fn name(element: &Element) -> Result<&str> {
    let missing = || {
        fault(
            element.at,
            format_args!("this `<{}>` has no name", element.name),
        )
    };
    element.get("name").ok_or_else(missing)
}

/// Returns the link in a joint's `<parent>` or `<child>`.
pub(super) fn end<'a>(joint: &'a Element, part: &str) -> Result<&'a str> {
    let link = joint.child(part).and_then(|part| part.get("link"));
    let joint_name = shown(name(joint)?);
    link.ok_or_else(|| {
        fault(
            joint.at,
            format_args!("joint `{joint_name}` names no {part}: `<{part} link=…/>` is missing"),
        )
    })
}

/// Returns the translation of an origin, zero without one.
pub(super) fn place(origin: Option<&Element>) -> Result<[Num; 3]> {
    match origin {
        Some(origin) if origin.get("xyz").is_some() => numbers(origin, "xyz"),
        _ => Ok(Num::zeros()),
    }
}

/// Returns the rotation of an origin as roll, pitch, yaw.
pub(super) fn turn(origin: &Element) -> Result<[Num; 3]> {
    match (origin.get("rpy"), origin.get("quat_xyzw")) {
        (Some(_), Some(_)) => Err(fault(
            origin.at,
            "`rpy` and `quat_xyzw` both give a rotation: leave one",
        )),
        (Some(_), None) => numbers(origin, "rpy"),
        (None, None) => Ok(Num::zeros()),
        (None, Some(_)) => {
            let quaternion = numbers::<4>(origin, "quat_xyzw")?;
            if quaternion.iter().all(Num::is_zero) {
                return Err(fault(origin.at, "the quaternion is zero"));
            }
            let turn = turned_by_quaternion(quaternion.each_ref().map(Num::exact));
            Ok(turn.placement().rpy)
        }
    }
}

fn not_a_number(element: &Element, attribute: &str, wanted: &str) -> anyhow::Error {
    let given = element.get(attribute).unwrap_or_default();
    let hint = if given.contains("${") || given.contains("$(") {
        EXPAND
    } else {
        ""
    };
    let given = shown(given);
    fault(
        element.at,
        format_args!(
            "`{attribute}` of `<{}>` must be {wanted}, not `{given}`{hint}",
            element.name
        ),
    )
}

/// Returns N finite numbers separated by white space.
pub(super) fn numbers<const N: usize>(element: &Element, attribute: &str) -> Result<[Num; N]> {
    let given = element
        .get(attribute)
        .unwrap_or_default()
        .split_whitespace();
    let numbers: Option<Vec<Num>> = given
        .map(|text| Num::parse(text).filter(|n| n.value.is_finite()))
        .collect();
    let numbers = numbers.and_then(|numbers| numbers.try_into().ok());
    let wanted = || match N {
        1 => "a finite number".to_string(),
        _ => format!("{N} finite numbers"),
    };
    numbers.ok_or_else(|| not_a_number(element, attribute, &wanted()))
}

/// Returns one finite number.
pub(super) fn finite(element: &Element, attribute: &str) -> Result<Num> {
    numbers::<1>(element, attribute).map(|[number]| number)
}

/// Returns a limit, which may be infinite; `None` if the attribute is missing.
pub(super) fn bound(element: &Element, attribute: &str) -> Result<Option<Num>> {
    let parse = |text| Num::parse(text).ok_or_else(|| not_a_number(element, attribute, "a number"));
    element.get(attribute).map(parse).transpose()
}

//! Parses the limits of a URDF's joint.

use super::attributes::bound;
use super::groups::Groups;
use super::joint_type::JointType;
use super::model::Limits;
use super::number::Num;
use super::xml::{Element, fault};
use anyhow::Result;

/// Checks that every limit is a number. Since version 1.2 no range may be empty, and no velocity or effort
/// negative.
pub(super) fn check_limit(limit: &Element, strict: bool, label: &str) -> Result<()> {
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
pub(super) fn limits(
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
                "joints without `<limit>`, imported without limits",
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
                groups.add("position limits of continuous joints, not imported", item);
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
            groups.add("negative limits, not imported", item);
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

//! Equality constraints: linear ones between two joints become followers.

use super::defaults::Defaults;
use super::report::Report;
use super::settings::one_of;
use crate::import::attributes::finite;
use crate::import::model::{Mimic, Model};
use crate::import::naming::shown;
use crate::import::number::Num;
use crate::import::xml::Element;
use anyhow::Result;

const NOT_LINEAR: &str = "equality constraints that are no linear relation of two joints with one coordinate, not imported";
const FOLLOWS: &str =
    "equality constraints of joints that follow another one already, or in a circle, not imported";

/// Reads all `<equality>` elements. `references` are those of the joints with one coordinate, by name.
pub(super) fn read(
    root: &Element,
    model: &mut Model,
    (references, defaults): (&[(String, Num)], &Defaults),
    report: &mut Report,
) -> Result<()> {
    for section in root.all("equality") {
        report.children(section, &["joint", "connect", "weld"]);
        for element in section.all("joint") {
            report.attributes(
                element,
                &["name", "class", "active", "joint1", "joint2", "polycoef"],
            );
            let label = format!(
                "{} (line {})",
                match (element.get("joint1"), element.get("joint2")) {
                    (Some(first), Some(second)) =>
                        format!("`{}`, `{}`", shown(first), shown(second)),
                    (Some(only), None) => format!("`{}`", shown(only)),
                    _ => "without `joint1`".to_owned(),
                },
                element.at.0
            );
            let element = &defaults.apply_kind(element, "equality", None)?;
            if element.get("active").is_some()
                && !one_of(element, "active", &[("true", true), ("false", false)])?
            {
                let kind = "equality constraints that are not active, not imported";
                report.groups.add(kind, label);
                continue;
            }
            match relation(element, references)? {
                Some((follower, mimic)) if follow(model, &follower, &mimic) => {
                    let item = format!("`{}` follows `{}`", shown(&follower), shown(&mimic.joint));
                    let kind = "exact here, while MuJoCo holds them by a soft constraint";
                    report.groups.add(kind, item);
                }
                Some(_) => report.groups.add(FOLLOWS, label),
                None => report.groups.add(NOT_LINEAR, label),
            }
        }
    }
    Ok(())
}

/// Returns the name of the follower and its relation: y − y₀ = a₀ + a₁ (x − x₀).
fn relation(element: &Element, references: &[(String, Num)]) -> Result<Option<(String, Mimic)>> {
    let text = element.get("polycoef").unwrap_or("0 1 0 0 0");
    let mut coefficients = Vec::new();
    for word in text.split_whitespace() {
        let mut single = Element::empty(&element.name, element.at);
        single.attributes.push(("polycoef".into(), word.into()));
        coefficients.push(finite(&single, "polycoef")?);
    }
    // The defaults 0 1 0 0 0 hold for those that are not given.
    let defaults = ["0", "1", "0", "0", "0"];
    let missing = defaults.iter().skip(coefficients.len());
    coefficients.extend(missing.filter_map(|text| Num::parse(text)));
    let [constant, ratio, rest @ ..] = coefficients.as_slice() else {
        return Ok(None);
    };
    let reference = |attribute| {
        let name = element.get(attribute)?;
        let found = references.iter().find(|(known, _)| known == name);
        found.map(|(name, reference)| (name.clone(), reference))
    };
    let (Some((follower, y)), Some((leader, x))) = (reference("joint1"), reference("joint2"))
    else {
        return Ok(None);
    };
    if ratio.is_zero() || !rest.iter().all(Num::is_zero) {
        return Ok(None);
    }
    let offset = match y.is_zero() && x.is_zero() {
        true => constant.clone(),
        false => {
            let offset = constant.exact() + y.exact() - ratio.exact() * x.exact();
            Num::computed(offset.to_f64())
        }
    };
    let mimic = Mimic {
        joint: leader,
        ratio: ratio.clone(),
        offset,
    };
    Ok(Some((follower, mimic)))
}

/// Lets a joint follow another; returns whether it can, which is not so for a joint that follows already and
/// for a circle.
fn follow(model: &mut Model, follower: &str, mimic: &Mimic) -> bool {
    let find = |name: &str| model.joints.iter().position(|joint| joint.name == name);
    let Some(index) = find(follower).filter(|index| model.joints[*index].mimic.is_none()) else {
        return false;
    };
    let mut leader = find(&mimic.joint);
    while let Some(at) = leader {
        if at == index {
            return false;
        }
        let next = model.joints[at].mimic.as_ref();
        leader = next.and_then(|mimic| find(&mimic.joint));
    }
    model.joints[index].mimic = Some(mimic.clone());
    true
}

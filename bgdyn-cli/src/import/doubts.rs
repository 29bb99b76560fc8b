//! Warns about suspicious data of a robot and about decisions of the importer.

use super::inertia::{DUST, Verdict, is_dust, judge};
use super::joint_type::JointType;
use super::model::{Inertial, Link, Model};
use super::naming::shown;
use super::number::Num;
use super::tree::Tree;
use bgdyn_codegen::name::WORLD;
use bgdyn_runtime::Digits;
use std::collections::HashMap;

/// Returns warnings about the robot as a whole.
pub(super) fn doubtful(model: &Model, tree: &Tree) -> Vec<String> {
    let mut warnings = Vec::new();
    if model.name.is_empty() {
        warnings.push("the robot has no name".into());
    }
    let unsaid = tree.roots.iter().map(|root| &model.links[*root]);
    let unsaid: Vec<&Link> = unsaid.filter(|link| link.place.is_none()).collect();
    if unsaid.len() > 1 {
        let roots = unsaid.iter().map(|link| format!("`{}`", shown(&link.name)));
        let roots: Vec<String> = roots.collect();
        warnings.push(format!(
            "several links have no joint, all are fixed to the world: {}",
            roots.join(", ")
        ));
    }
    warnings.extend(grounded(model, tree));
    let mut times = HashMap::new();
    for joint in &model.joints {
        let times = times.entry(&joint.name).or_insert(0);
        *times += 1;
        if *times == 2 {
            warnings.push(format!(
                "several joints are called `{}`",
                shown(&joint.name)
            ));
        }
    }
    warnings
}

/// Sets tensors to zero that are rounding errors of zero, and names their links.
pub(super) fn without_dust(model: &mut Model) -> Option<String> {
    let mut names = Vec::new();
    for link in &mut model.links {
        let Some(inertial) = &mut link.inertial else {
            continue;
        };
        if is_dust(inertial.tensor.each_ref().map(|entry| entry.value)) {
            inertial.tensor = std::array::from_fn(|_| Num::zero());
            names.push(format!("`{}`", shown(&link.name)));
        }
    }
    let names = (!names.is_empty()).then(|| names.join("; "));
    names.map(|names| {
        format!("tensors that no body has, all entries below {DUST:e} kg·m², taken as 0: {names}")
    })
}

/// Warns about an inertial that no body can have; returns true if the mechanism must permit it.
pub(super) fn judge_inertial(link: &str, inertial: &Inertial, warnings: &mut Vec<String>) -> bool {
    if inertial.mass.value < 0.0 {
        let mass = &inertial.mass.text;
        warnings.push(format!(
            "link `{link}`: the mass {mass} kg is negative; `bgdyn check` will refuse it"
        ));
    }
    let verdict = judge(inertial.tensor.each_ref().map(|entry| entry.value));
    let (moments, fault) = match &verdict {
        Verdict::Physical => return false,
        Verdict::NoTriangle(moments) => (
            moments,
            "break the triangle inequality; kept, with `nonphysical: allow`",
        ),
        Verdict::Indefinite(moments) => (
            moments,
            "are not all positive or zero; kept, but `bgdyn check` will refuse them",
        ),
    };
    let [a, b, c] = moments.map(six_digits);
    warnings.push(format!(
        "link `{link}`: the principal moments {a}, {b}, {c} kg·m² {fault}"
    ));
    matches!(verdict, Verdict::NoTriangle(_))
}

/// Prints a number with six digits.
pub(super) fn six_digits(value: f64) -> String {
    Digits::new(value, 6).to_string()
}

/// Names the links with mass that are fixed to the world by default: the author may have meant a moving
/// base. The line that says what was written names every link that is fixed, also those without mass.
fn grounded(model: &Model, tree: &Tree) -> Option<String> {
    let heavy = |root: &usize| {
        let mut rigid = vec![*root];
        let mut mass = 0.0;
        while let Some(link) = rigid.pop() {
            let inertial = model.links[link].inertial.as_ref();
            mass += inertial.map_or(0.0, |inertial| inertial.mass.value);
            let fixed = model.joints.iter().zip(&tree.ends);
            let fixed = fixed.filter(|(joint, (parent, _))| {
                *parent == Some(link) && joint.kind == JointType::Fixed
            });
            rigid.extend(fixed.map(|(_, (_, child))| *child));
        }
        (mass != 0.0).then(|| {
            let mass = six_digits(mass);
            format!("`{}` ({mass} kg)", shown(&model.links[*root].name))
        })
    };
    // A root with this name is meant to be fixed to the world.
    let said = |root: &&usize| {
        let link = &model.links[**root];
        link.name != WORLD && link.place.is_none()
    };
    let heavy: Vec<String> = tree.roots.iter().filter(said).filter_map(heavy).collect();
    (!heavy.is_empty()).then(|| {
        format!(
            "fixed to the world, since no joint carries it: {}; for a base that drives, walks or flies: \
             `--base floating`, `--base planar`, `--base given`",
            heavy.join(", ")
        )
    })
}

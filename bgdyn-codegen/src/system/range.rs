//! Checks values that must stay positive, such as the volume of a cylinder's side.
//!
//! Each is evaluated at the start, then with one joint after the other moved from its lower to its upper limit. A
//! violation found is an error; other violations are possible between the points, or if several joints move.

use bgdyn_runtime::Dd;

use super::EffortSums;
use crate::effort_sums::Condition;
use crate::fault::{Faults, wording};
use crate::mechanism::Limits;
use crate::scene::{Initial, MomentumStore, Scene};

/// Number of points between a joint's limits.
const POINTS: u32 = 64;

/// Reports the values that do not stay positive.
pub(super) fn check(scene: &Scene, sums: &EffortSums<'_, '_>, faults: &mut Faults) {
    for condition in sums.conditions() {
        if let Some((value, when)) = violated(condition, scene, sums) {
            let value = value.to_f64();
            let element = &scene.elements[condition.element];
            let found = (condition.what.as_str(), value, when.as_str());
            faults.push(wording::not_positive(
                &element.location,
                found,
                condition.way_out,
            ));
        }
    }
}

/// Returns a value that is not positive, and its position.
fn violated<'g>(
    condition: &Condition<'g>,
    scene: &Scene,
    sums: &EffortSums<'g, '_>,
) -> Option<(Dd, String)> {
    let start = &scene.initial;
    let value_at = |initial: &Initial| sums.at_start(condition.value, initial);
    let wrong = |value: &Dd| value.to_f64().is_nan() || *value <= Dd::ZERO;
    let first = Some(value_at(start)).filter(wrong);
    if let Some(value) = first {
        return Some((value, "at the start".into()));
    }
    let read = sums.positions_of(condition.value);
    for &p in &read {
        let Some((limits, name)) = limits_of(scene, p) else {
            continue;
        };
        let (Some(lower), Some(upper)) = (limits.lower, limits.upper) else {
            continue;
        };
        for k in 0..=POINTS {
            let q = lower + (upper - lower) * f64::from(k) / f64::from(POINTS);
            let mut moved = start.clone();
            moved.q[p] = Dd::from_f64(q);
            // Other positions that the value depends on may move with this one.
            let closure = scene.mechanism.closure().filter(|_| read.len() > 1);
            if closure.is_some_and(|closure| !closure.close(&mut moved.q[..closure.start.len()])) {
                continue;
            }
            if let Some(value) = Some(value_at(&moved)).filter(wrong) {
                let unit = scene.layout.positions[p].dimension.si();
                let location = format!("where `{name}` is {q:.4} {unit}, within its limits");
                return Some((value, location));
            }
        }
    }
    None
}

/// Returns the limits of the joint with this position, and its name.
fn limits_of(scene: &Scene, p: usize) -> Option<(Limits, &str)> {
    let (layout, mechanism) = (&scene.layout, &scene.mechanism);
    if let Some(j) = layout.positions[p].coordinate {
        let coordinate = &layout.coordinates[j];
        return match &coordinate.store {
            MomentumStore::Links(id) => {
                Some((mechanism.joint(*id).limits, coordinate.name.as_str()))
            }
            MomentumStore::Own(_) => None,
        };
    }
    let dependent = layout
        .dependents
        .iter()
        .find(|joint| joint.position == Some(p))?;
    let mut joints = mechanism.links().iter().map(|link| &link.joint);
    let joint = joints.find(|joint| joint.name == dependent.name)?;
    Some((joint.limits, &joint.name))
}

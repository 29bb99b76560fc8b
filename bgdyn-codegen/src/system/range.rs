//! Checks values that must stay positive, such as the volume of a cylinder's side. Each is evaluated at
//! the start, then with one joint after the other moved from its lower to its upper limit. A violation
//! found is an error; other violations are possible between the points, or if several joints move.

use bgdyn_runtime::Dd;

use super::EffortSums;
use crate::effort_sums::Condition;
use crate::fault::{Faults, wording};
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
    for p in sums.positions_of(condition.value) {
        let Some(j) = scene.layout.positions[p].coordinate else {
            continue;
        };
        let coordinate = &scene.layout.coordinates[j];
        let MomentumStore::Links(id) = &coordinate.store else {
            continue;
        };
        let limits = scene.mechanism.joint(*id).limits;
        let (Some(lower), Some(upper)) = (limits.lower, limits.upper) else {
            continue;
        };
        for k in 0..=POINTS {
            let q = lower + (upper - lower) * f64::from(k) / f64::from(POINTS);
            let mut moved = start.clone();
            moved.q[p] = Dd::from_f64(q);
            if let Some(value) = Some(value_at(&moved)).filter(wrong) {
                let (name, unit) = (&coordinate.name, coordinate.dimensions[0].si());
                let location = format!("where `{name}` is {q:.4} {unit}, within its limits");
                return Some((value, location));
            }
        }
    }
    None
}

//! The start of a scene with loops: motions of its joints, and the faults of a start that does not exist.

use bgdyn_runtime::Dd;

use crate::fault::{Fault, Location, wording};
use crate::layout::{QuasiJoint, StateLayout};
use crate::mechanism::Mechanism;
use crate::mechanism::closure::Unreached;

/// Returns position and velocity of a coordinate, of a joint that follows others, or of one in a loop, in a state.
pub(super) fn motion_of(
    (mechanism, layout): (&Mechanism, &StateLayout),
    name: &str,
    (q, v): (&[Dd], &[Dd]),
) -> Option<(Option<Dd>, Dd)> {
    let Some(joint) = layout.dependent_named(name) else {
        return layout.motion_of(name, q, v);
    };
    let map = mechanism.closure()?.velocity_map(q)?;
    let terms = map[joint.velocity.0].iter().zip(v);
    let velocity = terms.fold(Dd::ZERO, |sum, (s, u)| sum + *s * *u);
    Some((joint.position.map(|p| q[p]), velocity))
}

/// Returns the fault of a start that does not exist; `location` is that of an entry of the file.
pub(super) fn fault(
    layout: &StateLayout,
    reason: &Unreached,
    location: impl Fn(&str) -> Location,
) -> Fault {
    match reason {
        Unreached::Open {
            closes,
            touches,
            gap,
            nearest,
        } => {
            let gap = (gap.distance, gap.angle);
            let nearest = named(layout, nearest);
            wording::start_is_open(&location(""), (closes, *touches), gap, &nearest)
        }
        Unreached::BranchesMeet(at) => {
            let at = named(layout, at);
            wording::start_beyond_meeting_branches(&location(""), &layout.loops, &at)
        }
        Unreached::OtherBranch => wording::start_on_other_branch(&location(""), &layout.loops),
        Unreached::Contradicts {
            index,
            velocity,
            given,
            closed,
        } => {
            let (name, unit) = match velocity {
                false => {
                    let position = &layout.positions[*index];
                    (position.name.as_str(), position.dimension.si())
                }
                true => rate(layout, *index),
            };
            match orientation(layout, *index).filter(|_| !velocity) {
                Some(joint) => wording::pose_contradicts(&location(joint), joint),
                None => wording::start_contradicts(&location(name), name, (*given, *closed), unit),
            }
        }
        Unreached::Still { index, given, part } => {
            let (name, unit) = rate(layout, *index);
            wording::start_stands_still(&location(name), name, (*given, unit), *part)
        }
    }
}

/// Returns the name of the joint with this position in its quaternion.
fn orientation(layout: &StateLayout, position: usize) -> Option<&str> {
    let has = |joint: &&QuasiJoint| {
        let first = joint.quaternion;
        first.is_some_and(|first| (first..first + 4).contains(&position))
    };
    let joint = layout.quasi_joints.iter().find(has)?;
    Some(&joint.name)
}

/// Returns positions, by index, with their names and units.
fn named(layout: &StateLayout, of: &[(usize, f64)]) -> Vec<(String, f64, &'static str)> {
    let one = |&(p, x): &(usize, f64)| {
        let position = &layout.positions[p];
        (position.name.clone(), x, position.dimension.si())
    };
    of.iter().map(one).collect()
}

/// Returns name and unit of a velocity of the open tree.
fn rate(layout: &StateLayout, index: usize) -> (&str, &'static str) {
    let mut dependents = layout.dependents.iter();
    let dependent = dependents.find(|joint| joint.velocity.0 == index);
    dependent.map_or(("", ""), |joint| {
        (&joint.rate_name, joint.dimensions[1].si())
    })
}

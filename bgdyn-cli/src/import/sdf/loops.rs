//! Joints that close loops: their child is carried by another joint already.

use super::joints::{JointAxis, Motion};
use super::layout::{ModelLayout, ReadJoint};
use super::report::SdfReport;
use crate::import::joint_type::JointType;
use crate::import::loops::joints_between;
use crate::import::model::{Loop, LoopPlace, Model};
use crate::import::naming::shown;
use crate::import::number::Num;
use crate::import::placement::{Pose, unit};
use bgdyn_codegen::math::{Mat3, Vec3};
use bgdyn_runtime::Dd;

const CLOSES: &str = "joints that close loops";
const NOT_AT_LOOPS: &str =
    "limits, damping, friction and springs of joints that close loops, not imported";
const ON_ONE_LINK: &str =
    "joints between links that no other joint moves against each other, not imported";

/// The cosine below which two axes count as perpendicular.
const PERPENDICULAR: f64 = 1e-9;

/// Adds loops for joints whose child is carried already.
pub(super) fn add(
    joints: Vec<ReadJoint<'_>>,
    layout: &ModelLayout<'_>,
    model: &mut Model,
    report: &mut SdfReport,
) {
    for joint in joints {
        let label = shown(joint.name);
        let place = |link: Option<usize>| LoopPlace {
            link: link.map(|link| layout.name(link).to_owned()),
            place: layout.place(joint.frame, link),
        };
        let ends = [place(joint.parent), place(Some(joint.child))];
        let [a, b] = &ends;
        if joints_between(model, &a.link, &b.link).is_empty() {
            report.groups.add(ON_ONE_LINK, format!("`{label}`"));
            continue;
        }
        let axes = joint.motion.axes();
        if axes.iter().any(|axis| axis.mimic.is_some()) {
            let what = format!(
                "joint `{label}` closes a loop, and follows another by `<mimic>`: exchange the joints in the file, so that another one closes it"
            );
            report.refuse(joint.element.at, what);
        }
        if axes.iter().any(acts) {
            report.groups.add(NOT_AT_LOOPS, format!("`{label}`"));
        }
        let Some(closed) = closed(joint.name, &joint.motion, ends) else {
            let what = format!(
                "joint `{label}` closes a loop, and a loop cannot be closed by a screw, nor by axes that are not perpendicular: exchange the joints in the file, so that another one closes it"
            );
            report.refuse(joint.element.at, what);
            continue;
        };
        let item = format!("`{label}` ({})", closed.kind);
        report.groups.add(CLOSES, item);
        model.loops.push(closed);
    }
}

/// Returns the loop that a joint of this motion closes at these places; `None` if none is of its type.
fn closed(name: &str, motion: &Motion, [mut a, mut b]: [LoopPlace; 2]) -> Option<Loop> {
    let (kind, axis) = match motion {
        Motion::Fixed => ("weld", None),
        Motion::Ball => {
            // Points have no axes.
            (a.place.rpy, b.place.rpy) = (Num::zeros(), Num::zeros());
            ("point", None)
        }
        Motion::Single(kind, axis, _) => {
            let closing = match kind {
                JointType::Revolute | JointType::Continuous => "hinge",
                JointType::Prismatic => "slider",
                _ => return None,
            };
            (closing, Some(axis.direction.clone()))
        }
        Motion::Double(axes) if cosine(axes).abs() <= PERPENDICULAR => {
            let turned = cross_axes(axes).placement();
            for place in [&mut a.place, &mut b.place] {
                *place = place.then(&turned);
            }
            ("universal", None)
        }
        Motion::Double(_) => return None,
    };
    Some(Loop {
        name: name.to_owned(),
        kind,
        axis,
        a,
        b,
    })
}

/// Returns whether something is declared for an axis that a loop does not have.
fn acts(axis: &JointAxis) -> bool {
    let (limits, effects) = (&axis.limits, &axis.effects);
    let of_limits = [
        &limits.lower,
        &limits.upper,
        &limits.velocity,
        &limits.effort,
    ];
    let of_effects = [&effects.damping, &effects.friction, &effects.stiffness];
    of_limits.into_iter().chain(of_effects).any(Option::is_some)
}

fn directions(axes: &[JointAxis; 2]) -> [Vec3<Dd>; 2] {
    axes.each_ref()
        .map(|axis| unit(Vec3(axis.direction.each_ref().map(Num::exact))))
}

fn cosine(axes: &[JointAxis; 2]) -> f64 {
    let [first, second] = directions(axes);
    first.dot(second).to_f64()
}

/// Returns axes with z along the first axis, and x along the second one.
fn cross_axes(axes: &[JointAxis; 2]) -> Pose {
    let [z, second] = directions(axes);
    let x = unit(second - z.scale(z.dot(second)));
    let columns = [x, z.cross(x), z];
    Pose {
        rotation: Mat3::from_fn(|i, j| columns[j].0[i]),
        translation: Vec3([Dd::ZERO; 3]),
    }
}

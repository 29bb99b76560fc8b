//! Chooses the axes of a loop's rows, and the point of a hinge on its axis.
//!
//! Rows that hold at every position are then rows of their own and fall by structure.
//!
//! - All motion in one plane: axis z of the rows is the plane's normal. For a slider, whose axis z is given, it is x.
//! - All motion along one line: axis z of the rows is the line.
//! - All axes through one point: the hinge is at that point.

use bgdyn_runtime::Dd;

use super::placed::turn_to_axis;
use crate::math::{Mat3, Vec3};
use crate::mechanism::Motion;
use crate::mechanism::closure::{ChainStep, ClosingRow, KinematicLoop, LoopChain};
use crate::mechanism::joint::DoubleDouble;

/// Squares of sines and distances below this are those of rounding errors in double-double.
const ROUNDING: f64 = 1e-40;

/// A joint of a loop at one position, in the axes of place a.
struct LoopAxis {
    rotates: bool,
    direction: Vec3<Dd>,
    /// A point of the axis, m.
    point: Vec3<Dd>,
}

/// Sets axes and point of a loop's places; `positions` are some of the open tree.
pub(super) fn choose(one: &mut KinematicLoop, positions: &[Vec<Dd>]) {
    let places = one.kind.coincident || slides(one);
    let joints = positions.first().and_then(|q| joint_axes(&one.chain, q));
    let (true, Some(joints)) = (places && one.contact.is_none(), joints) else {
        return;
    };
    if let Some(turn) = turn(one, &joints) {
        for place in [&mut one.chain.start, &mut one.chain.end] {
            place.rotation = place.rotation * turn;
        }
        one.axis = one.axis.map(|axis| turn.transpose() * axis);
    } else if has(one, |row| matches!(row, ClosingRow::Tilt(_))) {
        slide_to_centre(one, positions);
    }
}

fn has(one: &KinematicLoop, is: impl Fn(ClosingRow) -> bool) -> bool {
    one.kind.rows.iter().any(|(_, row)| is(*row))
}

/// Returns whether the axis of the places is given, and rotation about it is held.
fn slides(one: &KinematicLoop) -> bool {
    one.kind.axial && has(one, |row| matches!(row, ClosingRow::Turn(_)))
}

/// Returns the axes of all joints that move; `None` if one does more than rotate or slide.
fn joint_axes(chain: &LoopChain, q: &[Dd]) -> Option<Vec<LoopAxis>> {
    let frames = chain.frames(q, &DoubleDouble);
    let steps = chain.steps.iter().enumerate();
    let moving = steps.filter(|(_, step)| step.motion != Motion::None);
    let axis = |(k, step): (usize, &ChainStep)| {
        let link = k + usize::from(step.outward);
        let (axes, point) = frames.link(link);
        (step.motion.nv() == 1 && !matches!(step.motion, Motion::Compound(_))).then(|| LoopAxis {
            rotates: step.motion == Motion::Rotation,
            direction: axes * step.axis,
            point,
        })
    };
    moving.map(axis).collect()
}

/// Returns the rotation of the rows' axes, if they are not along the loop's own already.
fn turn(one: &KinematicLoop, joints: &[LoopAxis]) -> Option<Mat3<Dd>> {
    let normal = normal(joints)?;
    // Along axis k the other two components are rounding errors.
    let along = |k: usize| {
        let others = [(k + 1) % 3, (k + 2) % 3].map(|i| normal.0[i]);
        is_zero(Vec3([others[0], others[1], Dd::ZERO]))
    };
    if (0..3).any(along) {
        return None;
    }
    let free = |row| matches!(row, ClosingRow::Place(_) | ClosingRow::Turn(_));
    if slides(one) {
        // z stays; x becomes the normal if they are perpendicular.
        let [x, y, z] = normal.0;
        let flat = (z * z).to_f64() < ROUNDING;
        let rows = [
            [x, -y, Dd::ZERO],
            [y, x, Dd::ZERO],
            [Dd::ZERO, Dd::ZERO, Dd::ONE],
        ];
        return flat.then_some(Mat3(rows));
    }
    one.kind
        .rows
        .iter()
        .all(|(_, row)| free(*row))
        .then(|| turn_to_axis(normal))
}

/// Returns the normal of a plane in which all joints move, or the line along which they do.
fn normal(joints: &[LoopAxis]) -> Option<Vec3<Dd>> {
    let rotation = joints.iter().find(|joint| joint.rotates);
    let slides = || joints.iter().filter(|joint| !joint.rotates);
    let first = slides().next().map(|joint| joint.direction);
    let normal = match (rotation, first) {
        (Some(joint), _) => joint.direction,
        (None, Some(first)) => {
            let mut across = slides().map(|joint| first.cross(joint.direction));
            match across.find(|n| !is_zero(*n)) {
                None => return Some(first),
                Some(n) => n.scale(Dd::ONE / n.dot(n).sqrt()),
            }
        }
        (None, None) => return None,
    };
    let fits = |joint: &LoopAxis| match joint.rotates {
        true => is_zero(normal.cross(joint.direction)),
        false => {
            let off = normal.dot(joint.direction).to_f64();
            off * off < ROUNDING
        }
    };
    joints.iter().all(fits).then_some(normal)
}

fn is_zero(v: Vec3<Dd>) -> bool {
    v.dot(v).to_f64() < ROUNDING
}

/// Moves the places along the hinge's axis to the point through which the axes of all joints go. Places that are not
/// as far from it never coincide: they stay, and their rows say so.
fn slide_to_centre(one: &mut KinematicLoop, positions: &[Vec<Dd>]) {
    let from_a = on_axis(&one.chain, positions);
    let from_b = on_axis(&one.chain.reversed(), positions);
    let (Some(a), Some(b)) = (from_a, from_b) else {
        return;
    };
    let apart = (a - b).to_f64();
    if apart * apart > ROUNDING {
        return;
    }
    for place in [&mut one.chain.start, &mut one.chain.end] {
        place.translation = place.translation + place.rotation.column(2).scale(a);
    }
}

/// Returns where on the z axis of a chain's first place the axes of all joints cross, at every position.
fn on_axis(chain: &LoopChain, positions: &[Vec<Dd>]) -> Option<Dd> {
    let at = |q: &Vec<Dd>| centre(&joint_axes(chain, q)?);
    let all: Option<Vec<Vec3<Dd>>> = positions.iter().map(at).collect();
    let all = all?;
    let first = *all.first()?;
    let [x, y, z] = first.0;
    let on_axis = is_zero(Vec3([x, y, Dd::ZERO]));
    let still = all.iter().all(|c| is_zero(*c - first));
    (on_axis && still).then_some(z)
}

/// Returns the point that all axes go through.
fn centre(joints: &[LoopAxis]) -> Option<Vec3<Dd>> {
    let first = joints.first()?;
    let crossing = |joint: &LoopAxis| {
        // first.point + s u nearest to the other axis: s = ((p × w) · n) / (n · n), n = u × w
        let n = first.direction.cross(joint.direction);
        let size = n.dot(n);
        let s = (joint.point - first.point).cross(joint.direction).dot(n) / size;
        (!is_zero(n)).then(|| first.point + first.direction.scale(s))
    };
    let centre = joints.iter().find_map(crossing)?;
    let through = |joint: &LoopAxis| is_zero((centre - joint.point).cross(joint.direction));
    (joints.iter().all(|joint| joint.rotates) && joints.iter().all(through)).then_some(centre)
}

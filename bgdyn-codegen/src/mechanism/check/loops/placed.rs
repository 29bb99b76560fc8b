//! The places of a loop on the links, and its chain of joints.

use bgdyn_runtime::Dd;

use super::tree::{Tree, find_link, path, step};
use crate::fault::{Faults, wording};
use crate::format::{Field, LoopEndSpec, LoopSpec, Spec};
use crate::math::{Mat3, Vec3};
use crate::mechanism::check::direction::Directions;
use crate::mechanism::closure::{CLOSING_TYPES, ClosingType, LoopChain};
use crate::mechanism::{LinkId, Motion, Pose};
use crate::name::is_identifier;

/// What the entries of `loops` refer to.
pub type Context<'a> = (&'a Spec, Tree<'a>, &'a Directions);

/// The places of a loop, and the joints between them.
pub(super) struct PlacedLoop<'a> {
    pub(super) name: &'a str,
    pub(super) kind: &'static ClosingType,
    /// The links of places a and b; `None` for the world.
    pub(super) links: [Option<LinkId>; 2],
    pub(super) chain: LoopChain,
    pub(super) length: Dd,
}

/// Reads name, type and places of a loop. `None` if a rule is broken.
pub(super) fn placed<'a>(
    one: &'a LoopSpec,
    context: Context<'_>,
    faults: &mut Faults,
) -> Option<PlacedLoop<'a>> {
    let (spec, tree, directions) = context;
    let name = one.name.given()?;
    if !is_identifier(&name.value) {
        faults.push(wording::not_identifier(&name.location, &name.value));
    }
    if is_taken(spec, tree, one, &name.value) {
        faults.push(wording::loop_has_taken_name(&name.location, &name.value));
    }
    let kind = kind(one, faults);
    let a = end(one.a.value()?, context, faults);
    let b = end(one.b.value()?, context, faults);
    let (kind, a, b) = (kind?, a?, b?);
    let length = length(one, kind, faults)?;
    let turn = axis(one, kind, directions, faults)?;
    let path = path(tree, a.0, b.0);
    if path.is_empty() {
        faults.push(wording::loop_closes_nothing(&one.location, &name.value));
        return None;
    }
    let turned = |pose: Pose| Pose {
        rotation: pose.rotation * turn,
        ..pose
    };
    let steps = path.iter();
    let steps = steps.map(|&(link, outward)| step(tree, link, outward));
    Some(PlacedLoop {
        name: &name.value,
        kind,
        links: [a.0, b.0],
        chain: LoopChain {
            start: turned(a.1),
            steps: steps.collect(),
            end: turned(b.1),
        },
        length,
    })
}

/// Returns whether a link, a joint, a frame, a constraint, an effect or another loop has this name.
fn is_taken(spec: &Spec, tree: Tree<'_>, own: &LoopSpec, name: &str) -> bool {
    let links = tree.links().iter();
    let mut joints = links.flat_map(|link| [&link.name, &link.joint.name]);
    let mut frames = tree.frames().iter();
    let constraints = spec.constraints.value().into_iter().flatten();
    let mut raws = constraints.chain(spec.effects.value().into_iter().flatten());
    let mut loops = spec.loops.value().into_iter().flatten();
    joints.any(|known| known == name)
        || frames.any(|frame| frame.name == name)
        || raws.any(|raw| raw.name.value == name)
        || loops.any(|one| one != own && one.name.value().is_some_and(|known| known == name))
}

fn kind(one: &LoopSpec, faults: &mut Faults) -> Option<&'static ClosingType> {
    let word = one.kind.given()?;
    let found = CLOSING_TYPES
        .into_iter()
        .find(|kind| kind.keyword == word.value);
    if found.is_none() {
        let words: Vec<&str> = CLOSING_TYPES.iter().map(|kind| kind.keyword).collect();
        faults.push(wording::unknown_loop_type(
            &word.location,
            &word.value,
            &words,
        ));
    }
    found
}

/// Returns link and pose of a place.
fn end(
    end: &LoopEndSpec,
    (_, tree, directions): Context<'_>,
    faults: &mut Faults,
) -> Option<(Option<LinkId>, Pose)> {
    if let Some(frame) = end.frame.given() {
        if let Some(given) = end.link.given() {
            faults.push(wording::loop_end_twice(&given.location));
        }
        let mut frames = tree.frames().iter();
        let Some(found) = frames.find(|known| known.name == frame.value) else {
            let known: Vec<&str> = tree.frames().iter().map(|f| f.name.as_str()).collect();
            faults.push(wording::unknown_frame(
                &frame.location,
                &frame.value,
                &known,
            ));
            return None;
        };
        return Some((found.link, found.origin));
    }
    let Some(link) = end.link.given() else {
        if end.link.is_absent() && end.frame.is_absent() {
            faults.push(wording::loop_end_missing(&end.location));
        }
        return None;
    };
    let pose = directions.pose(&end.origin, faults)?;
    Some((find_link(&link.value, &link.location, tree, faults)?, pose))
}

/// Returns a rotation that turns z to an axis.
pub(super) fn turn_to_axis(axis: Vec3<Dd>) -> Mat3<Dd> {
    // The component nearest to zero gives a perpendicular direction; exact for x, y and z.
    let sizes = axis.0.map(|x| x.to_f64().abs());
    let smaller = |i: usize, j: usize| if sizes[j] < sizes[i] { j } else { i };
    let least = smaller(smaller(0, 1), 2);
    let mut e = Vec3([Dd::ZERO; 3]);
    e.0[least] = Dd::ONE;
    let across = e.cross(axis);
    let size = across.dot(across);
    let first = if size == Dd::ONE {
        across
    } else {
        across.scale(Dd::ONE / size.sqrt())
    };
    let second = axis.cross(first);
    Mat3::from_fn(|i, j| [first, second, axis][j].0[i])
}

/// Returns the axis of a loop whose rotations are all about one direction, in the axes of place a: that of the
/// first rotation.
pub(super) fn loop_axis(chain: &LoopChain) -> Option<Vec3<Dd>> {
    let (mut rotation, mut axis) = (chain.start.rotation.transpose(), None::<Vec3<Dd>>);
    for step in &chain.steps {
        let origin = step.origin.rotation;
        if step.outward {
            rotation = rotation * origin;
        }
        let along = rotation * step.axis;
        match (step.motion, axis) {
            (Motion::Rotation, None) => axis = Some(along),
            (Motion::Rotation, Some(axis)) if !parallel(axis, along) => return None,
            (Motion::Compound(_), _) => return None,
            _ => {}
        }
        // A rotation about the loop's axis does not change directions along it, nor whether others are parallel.
        if !step.outward {
            rotation = rotation * origin.transpose();
        }
    }
    axis
}

pub(super) fn parallel(a: Vec3<Dd>, b: Vec3<Dd>) -> bool {
    let across = a.cross(b);
    across.dot(across).to_f64() < 1e-40
}

/// Returns the length of a rod; 1 for other types.
fn length(one: &LoopSpec, kind: &ClosingType, faults: &mut Faults) -> Option<Dd> {
    match (&one.length, kind.length) {
        (Field::Broken, _) => None,
        (Field::Absent, false) => Some(Dd::ONE),
        (Field::Absent, true) => {
            faults.push(wording::rod_without_length(&one.location));
            None
        }
        (Field::Given(length), false) => {
            faults.push(wording::loop_key_unused(
                &length.location,
                "length",
                kind.keyword,
                "distance",
            ));
            None
        }
        (Field::Given(length), true) => {
            let value = length.value.value;
            if value <= Dd::ZERO {
                faults.push(wording::rod_length(&length.location, &length.value.text));
                return None;
            }
            Some(value)
        }
    }
}

/// Returns the rotation that turns z to the axis.
fn axis(
    one: &LoopSpec,
    kind: &ClosingType,
    directions: &Directions,
    faults: &mut Faults,
) -> Option<Mat3<Dd>> {
    let given = match &one.axis {
        Field::Broken => return None,
        Field::Absent => return Some(Directions::identity().rotation),
        Field::Given(given) => given,
    };
    if !kind.axial {
        faults.push(wording::loop_key_unused(
            &given.location,
            "axis",
            kind.keyword,
            "hinge` and `slider",
        ));
        return None;
    }
    Some(turn_to_axis(directions.axis(given, faults)?))
}

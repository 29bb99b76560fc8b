//! Reads an entry of `loops`: names, places, and the chain of joints from place to place.

use bgdyn_runtime::Dd;

use super::allowed;
use crate::fault::{Faults, Location, wording};
use crate::format::{Dimension, Field, Located, LoopEndSpec, LoopSpec, Spec, check_unit};
use crate::math::{Mat3, Vec3};
use crate::mechanism::check::direction::Directions;
use crate::mechanism::closure::{CLOSING_TYPES, ChainStep, ClosingType, KinematicLoop, LoopChain};
use crate::mechanism::{Joint, LinkId, Mechanism, Motion, Pose, PositionId};
use crate::name::{WORLD, is_identifier};

/// A loop of the file.
pub(super) struct ReadLoop {
    pub(super) closes: KinematicLoop,
    /// Whether the places lie left or right of the line between the outer joints, with the word.
    pub(super) branch: Option<Located<bool>>,
    /// Positions to start from.
    pub(super) near: Vec<(PositionId, Dd)>,
    /// Whether its rows may follow from others.
    pub(super) redundant: bool,
    /// The gap by which rows that follow from others may be open, m or rad; 0 without the key.
    pub(super) tolerance: f64,
}

/// What the entries of `loops` refer to.
pub(super) type Context<'a> = (&'a Spec, &'a Mechanism, &'a Directions);

/// Reads a loop. `None` if a rule is broken.
pub(super) fn read(one: &LoopSpec, context: Context<'_>, faults: &mut Faults) -> Option<ReadLoop> {
    let (spec, mechanism, directions) = context;
    let name = one.name.given()?;
    if !is_identifier(&name.value) {
        faults.push(wording::not_identifier(&name.location, &name.value));
    }
    if is_taken(spec, mechanism, one, &name.value) {
        faults.push(wording::loop_has_taken_name(&name.location, &name.value));
    }
    let kind = kind(one, faults);
    let a = end(one.a.value()?, context, faults);
    let b = end(one.b.value()?, context, faults);
    let (kind, a, b) = (kind?, a?, b?);
    let length = length(one, kind, faults)?;
    let turn = axis(one, kind, directions, faults)?;
    let near = near(one, mechanism, faults);
    let path = path(mechanism, a.0, b.0);
    if path.is_empty() {
        faults.push(wording::loop_closes_nothing(&one.location, &name.value));
        return None;
    }
    let turned = |pose: Pose| Pose {
        rotation: pose.rotation * turn,
        ..pose
    };
    let chain = LoopChain {
        start: turned(a.1),
        steps: path
            .iter()
            .map(|&(link, outward)| step(mechanism, link, outward))
            .collect(),
        end: turned(b.1),
    };
    let mut suitable = true;
    for &(link, _) in path
        .iter()
        .filter(|(link, _)| !is_suitable(mechanism, *link))
    {
        suitable = false;
        unsuitable(one, &name.value, mechanism, link.0, faults);
    }
    let axis = loop_axis(&chain);
    let branch = branch(
        one,
        axis.is_some() && a.0.is_some() && b.0.is_some() && kind.coincident,
        faults,
    );
    let redundant = allowed::redundant(one, faults);
    let tolerance = allowed::tolerance(one, faults);
    if !suitable {
        return None;
    }
    Some(ReadLoop {
        closes: KinematicLoop {
            name: name.value.clone(),
            kind,
            links: [a.0, b.0],
            chain,
            length,
            axis,
            reversible: false,
            contact: None,
            location: one.location.clone(),
        },
        branch,
        near,
        redundant: redundant?,
        tolerance: tolerance?,
    })
}

/// Returns whether a link, a joint, a frame, a constraint, an effect or another loop has this name.
fn is_taken(spec: &Spec, mechanism: &Mechanism, own: &LoopSpec, name: &str) -> bool {
    let links = mechanism.links().iter();
    let mut joints = links.flat_map(|link| [&link.name, &link.joint.name]);
    let mut frames = mechanism.frames().iter();
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
    (_, mechanism, directions): Context<'_>,
    faults: &mut Faults,
) -> Option<(Option<LinkId>, Pose)> {
    if let Some(frame) = end.frame.given() {
        if let Some(given) = end.link.given() {
            faults.push(wording::loop_end_twice(&given.location));
        }
        let mut frames = mechanism.frames().iter();
        let Some(found) = frames.find(|known| known.name == frame.value) else {
            let known: Vec<&str> = mechanism.frames().iter().map(|f| f.name.as_str()).collect();
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
    Some((
        find_link(&link.value, &link.location, mechanism, faults)?,
        pose,
    ))
}

/// Returns the link of this name; `None` in it for the world.
pub(super) fn find_link(
    name: &str,
    location: &Location,
    mechanism: &Mechanism,
    faults: &mut Faults,
) -> Option<Option<LinkId>> {
    if name == WORLD {
        return Some(None);
    }
    let shown = || mechanism.links().iter().filter(|link| !link.hidden);
    let found = mechanism
        .links()
        .iter()
        .position(|known| !known.hidden && known.name == name);
    if found.is_none() {
        let known: Vec<&str> = shown().map(|link| link.name.as_str()).collect();
        let is_frame = mechanism.frames().iter().any(|frame| frame.name == name);
        faults.push(wording::unknown_link(
            location,
            "unknown-link",
            name,
            &known,
            is_frame,
        ));
    }
    Some(Some(LinkId(found?)))
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

/// Reads the positions to start from.
fn near(one: &LoopSpec, mechanism: &Mechanism, faults: &mut Faults) -> Vec<(PositionId, Dd)> {
    let own = |joint: &&Joint| joint.degrees.own_positions() && joint.kind.one_degree();
    let all = || mechanism.links().iter().map(|link| &link.joint).filter(own);
    let mut found = Vec::new();
    for (name, number) in one.near.value().into_iter().flatten() {
        let joint = all().find(|joint| joint.name == name.value);
        let Some((joint, &position)) = joint.and_then(|j| Some((j, j.degrees.positions.first()?)))
        else {
            let names: Vec<&str> = all().map(|joint| joint.name.as_str()).collect();
            let fault = wording::unknown_constrained_joint(&name.location, &name.value, &names);
            faults.push(fault);
            continue;
        };
        let dimension = match joint.kind.motion {
            Motion::Translation => Dimension::Length,
            _ => Dimension::Angle,
        };
        match check_unit(number, &[dimension]) {
            Some(fault) => faults.push(fault),
            None => found.push((position, number.value.value)),
        }
    }
    found
}

fn branch(one: &LoopSpec, planar: bool, faults: &mut Faults) -> Option<Located<bool>> {
    let word = one.branch.given()?;
    let left = match word.value.as_str() {
        "left" => true,
        "right" => false,
        _ => {
            faults.push(wording::unknown_branch(&word.location, &word.value));
            return None;
        }
    };
    if !planar {
        faults.push(wording::branch_of_spatial_loop(&word.location));
        return None;
    }
    Some(Located {
        value: left,
        location: word.location.clone(),
    })
}

/// Returns the links whose joints lead from place a to place b, and whether each is passed outward.
pub(super) fn path(
    mechanism: &Mechanism,
    a: Option<LinkId>,
    b: Option<LinkId>,
) -> Vec<(LinkId, bool)> {
    let to_base = |mut link: Option<LinkId>| {
        let mut all = Vec::new();
        while let Some(l) = link {
            all.push(l);
            link = mechanism.links()[l.0].parent;
        }
        all
    };
    let (from, to) = (to_base(a), to_base(b));
    let inward = from
        .iter()
        .filter(|link| !to.contains(link))
        .map(|&link| (link, false));
    let outward = to
        .iter()
        .rev()
        .filter(|link| !from.contains(link))
        .map(|&link| (link, true));
    inward.chain(outward).collect()
}

pub(super) fn step(mechanism: &Mechanism, link: LinkId, outward: bool) -> ChainStep {
    let joint = &mechanism.links()[link.0].joint;
    ChainStep {
        link,
        outward,
        origin: joint.origin,
        motion: joint.kind.motion,
        axis: joint.axis,
        degrees: joint.degrees.clone(),
    }
}

/// Returns whether a loop can go through the joint: it has at most one velocity, which moves no joint whose
/// position is not a function of its own.
fn is_suitable(mechanism: &Mechanism, link: LinkId) -> bool {
    let joint = &mechanism.links()[link.0].joint;
    let coupling = joint.degrees.coupling.as_ref();
    let by_velocity = coupling.is_some_and(|coupling| !coupling.of_positions());
    joint.kind.motion.nv() <= 1 && joint.kind.motion.nq() <= 1 && !by_velocity
}

/// Returns the axis of a loop whose rotations are all about one direction, in the axes of place a: that of the
/// first rotation.
fn loop_axis(chain: &LoopChain) -> Option<Vec3<Dd>> {
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

fn parallel(a: Vec3<Dd>, b: Vec3<Dd>) -> bool {
    let across = a.cross(b);
    across.dot(across).to_f64() < 1e-40
}

/// Reports a joint that no loop can go through.
fn unsuitable(one: &LoopSpec, name: &str, mechanism: &Mechanism, link: usize, faults: &mut Faults) {
    let joint = &mechanism.links()[link].joint;
    faults.push(wording::loop_through_joint(
        &one.location,
        name,
        &joint.name,
        joint.kind.keyword,
    ));
}

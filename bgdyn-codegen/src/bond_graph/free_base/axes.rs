//! Axes of links along the axes of joints.
//!
//! A link may have any axes, if a joint's axis passes through their origin: Rot(a, q) X = X Rot(Rᵀ a, q) for a pose X
//! with the rotation R and its origin on the axis. In axes along those of its joints a rotation is one in a plane.

use bgdyn_runtime::Dd;

use crate::bond_graph::multibody::{LinkFrame, Multibody};
use crate::math::{Mat3, Vec3};
use crate::mechanism::{LinkId, Motion, Pose};

/// Components deviate by less from 0 and 1 by rounding alone.
const ROUNDING: f64 = 1e-24;

/// The base whose links get axes.
pub(super) struct Base<'a> {
    /// The link.
    pub link: LinkId,
    /// Whether its axes may turn and move, too.
    pub free: bool,
    /// Places of contacts, on their links.
    pub places: &'a [(LinkId, Vec3<Dd>)],
}

/// Returns the pose of the new axes of each link in its old ones.
pub(super) fn link_axes(graph: &Multibody, base: &Base<'_>) -> Vec<Pose> {
    let mut all: Vec<Pose> = Vec::new();
    for (i, frame) in graph.frames.iter().enumerate() {
        let own = LinkId(i) == base.link;
        let pose = match frame.motion {
            _ if own && !base.free => Pose::IDENTITY,
            Motion::Compound(_) if !own => Pose::IDENTITY,
            _ if frame.parent.is_none() && !own => Pose::IDENTITY,
            _ => {
                let carried = frame.parent.map_or(Pose::IDENTITY, |p| all[p.0]);
                axes_of(graph, (LinkId(i), frame), (own, carried), base)
            }
        };
        all.push(pose);
    }
    all
}

/// Returns the pose of the new axes of one link, whose parent has these new axes.
fn axes_of(
    graph: &Multibody,
    (link, frame): (LinkId, &LinkFrame),
    (is_base, carried): (bool, Pose),
    base: &Base<'_>,
) -> Pose {
    let children = || graph.frames.iter().filter(|c| c.parent == Some(link));
    let turning = children().filter(|c| c.motion == Motion::Rotation);
    let mut directions: Vec<Vec3<Dd>> = turning.map(|c| c.origin.rotation * c.axis).collect();
    let turns = frame.motion == Motion::Rotation && !is_base;
    if turns {
        directions.insert(0, frame.axis);
    }
    let start = match is_base {
        true => Pose::IDENTITY.rotation,
        false => snapped(frame.origin.rotation.transpose() * carried.rotation),
    };
    let along = |rotation: &Mat3<Dd>| {
        let mut all = directions.iter().map(|&d| rotation.transpose() * d);
        all.all(|d| d.0.iter().filter(|x| x.to_f64().abs() > ROUNDING).count() == 1)
    };
    let choices = [start, Pose::IDENTITY.rotation];
    let rotation = choices.into_iter().find(along);
    let rotation = rotation.or_else(|| triad(&directions)).unwrap_or(start);
    let mut places = base.places.iter().filter(|(at, _)| *at == link);
    let place = places.next().map(|(_, place)| *place);
    let child = children().next().map(|c| c.origin.translation);
    let zero = Vec3([Dd::ZERO; 3]);
    let translation = match (is_base, turns) {
        (true, _) => place.unwrap_or(zero),
        (_, true) => {
            let to = child.or(place).unwrap_or(zero);
            frame.axis.scale(frame.axis.dot(to))
        }
        _ => zero,
    };
    Pose {
        rotation,
        translation,
    }
}

/// Returns axes along the first direction and, as far as that is possible, the next one that is not parallel.
fn triad(directions: &[Vec3<Dd>]) -> Option<Mat3<Dd>> {
    let unit = |v: Vec3<Dd>| v.scale(Dd::ONE / v.dot(v).sqrt());
    let z = unit(*directions.first()?);
    let across = directions.iter().map(|d| *d - z.scale(z.dot(*d)));
    let across = across.map(|d| (d.dot(d).to_f64(), d));
    let (_, x) = across.into_iter().find(|(size, _)| *size > 1e-12)?;
    // Each of both becomes the coordinate axis that is nearest to it.
    let nearest = |v: Vec3<Dd>, but: Option<usize>| {
        let free = (0..3).filter(|k| Some(*k) != but);
        let size = |k: usize| v.0[k].to_f64().abs();
        free.max_by(|a, b| size(*a).total_cmp(&size(*b)))
    };
    let x = unit(x);
    let first = nearest(z, None)?;
    let second = nearest(x, Some(first))?;
    let ahead = |v: Vec3<Dd>, k: usize| if v.0[k].to_f64() < 0.0 { -v } else { v };
    let (z, x) = (ahead(z, first), ahead(x, second));
    let third = 3 - first - second;
    let mut columns = [z; 3];
    columns[second] = x;
    columns[third] = columns[(third + 1) % 3].cross(columns[(third + 2) % 3]);
    Some(snapped(Mat3(columns.map(|v| v.0)).transpose()))
}

/// Returns a rotation with 0, 1 and −1 for components that differ from them by rounding.
fn snapped(rotation: Mat3<Dd>) -> Mat3<Dd> {
    rotation.map(snap)
}

/// Returns 0, 1 or −1 for a component that differs from them by rounding.
pub fn snap(x: Dd) -> Dd {
    let near = Dd::from_f64(x.to_f64().round());
    match (x - near).to_f64().abs() < ROUNDING {
        true => near,
        false => x,
    }
}

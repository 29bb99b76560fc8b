//! Masses moved across the closing pins of planar loops (base parameters of loops).
//!
//! The closing pin belongs to both of its links: a point mass μ there may move from one link to the other. Efforts and
//! accelerations of independent joints remain, because the two pins coincide; loads of the pin change by μ (p̈ − g).
//! μ is chosen such that the first moment of a link, about its other pin, has no component along the line of its pins:
//! it is then μ = m c·p / p·p.

use std::cmp::Reverse;

use bgdyn_runtime::Dd;

use super::build::add_fixed_body;
use super::{BondGraph, LinkFrame};
use crate::math::Vec3;
use crate::mechanism::closure::{Closure, polygons};
use crate::mechanism::{Degrees, Inertial, LinkId, Motion, Pose, Value};

/// Returns the graph of an open tree with masses moved across the closing pins of its planar loops; `None` if there are
/// none that can move.
pub fn with_moved_masses(tree: &BondGraph, closure: &Closure) -> Option<BondGraph> {
    let mut moved: Option<BondGraph> = None;
    for polygon in polygons(closure)? {
        let one = &closure.loops[polygon.closes];
        let pins = [
            one.links[0].map(|link| (link, one.chain.start.translation)),
            one.links[1].map(|link| (link, one.chain.end.translation)),
        ];
        let [Some(a), Some(b)] = pins else { continue };
        let dependent = |graph: &BondGraph, link: LinkId| {
            let own = &graph.frames[link.0].degrees.velocities;
            own.iter().any(|j| closure.dependents().any(|d| d == *j))
        };
        let best = |graph: &BondGraph| {
            let ways = [(a, b), (b, a)].into_iter().filter_map(|(from, to)| {
                let (mass, left) = movable(graph, from.0, from.1)?;
                dependent(graph, from.0).then_some((mass, left, from, to))
            });
            // The link whose first moment vanishes; then the one that more joints carry.
            ways.min_by_key(|(_, left, (from, _), _)| (*left, Reverse(depth(graph, *from))))
        };
        let graph = moved.as_ref().unwrap_or(tree);
        if let Some((mass, _, from, to)) = best(graph) {
            let graph = moved.get_or_insert_with(|| tree.clone());
            add_point(graph, from, -mass);
            add_point(graph, to, mass);
        }
    }
    moved
}

/// Returns the mass at a pin of a link with which the first moment about its origin has no component along the line
/// from there to the pin, and whether a component across it is left; `None` if the link turns about no pin, its mass
/// is a run-time parameter, or it carries other links.
fn movable(graph: &BondGraph, link: LinkId, pin: Vec3<Dd>) -> Option<(Dd, bool)> {
    let frame = &graph.frames[link.0];
    let carries = graph.frames.iter().any(|other| other.parent == Some(link));
    let inertial = graph.inertial(link);
    let Value::Fixed(mass) = inertial.mass else {
        return None;
    };
    let mut com = [Dd::ZERO; 3];
    for (x, value) in com.iter_mut().zip(inertial.com.0) {
        match value {
            Value::Fixed(value) => *x = value,
            Value::Parameter(_) => return None,
        }
    }
    if frame.motion != Motion::Rotation || carries {
        return None;
    }
    let across = |v: Vec3<Dd>| v - frame.axis.scale(v.dot(frame.axis));
    let (line, com) = (across(pin), across(Vec3(com)));
    let mu = mass * com.dot(line) / line.dot(line);
    let left = com.cross(line).dot(com.cross(line)).to_f64();
    let left = left > 1e-40 * (com.dot(com) * line.dot(line)).to_f64();
    (line.dot(line).to_f64() > 1e-18 && mu != Dd::ZERO).then_some((mu, left))
}

/// Returns the number of links that carry a link.
fn depth(graph: &BondGraph, link: LinkId) -> usize {
    let next = |link: &LinkId| graph.frames[link.0].parent;
    std::iter::successors(Some(link), next).count()
}

/// Adds a point mass, which may be negative, as a link without joint.
fn add_point(graph: &mut BondGraph, (link, point): (LinkId, Vec3<Dd>), mass: Dd) {
    let zero = Value::Fixed(Dd::ZERO);
    let point = LinkFrame {
        name: format!("{}_pin", graph.frames[link.0].name),
        parent: Some(link),
        origin: Pose {
            translation: point,
            ..Pose::IDENTITY
        },
        motion: Motion::None,
        axis: Vec3([Dd::ZERO, Dd::ZERO, Dd::ONE]),
        coordinate: None,
        degrees: Degrees::default(),
        hidden: true,
        com: Vec3([zero; 3]),
        tensor_axes: Pose::IDENTITY.rotation,
    };
    let mut inertial: Inertial = graph.inertial(link);
    inertial.mass = Value::Fixed(mass);
    inertial.com = point.com;
    inertial.inertia.entries = [zero; 6];
    inertial.inertia.axes = point.tensor_axes;
    add_fixed_body(graph, point, inertial);
}

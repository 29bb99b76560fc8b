//! Computes, for each joint, the inertia of its own body over the inertia of all that it moves.
//!
//! If this ratio is almost zero, the joint's pivot in the forward dynamics is a small difference of large
//! terms, or only rounding error.

use super::geometry::{Body, Geometry};
use crate::bond_graph::Multibody;
use crate::mechanism::{LinkId, Motion, Pose, Value};

/// The least safe ratio: below it, elimination could lose half the digits of `f64`, and all of those of
/// `f32`, so that a pivot's check needs a bound of its rounding error. Chains of a hundred similar links
/// are above it, a load of a million times a link's mass is below.
pub(super) const MIN_INERTIA_RATIO: f64 = 1e-7;

/// Assumed travel of a prismatic joint without limits, m.
const TRAVEL: f64 = 1.0;

/// Returns, for each joint, its own body's inertia about the axis (its mass along it) over a bound for
/// that of everything outboard of the joint, in any position. A pivot is between the two. Run-time
/// parameters have their default values. The first of two joints in series, whose link is hidden, has the
/// inertia of the next body. A base whose motion is given has no pivot: 1.
pub(super) fn own_inertia_ratios(graph: &Multibody, geometry: &Geometry) -> Vec<f64> {
    let bodies = &geometry.bodies;
    let mut lumps: Vec<LumpedBody> = bodies
        .iter()
        .map(|body| LumpedBody::new(graph, body))
        .collect();
    for j in (0..bodies.len()).rev() {
        if bodies[j].hidden
            && let Some(next) = (0..bodies.len()).find(|&i| bodies[i].parent == Some(j))
        {
            lumps[j] = LumpedBody {
                about_axis: lumps[next].second,
                ..lumps[next]
            };
        }
    }
    (0..bodies.len())
        .map(|j| {
            if bodies[j].motion.is_given() {
                return 1.0;
            }
            let beyond: f64 = (j..bodies.len())
                .filter_map(|i| Some(lumps[i].at_most(bodies[j].motion, distance(bodies, j, i)?)))
                .sum();
            let own = match bodies[j].motion {
                Motion::Rotation => lumps[j].about_axis,
                Motion::Translation => lumps[j].mass,
                // A helical joint moves both. Rotations about a point are judged by the size of the tensor.
                _ if bodies[j].axial => lumps[j].about_axis,
                _ => lumps[j].second,
            };
            if own > 0.0 { own / beyond } else { 0.0 }
        })
        .collect()
}

/// Returns the largest distance of the origin of body i from that of body j; `None` unless j is inboard of
/// i.
fn distance(bodies: &[Body], j: usize, i: usize) -> Option<f64> {
    let (mut at, mut sum) = (i, 0.0);
    while at != j {
        let offset = bodies[at].offset;
        sum += offset.dot(offset).to_f64().sqrt();
        if bodies[at].motion != Motion::Rotation {
            sum += TRAVEL;
        }
        at = bodies[at].parent?;
    }
    Some(sum)
}

/// A body's mass and moments.
#[derive(Clone, Copy, Default)]
struct LumpedBody {
    /// kg
    mass: f64,
    /// Moment of inertia about the joint's axis, kg·m².
    about_axis: f64,
    /// Σ m |r| and a bound for the moment of inertia about any axis through the origin.
    first: f64,
    second: f64,
}

impl LumpedBody {
    fn new(graph: &Multibody, body: &Body) -> Self {
        let mut sum = LumpedBody::default();
        for (link, pose) in &body.links {
            sum.add(graph, body, *link, pose);
        }
        sum
    }

    fn add(&mut self, graph: &Multibody, body: &Body, link: LinkId, pose: &Pose) {
        let inertial = graph.inertial(link);
        let number = |x: Value| match x {
            Value::Fixed(x) => x,
            Value::Parameter(p) => graph.parameters[p.0].default,
        };
        let r = pose.translation + pose.rotation * inertial.com.map(number);
        let z = body.axes.column(2);
        let mass = number(inertial.mass).to_f64();
        let tensor = &inertial.inertia;
        let [xx, yy, zz, xy, xz, yz] = tensor.entries.map(|x| number(x).to_f64());
        let in_tensor_axes = tensor.axes.transpose() * (pose.rotation.transpose() * z);
        let [u, v, w] = in_tensor_axes.0.map(|x| x.to_f64());
        let across = z.cross(r);
        self.mass += mass;
        self.about_axis += mass * across.dot(across).to_f64()
            + (xx * u * u + yy * v * v + zz * w * w)
            + 2.0 * (xy * u * v + xz * u * w + yz * v * w);
        let square = r.dot(r).to_f64();
        self.first += mass * square.sqrt();
        self.second += mass * square + (xx + yy + zz);
    }

    /// Returns an upper bound of the inertia about or along the joint's axis, at a distance.
    fn at_most(&self, motion: Motion, distance: f64) -> f64 {
        match motion {
            Motion::Translation => self.mass,
            _ => self.second + 2.0 * self.first * distance + self.mass * distance * distance,
        }
    }
}

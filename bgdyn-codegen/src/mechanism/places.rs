//! Samples positions of links and frames at a few states, to determine whether a distance can change.

use bgdyn_runtime::Dd;

use super::joint::DoubleDouble;
use super::{Joint, LinkId, Mechanism, Motion, Pose, PositionId};
use crate::math::{Vec3, rodrigues};

/// Number of sampled positions.
const POSITIONS: usize = 4;
/// Distances that differ by less, relative to the largest coordinate, are equal: a bound with a margin for
/// the rounding of double-double.
const ROUNDING: f64 = 1e-26;

/// The origins of links and frames in the world at sampled positions, m.
#[derive(Clone, Debug, Default)]
pub(crate) struct SiteOrigins {
    names: Vec<String>,
    origins: Vec<[Vec3<Dd>; POSITIONS]>,
}

impl SiteOrigins {
    /// Returns those of a mechanism: links first, then frames.
    pub(crate) fn new(mechanism: &Mechanism) -> Self {
        let poses = Self::sampled_poses(mechanism);
        let links = mechanism.links().iter().enumerate();
        let links = links.map(|(i, link)| {
            let origins = std::array::from_fn(|k| poses[k][i].translation);
            (link.name.clone(), origins)
        });
        let frames = mechanism.frames().iter().map(|frame| {
            let carrier = |k: usize| frame.link.map_or(Pose::IDENTITY, |link| poses[k][link.0]);
            let origins = std::array::from_fn(|k| after(carrier(k), frame.origin).translation);
            (frame.name.clone(), origins)
        });
        let (names, origins) = links.chain(frames).unzip();
        SiteOrigins { names, origins }
    }

    /// Returns the poses of the links in the world at each sampled position.
    pub(crate) fn sampled_poses(mechanism: &Mechanism) -> [Vec<Pose>; POSITIONS] {
        let free = mechanism.released();
        std::array::from_fn(|k| link_poses(&free, k))
    }

    /// Returns the names.
    pub(crate) fn names(&self) -> &[String] {
        &self.names
    }

    /// Returns the distance of two sites if it is the same at all positions, m.
    pub(crate) fn constant_distance(&self, a: &str, b: &str) -> Option<f64> {
        let of = |name: &str| {
            let i = self.names.iter().position(|known| known == name);
            i.and_then(|i| self.origins.get(i))
        };
        let (a, b) = (of(a)?, of(b)?);
        let size = a.iter().chain(b).flat_map(|r| r.0);
        let size = size.map(|x| x.to_f64().abs()).fold(0.0, f64::max);
        let apart = |k: usize| {
            let d = a[k] - b[k];
            d.dot(d)
        };
        let first = apart(0);
        let same =
            (1..POSITIONS).all(|k| (apart(k) - first).to_f64().abs() <= ROUNDING * size * size);
        same.then(|| first.to_f64().max(0.0).sqrt())
    }
}

/// Returns the poses of the links in the world at sampled position `k`.
fn link_poses(mechanism: &Mechanism, k: usize) -> Vec<Pose> {
    let mut poses: Vec<Pose> = Vec::with_capacity(mechanism.links().len());
    for link in mechanism.links() {
        let carrier = |LinkId(i): LinkId| poses.get(i).copied().unwrap_or(Pose::IDENTITY);
        let placed = after(
            link.parent.map_or(Pose::IDENTITY, carrier),
            link.joint.origin,
        );
        let moved = moved(&link.joint, k);
        poses.push(after(placed, moved));
    }
    poses
}

/// Returns the pose of a joint's link in its origin at sampled position `k`.
fn moved(joint: &Joint, k: usize) -> Pose {
    let own = |p: &PositionId| sampled(p.0, k);
    let mut q = joint.degrees.positions_of(own);
    match joint.kind.motion {
        Motion::None => Pose::IDENTITY,
        Motion::Rotation => {
            let (sin, cos) = q[0].sin_cos();
            Pose {
                rotation: rodrigues(joint.axis, (cos, sin), |x| x),
                ..Pose::IDENTITY
            }
        }
        Motion::Translation => Pose {
            translation: joint.axis.scale(q[0]),
            ..Pose::IDENTITY
        },
        Motion::Compound(motion) => {
            if let Some(first) = motion.quaternion() {
                let own = &mut q[first..first + 4];
                let square = own.iter().fold(Dd::ZERO, |sum, &x| sum + x * x);
                let length = square.sqrt();
                own.iter_mut().for_each(|x| *x /= length);
            }
            let (rotation, translation) = motion.pose(&joint.constants(), &q, &DoubleDouble);
            Pose {
                rotation,
                translation,
            }
        }
    }
}

/// Returns a coordinate at a sampled position: multiples of the golden ratio by squares, so that neither single
/// coordinates nor differences of two have the same value at all positions.
fn sampled(coordinate: usize, position: usize) -> Dd {
    let count = 1 + coordinate * POSITIONS + position;
    let step = (count * count) as f64 * 0.618_033_988_749_894_9;
    Dd::from_f64(5.0 * (step - step.floor()) - 2.5)
}

/// Returns the pose of `inner`, given in the axes of `outer`, in the axes in which `outer` is given.
fn after(outer: Pose, inner: Pose) -> Pose {
    Pose {
        rotation: outer.rotation * inner.rotation,
        translation: outer.translation + outer.rotation * inner.translation,
    }
}

//! The transformers of a bond graph: which coordinates their moduli depend on, found from patterns of the links' poses.

use bgdyn_runtime::Dd;

use super::pattern::{Coordinates, Modulus};
use super::{BondGraph, JunctionId, LinkFrame, Transformer};
use crate::math::{Mat3, Vec3, rodrigues};
use crate::mechanism::joint::{Column, PoseNumbers};
use crate::mechanism::{CoordinateId, LinkId, Motion, Pose, Value};

/// Pattern of a link frame's axes and origin in fixed axes.
#[derive(Clone, Copy)]
pub(super) struct PosePattern {
    rotation: Mat3<Modulus>,
    origin: Vec3<Modulus>,
    /// The joint's axis; its own rotation does not change it.
    axis: Vec3<Modulus>,
}

/// Returns those of all links, in their order.
pub(super) fn patterns(frames: &[LinkFrame]) -> Vec<PosePattern> {
    let mut patterns: Vec<PosePattern> = Vec::with_capacity(frames.len());
    for frame in frames {
        let parent = frame.parent.map(|p| patterns[p.0]);
        patterns.push(pattern(frame, parent));
    }
    patterns
}

fn pattern(frame: &LinkFrame, parent: Option<PosePattern>) -> PosePattern {
    let Pose {
        rotation,
        translation,
    } = frame.origin;
    let mut rotation = rotation.map(Modulus::constant);
    let mut origin = translation.map(Modulus::constant);
    if let Some(parent) = parent {
        origin = parent.origin + parent.rotation * origin;
        rotation = parent.rotation * rotation;
    }
    let axis = rotation * frame.axis.map(Modulus::constant);
    let (turned, shift) = match frame.motion {
        Motion::None => (Mat3::from_fn(identity), Vec3([Modulus::Zero; 3])),
        Motion::Rotation => {
            let varying = position(frame, 0);
            (
                rodrigues(frame.axis, (varying, varying), Modulus::constant),
                Vec3([Modulus::Zero; 3]),
            )
        }
        Motion::Translation => {
            let along = frame.axis.map(Modulus::constant).scale(position(frame, 0));
            (Mat3::from_fn(identity), along)
        }
        Motion::Compound(motion) => {
            let q: Vec<Modulus> = (0..motion.positions.len())
                .map(|k| position(frame, k))
                .collect();
            motion.pose(&frame.constants(), &q, &Patterns)
        }
    };
    PosePattern {
        rotation: rotation * turned,
        origin: origin + rotation * shift,
        axis,
    }
}

fn identity(i: usize, j: usize) -> Modulus {
    if i == j {
        Modulus::constant(Dd::ONE)
    } else {
        Modulus::Zero
    }
}

/// Returns the columns of a joint's motion subspace in fixed axes.
fn columns(frame: &LinkFrame, pattern: &PosePattern) -> Vec<(CoordinateId, Column<Modulus>)> {
    if let Some(columns) = frame.degrees.axial(frame.motion) {
        let of = |(j, factors): (CoordinateId, [Dd; 2])| {
            let [angular, linear] = factors.map(|k| pattern.axis.scale(Modulus::constant(k)));
            (j, Column { angular, linear })
        };
        return columns.into_iter().map(of).collect();
    }
    let fixed = |v: Vec3<Dd>| pattern.rotation * v.map(Modulus::constant);
    let of = |(j, column): (CoordinateId, Column<Dd>)| {
        let (angular, linear) = (fixed(column.angular), fixed(column.linear));
        (j, Column { angular, linear })
    };
    frame.columns().into_iter().map(of).collect()
}

/// Returns the pattern of position k of a joint: it varies with the coordinates that change it.
fn position(frame: &LinkFrame, k: usize) -> Modulus {
    let one_by_one = frame.degrees.positions.len() == 1 && frame.degrees.velocities.len() == 1;
    let moved = match (frame.motion, frame.degrees.velocities.get(k)) {
        (Motion::Rotation | Motion::Translation, Some(&j)) if one_by_one => Coordinates::one(j),
        _ => {
            let all = frame.degrees.velocities.iter();
            all.fold(Coordinates::default(), |set, &j| {
                set.union(Coordinates::one(j))
            })
        }
    };
    Modulus::Varying(moved)
}

/// Patterns as the numbers of a pose.
struct Patterns;

impl PoseNumbers<Modulus> for Patterns {
    fn constant(&self, x: Dd) -> Modulus {
        Modulus::constant(x)
    }

    fn cos_sin(&self, angle: Modulus) -> (Modulus, Modulus) {
        (angle, angle)
    }

    fn twice_inverse(&self, squares: Modulus) -> Modulus {
        squares
    }
}

/// Adds the transformers ρ_j^i and ∂r_i/∂q_j for every coordinate on the path from the base to link i.
pub(super) fn add_transformers(graph: &mut BondGraph, patterns: &[PosePattern], i: LinkId) {
    let com = graph.frames[i.0].com.map(|c| match c {
        Value::Fixed(c) => Modulus::constant(c),
        // The value of a parameter is not known at generation time.
        Value::Parameter(_) => Modulus::Varying(Coordinates::default()),
    });
    let mut path = Vec::new();
    let mut link = Some(i);
    while let Some(l) = link {
        path.push(l);
        link = graph.frames[l.0].parent;
    }
    // A coordinate moves link i through its own joint and through joints that follow it.
    let mut sums: Vec<(CoordinateId, Column<Modulus>)> = Vec::new();
    for l in path.into_iter().rev() {
        let columns = columns(&graph.frames[l.0], &patterns[l.0]);
        if columns.is_empty() {
            continue;
        }
        let arm = lever(&graph.frames, patterns, l, i, com);
        for (j, Column { angular, linear }) in columns {
            let linear = linear + angular.cross(arm);
            match sums.iter_mut().find(|(k, _)| *k == j) {
                Some((_, sum)) => {
                    sum.angular = sum.angular + angular;
                    sum.linear = sum.linear + linear;
                }
                None => sums.push((j, Column { angular, linear })),
            }
        }
    }
    for (j, column) in sums {
        add(graph, j, graph.rotation(i), column.angular);
        add(graph, j, graph.translation(i), column.linear);
    }
}

/// Returns the pattern of r_i − o_l: from the origin of link l, on the path, to the centre of mass of link
/// i. The sum runs over the links between them, so that common terms never enter.
fn lever(
    frames: &[LinkFrame],
    patterns: &[PosePattern],
    l: LinkId,
    i: LinkId,
    com: Vec3<Modulus>,
) -> Vec3<Modulus> {
    let mut lever = patterns[i.0].rotation * com;
    let mut link = i;
    while link != l {
        let Some(parent) = frames[link.0].parent else {
            break;
        };
        let step = frames[link.0].origin.translation.map(Modulus::constant);
        lever = lever + patterns[parent.0].rotation * step;
        lever = lever + shifts(&frames[link.0], patterns[parent.0].rotation);
        link = parent;
    }
    lever
}

/// Returns the pattern of the displacement of a link's origin by its own joint; `carrier` is the pattern of
/// the parent's axes.
fn shifts(frame: &LinkFrame, carrier: Mat3<Modulus>) -> Vec3<Modulus> {
    let origin = carrier * frame.origin.rotation.map(Modulus::constant);
    match frame.motion {
        Motion::None | Motion::Rotation => Vec3([Modulus::Zero; 3]),
        Motion::Translation => {
            (origin * frame.axis.map(Modulus::constant)).scale(position(frame, 0))
        }
        Motion::Compound(motion) => {
            let q: Vec<Modulus> = (0..motion.positions.len())
                .map(|k| position(frame, k))
                .collect();
            origin * motion.pose(&frame.constants(), &q, &Patterns).1
        }
    }
}

fn add(graph: &mut BondGraph, from: CoordinateId, to: JunctionId, modulus: Vec3<Modulus>) {
    if modulus.0.iter().any(|m| !m.is_zero()) {
        let from = graph.velocity(from);
        graph.transformers.push(Transformer { from, to, modulus });
    }
}

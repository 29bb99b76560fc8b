//! Builds the bond graph of a checked mechanism.

use bgdyn_runtime::Dd;

use super::pattern::{Coordinates, Modulus};
use super::{
    BondGraph, ClosedTree, Coordinate, Effort, EffortSource, Junction, JunctionId, LinkFrame,
    Multibody, PositionVariable, Released, Site, Store, StoreInertia, Transformer,
};
use crate::math::{Mat3, Vec3, rodrigues};
use crate::mechanism::joint::{self, Column, PoseNumbers};
use crate::mechanism::{
    CoordinateId, Frame, Inertial, Link, LinkId, Mechanism, Motion, Pose, Value,
};

/// Builds the bond graph of a mechanism. With loops, the junctions of the open tree are those of its own graph.
pub fn build(mechanism: &Mechanism) -> BondGraph {
    let mut graph = without_loops(mechanism);
    graph.closed = mechanism.closure().map(|closure| {
        Box::new(ClosedTree {
            tree: without_loops(&mechanism.open()),
            closure: closure.clone(),
        })
    });
    graph
}

fn without_loops(mechanism: &Mechanism) -> BondGraph {
    let links = mechanism.links();
    let mut graph = connected(Multibody {
        coordinates: coordinates(mechanism),
        positions: positions(mechanism),
        frames: links.iter().map(frame).collect(),
        inertials: links.iter().map(|link| link.inertial).collect(),
        gravity: mechanism.gravity(),
        base: mechanism.base().copied(),
        rotors: Vec::new(),
        velocity_products: true,
        parameters: mechanism.parameters().to_vec(),
        sites: sites(mechanism),
    });
    graph.released = released(mechanism).map(Box::new);
    graph.parallel = (mechanism.parallel_loops().iter())
        .map(|one| one.name.clone())
        .collect();
    // The transformers depend on the poses of all joints; formulations read those of prescribed joints from
    // the mechanism in which they are free.
    for prescribed in mechanism.prescribed() {
        graph.multibody.frames[prescribed.link.0].motion = joint::given().motion;
    }
    graph
}

/// Returns the graph of a tree: junctions, stores, sources and transformers.
pub(super) fn connected(multibody: Multibody) -> BondGraph {
    let velocities = 0..multibody.coordinates.len();
    let mut graph = BondGraph {
        junctions: (velocities.map(|j| Junction::Velocity(CoordinateId(j)))).collect(),
        multibody,
        stores: Vec::new(),
        sources: Vec::new(),
        transformers: Vec::new(),
        released: None,
        closed: None,
        parallel: Vec::new(),
    };
    for i in 0..graph.frames.len() {
        let inertial = graph.inertial(LinkId(i));
        add_link(&mut graph, LinkId(i), &inertial);
    }
    let patterns = patterns(&graph.frames);
    for i in 0..graph.frames.len() {
        add_transformers(&mut graph, &patterns, LinkId(i));
    }
    graph
}

/// Returns the mechanism in which the prescribed joints are free; `None` if there are none.
fn released(mechanism: &Mechanism) -> Option<Released> {
    if mechanism.prescribed().is_empty() {
        return None;
    }
    let free = mechanism.released();
    let graph = without_loops(&free);
    Some(Released::new(mechanism, &free, graph))
}

/// Returns the frames of the links, then the named frames. A tip is a link without children.
fn sites(mechanism: &Mechanism) -> Vec<Site> {
    let links = mechanism.links();
    let tip = |i: usize| links.iter().all(|l| l.parent != Some(LinkId(i)));
    let link = |(i, link): (usize, &Link)| Site {
        name: link.name.clone(),
        link: Some(LinkId(i)),
        pose: Pose::IDENTITY,
        exported_by_default: tip(i),
    };
    let frame = |frame: &Frame| Site {
        name: frame.name.clone(),
        link: frame.link,
        pose: frame.origin,
        exported_by_default: true,
    };
    let named = mechanism.frames().iter().map(frame);
    let shown = links.iter().enumerate().filter(|(_, link)| !link.hidden);
    shown.map(link).chain(named).collect()
}

fn coordinates(mechanism: &Mechanism) -> Vec<Coordinate> {
    let names = mechanism.joint_names().into_iter();
    let coordinate = |(j, (&link, name)): (usize, (&LinkId, String))| {
        let joint = &mechanism.links()[link.0].joint;
        let motion = joint.kind.motion;
        let columns = joint.degrees.columns(motion, joint.axis);
        let own = columns.iter().find(|(k, _)| k.0 == j);
        let still = |column: &Column<Dd>| column.angular.0.iter().all(|&x| x == Dd::ZERO);
        Coordinate {
            name,
            link,
            motion,
            linear: own.is_some_and(|(_, column)| still(column)),
        }
    };
    let all = mechanism.coordinates().iter().zip(names);
    all.enumerate().map(coordinate).collect()
}

fn positions(mechanism: &Mechanism) -> Vec<PositionVariable> {
    let names = mechanism.position_names().into_iter();
    let position = |(p, (&link, name)): (usize, (&LinkId, String))| {
        let joint = &mechanism.links()[link.0].joint;
        let own = joint.degrees.positions.iter().position(|x| x.0 == p);
        let single = |k: usize| joint.degrees.velocities.get(k).copied();
        match (joint.kind.motion, own) {
            (Motion::Compound(motion), Some(k)) => PositionVariable {
                name,
                link,
                unit: motion.positions[k].unit,
                coordinate: match motion.positions.len() {
                    1 => single(k),
                    _ => None,
                },
            },
            (motion, _) => PositionVariable {
                name,
                link,
                unit: motion.unit(),
                coordinate: single(0),
            },
        }
    };
    let all = mechanism.positions().iter().zip(names);
    all.enumerate().map(position).collect()
}

fn frame(link: &Link) -> LinkFrame {
    LinkFrame {
        name: link.name.clone(),
        parent: link.parent,
        origin: link.joint.origin,
        motion: link.joint.kind.motion,
        axis: link.joint.axis,
        coordinate: link.joint.coordinate,
        degrees: link.joint.degrees.clone(),
        hidden: link.hidden,
        com: link.inertial.com,
        tensor_axes: link.inertial.inertia.axes,
    }
}

/// Adds the two junctions of a link, each with a store and a source.
fn add_link(graph: &mut BondGraph, i: LinkId, inertial: &Inertial) {
    let (translation, rotation) = (graph.translation(i), graph.rotation(i));
    graph
        .junctions
        .extend([Junction::Translation(i), Junction::Rotation(i)]);
    let mass = inertial.mass;
    graph.stores.extend([
        Store {
            junction: translation,
            inertia: StoreInertia::Mass(mass),
        },
        Store {
            junction: rotation,
            inertia: StoreInertia::Tensor(inertial.inertia.entries),
        },
    ]);
    let weight = Effort::Weight {
        mass,
        gravity: graph.gravity,
    };
    let still = graph.gravity.0.iter().all(|&g| g == Dd::ZERO);
    graph.sources.extend([
        EffortSource {
            junction: translation,
            efforts: if still { vec![] } else { vec![weight] },
        },
        EffortSource {
            junction: rotation,
            efforts: vec![],
        },
    ]);
}

/// Adds a body that is fixed on a link.
pub(super) fn add_fixed_body(graph: &mut BondGraph, frame: LinkFrame, inertial: Inertial) {
    let i = LinkId(graph.frames.len());
    graph.multibody.frames.push(frame);
    graph.multibody.inertials.push(inertial);
    add_link(graph, i, &inertial);
    let patterns = patterns(&graph.frames);
    add_transformers(graph, &patterns, i);
}

/// Pattern of a link frame's axes and origin in fixed axes.
#[derive(Clone, Copy)]
struct PosePattern {
    rotation: Mat3<Modulus>,
    origin: Vec3<Modulus>,
    /// The joint's axis; its own rotation does not change it.
    axis: Vec3<Modulus>,
}

fn patterns(frames: &[LinkFrame]) -> Vec<PosePattern> {
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
fn add_transformers(graph: &mut BondGraph, patterns: &[PosePattern], i: LinkId) {
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

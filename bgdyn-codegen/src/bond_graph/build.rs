//! Builds the bond graph of a checked mechanism.

use bgdyn_runtime::Dd;

use super::transformers::{add_transformers, patterns};
use super::{
    BondGraph, ClosedTree, Coordinate, Effort, EffortSource, Junction, LinkFrame, Multibody,
    PositionVariable, Released, Site, Store, StoreInertia,
};
use crate::mechanism::joint::{self, Column};
use crate::mechanism::{CoordinateId, Frame, Inertial, Link, LinkId, Mechanism, Motion, Pose};

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
        contacts: mechanism.contact_pairs().to_vec(),
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

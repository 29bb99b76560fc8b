//! Builds the bond graph of a checked mechanism.

use bgdyn_runtime::Dd;

use super::pattern::{Coordinates, Modulus};
use super::{
    BondGraph, Coordinate, Effort, EffortSource, Junction, JunctionId, LinkFrame, Multibody, Site,
    Store, StoreInertia, Transformer,
};
use crate::math::{Mat3, Vec3, rodrigues};
use crate::mechanism::{CoordinateId, Frame, Link, LinkId, Mechanism, Motion, Pose, Value};

/// Builds the bond graph of a mechanism.
pub fn build(mechanism: &Mechanism) -> BondGraph {
    let links = mechanism.links();
    let mut graph = BondGraph {
        multibody: Multibody {
            coordinates: coordinates(mechanism),
            frames: links.iter().map(frame).collect(),
            inertials: links.iter().map(|link| link.inertial).collect(),
            gravity: mechanism.gravity(),
            rotors: Vec::new(),
            velocity_products: true,
            parameters: mechanism.parameters().to_vec(),
            sites: sites(mechanism),
        },
        junctions: Vec::new(),
        stores: Vec::new(),
        sources: Vec::new(),
        transformers: Vec::new(),
    };
    graph.junctions = (0..mechanism.nv())
        .map(|j| Junction::Velocity(CoordinateId(j)))
        .collect();
    for (i, link) in mechanism.links().iter().enumerate() {
        add_link(&mut graph, LinkId(i), link);
    }
    let places = places(&graph.frames);
    for i in 0..graph.frames.len() {
        add_transformers(&mut graph, &places, LinkId(i));
    }
    graph
}

/// Returns the frames of the links, then the named frames. A tip is a link without children.
fn sites(mechanism: &Mechanism) -> Vec<Site> {
    let links = mechanism.links();
    let tip = |i: usize| links.iter().all(|l| l.parent != Some(LinkId(i)));
    let link = |(i, link): (usize, &Link)| Site {
        name: link.name.clone(),
        link: Some(LinkId(i)),
        place: Pose::IDENTITY,
        prominent: tip(i),
    };
    let frame = |frame: &Frame| Site {
        name: frame.name.clone(),
        link: frame.link,
        place: frame.origin,
        prominent: true,
    };
    let named = mechanism.frames().iter().map(frame);
    links.iter().enumerate().map(link).chain(named).collect()
}

fn coordinates(mechanism: &Mechanism) -> Vec<Coordinate> {
    let coordinate = |&link: &LinkId| {
        let joint = &mechanism.links()[link.0].joint;
        Coordinate {
            name: joint.name.clone(),
            link,
            motion: joint.kind.motion,
        }
    };
    mechanism.coordinates().iter().map(coordinate).collect()
}

fn frame(link: &Link) -> LinkFrame {
    LinkFrame {
        name: link.name.clone(),
        parent: link.parent,
        origin: link.joint.origin,
        motion: link.joint.kind.motion,
        axis: link.joint.axis,
        coordinate: link.joint.coordinate,
        com: link.inertial.com,
        tensor_axes: link.inertial.inertia.axes,
    }
}

/// Adds the two junctions of a link, each with a store and a source.
fn add_link(graph: &mut BondGraph, i: LinkId, link: &Link) {
    let (translation, rotation) = (graph.translation(i), graph.rotation(i));
    graph
        .junctions
        .extend([Junction::Translation(i), Junction::Rotation(i)]);
    let mass = link.inertial.mass;
    graph.stores.extend([
        Store {
            junction: translation,
            inertia: StoreInertia::Mass(mass),
        },
        Store {
            junction: rotation,
            inertia: StoreInertia::Tensor(link.inertial.inertia.entries),
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

/// Pattern of a link frame's axes and origin in fixed axes.
#[derive(Clone, Copy)]
struct PosePattern {
    rotation: Mat3<Modulus>,
    origin: Vec3<Modulus>,
    axis: Vec3<Modulus>,
}

fn places(frames: &[LinkFrame]) -> Vec<PosePattern> {
    let mut places: Vec<PosePattern> = Vec::with_capacity(frames.len());
    for frame in frames {
        let parent = frame.parent.map(|p| places[p.0]);
        places.push(place(frame, parent));
    }
    places
}

fn place(frame: &LinkFrame, parent: Option<PosePattern>) -> PosePattern {
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
    if let Some(j) = frame.coordinate {
        let varying = Modulus::Varying(Coordinates::one(j));
        match frame.motion {
            Motion::Rotation => {
                let turn = rodrigues(frame.axis, (varying, varying), Modulus::constant);
                rotation = rotation * turn;
            }
            Motion::Translation => origin = origin + axis.scale(varying),
            Motion::None => {}
        }
    }
    PosePattern {
        rotation,
        origin,
        axis,
    }
}

/// Adds the transformers ρ_j^i and ∂r_i/∂q_j for every coordinate on the path from the base to link i.
fn add_transformers(graph: &mut BondGraph, places: &[PosePattern], i: LinkId) {
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
    for l in path.into_iter().rev() {
        let Some(j) = graph.frames[l.0].coordinate else {
            continue;
        };
        let axis = places[l.0].axis;
        let linear = match graph.frames[l.0].motion {
            Motion::None => continue,
            Motion::Translation => axis,
            Motion::Rotation => {
                add(graph, j, graph.rotation(i), axis);
                axis.cross(lever(&graph.frames, places, l, i, com))
            }
        };
        add(graph, j, graph.translation(i), linear);
    }
}

/// Returns the pattern of r_i − o_l: from the origin of link l, on the path, to the centre of mass of link
/// i. The sum runs over the links between them, so that common terms never enter.
fn lever(
    frames: &[LinkFrame],
    places: &[PosePattern],
    l: LinkId,
    i: LinkId,
    com: Vec3<Modulus>,
) -> Vec3<Modulus> {
    let mut lever = places[i.0].rotation * com;
    let mut link = i;
    while link != l {
        let Some(parent) = frames[link.0].parent else {
            break;
        };
        let step = frames[link.0].origin.translation.map(Modulus::constant);
        lever = lever + places[parent.0].rotation * step;
        if let (Motion::Translation, Some(j)) = (frames[link.0].motion, frames[link.0].coordinate) {
            let varying = Modulus::Varying(Coordinates::one(j));
            lever = lever + places[link.0].axis.scale(varying);
        }
        link = parent;
    }
    lever
}

fn add(graph: &mut BondGraph, from: CoordinateId, to: JunctionId, modulus: Vec3<Modulus>) {
    if modulus.0.iter().any(|m| !m.is_zero()) {
        let from = graph.velocity(from);
        graph.transformers.push(Transformer { from, to, modulus });
    }
}

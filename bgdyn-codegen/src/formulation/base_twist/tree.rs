//! The open tree on its base: the first link that can move in every way.
//!
//! The joints from the world to the base are replaced by one free joint. Its velocities are the twist of the base in
//! its own axes: in these the inertia of the tree does not depend on where the base is. A wheel that is a body of
//! revolution about the axis of its joint turns as a rotor: the link that carries it has its mass and inertia at any
//! angle, and a unit rate has the momentum C n about its axle n.

use bgdyn_runtime::Dd;

use super::axes::{Base, link_axes, snap};
use crate::bond_graph::{ClosedTree, Gyrostat, LinkFrame, Multibody, Rotor};
use crate::math::{Mat3, Vec3};
use crate::mechanism::closure::{ChainStep, LoopChain};
use crate::mechanism::joint::{Column, floating};
use crate::mechanism::{CoordinateId, Degrees, Inertial, LinkId, Motion, Pose, PositionId, Value};

const ZERO: Value = Value::Fixed(Dd::ZERO);

/// Relative to the inertia of a wheel, what differs from that of a body of revolution by rounding alone.
const ROUNDING: f64 = 1e-24;

/// The open tree of a mechanism with contacts, on a free base.
pub(super) struct BaseTree {
    /// The bodies; its base has no gravity, and seven positions that no function reads.
    pub multibody: Multibody,
    /// The links from the world to the base, which is the last one.
    pub path: Vec<LinkId>,
    /// The velocities of the tree that are those of the base along its axes, and about them.
    pub linear: [CoordinateId; 3],
    /// Those about them.
    pub angular: [CoordinateId; 3],
    /// The rotations among the joints that the free one replaces; none if the base has a floating joint.
    pub turns: Vec<CoordinateId>,
    /// Pose of the new axes of each link in its old ones.
    pub axes: Vec<Pose>,
}

impl BaseTree {
    /// Returns the tree on its base; `None` if no link can move in every way before one with inertia.
    pub fn new(closed: &ClosedTree) -> Option<Self> {
        let graph = &closed.tree.multibody;
        let path = path_to_base(graph)?;
        let base = *path.last()?;
        let merged = path.len() > 1;
        let (linear, angular) = velocities(graph, &path)?;
        let places: Vec<(LinkId, Vec3<Dd>)> = (closed.closure.loops.iter())
            .filter_map(|one| Some((one.chain.steps.first()?.link, one.chain.start.translation)))
            .collect();
        let axes = link_axes(
            graph,
            &Base {
                link: base,
                free: merged,
                places: &places,
            },
        );
        let mut tree = BaseTree {
            multibody: graph.clone(),
            turns: if merged { angular.to_vec() } else { Vec::new() },
            path,
            linear,
            angular,
            axes,
        };
        tree.multibody.gravity = Vec3([Dd::ZERO; 3]);
        tree.set_frames(graph);
        tree.set_bodies(graph);
        Some(tree)
    }

    /// Returns the base.
    pub fn base(&self) -> LinkId {
        self.path[self.path.len() - 1]
    }

    /// Returns the number of positions before those of the free joint.
    pub fn first_position(&self) -> usize {
        self.multibody.positions.len()
    }

    /// Returns the step from a link that the base carries to its parent, in the new axes.
    pub fn step(&self, link: LinkId) -> ChainStep {
        let frame = &self.multibody.frames[link.0];
        step(link, frame, None)
    }

    /// Returns the joints from the base to the world: their poses, and as velocities those of the base or of the
    /// replaced joints.
    pub fn to_world(&self, graph: &Multibody, of_base: bool) -> LoopChain {
        let (zero, one) = (Vec3([Dd::ZERO; 3]), Pose::IDENTITY.rotation);
        let along = (0..3).map(|k| (self.linear[k], column(zero, one.column(k))));
        let about = (0..3).map(|k| (self.angular[k], column(one.column(k), zero)));
        let own = match of_base {
            true => along.chain(about).collect(),
            false => Vec::new(),
        };
        let fixed = LinkFrame {
            origin: self.axes[self.base().0],
            motion: Motion::None,
            degrees: Degrees::default(),
            ..graph.frames[self.base().0].clone()
        };
        let first = step(self.base(), &fixed, Some(own));
        let none = || of_base.then(Vec::new);
        let inward = self.path.iter().rev();
        let steps = inward.map(|&link| step(link, &graph.frames[link.0], none()));
        LoopChain {
            start: Pose::IDENTITY,
            steps: std::iter::once(first).chain(steps).collect(),
            end: Pose::IDENTITY,
        }
    }

    fn set_frames(&mut self, graph: &Multibody) {
        let base = self.base();
        let first = self.first_position();
        for (i, frame) in self.multibody.frames.iter_mut().enumerate() {
            let own = LinkId(i) == base;
            let replaced = self.path.contains(&LinkId(i)) && !own;
            if replaced || own {
                frame.parent = None;
                frame.origin = Pose::IDENTITY;
                frame.coordinate = None;
                frame.degrees = Degrees::default();
                frame.motion = Motion::None;
            }
            if own {
                frame.motion = floating().motion;
                let velocities = self.linear.into_iter().chain(self.angular);
                frame.degrees.velocities = velocities.collect();
                frame.degrees.positions = (first..first + 7).map(PositionId).collect();
            } else if let (false, Some(parent)) = (replaced, graph.frames[i].parent) {
                let origin = self.axes[parent.0].inverse().of(frame.origin);
                frame.origin = tidy(origin.of(self.axes[i]));
                frame.axis = (self.axes[i].rotation.transpose() * frame.axis).map(snap);
            }
        }
    }

    /// Adds each link with inertia as a body without joint, in its old axes.
    fn set_bodies(&mut self, graph: &Multibody) {
        let mut body_of: Vec<Option<LinkId>> = vec![None; graph.frames.len()];
        for (i, frame) in graph.frames.iter().enumerate() {
            let link = LinkId(i);
            let inertial = graph.inertial(link);
            self.multibody.inertials[i] = massless(inertial);
            let carries = graph.rotors.iter().filter_map(|r| r.carrier.as_ref());
            let carries = carries.filter(|carrier| carrier.link == link).count() > 0;
            if !has_inertia(&inertial) && !carries {
                continue;
            }
            let wheel = spin_inertia(graph, link).filter(|_| link != self.base() && !carries);
            let (parent, origin) = match (wheel, frame.parent) {
                (Some(_), Some(p)) => (p, self.axes[p.0].inverse().of(frame.origin)),
                _ => (link, self.axes[i].inverse()),
            };
            let body = LinkId(self.multibody.frames.len());
            body_of[i] = Some(body);
            self.multibody.frames.push(LinkFrame {
                parent: Some(parent),
                origin: tidy(origin),
                motion: Motion::None,
                coordinate: None,
                degrees: Degrees::default(),
                hidden: true,
                ..frame.clone()
            });
            self.multibody.inertials.push(inertial);
            if let (Some(inertia), Some(coordinate)) = (wheel, frame.coordinate) {
                self.multibody.rotors.push(Rotor {
                    coordinate,
                    inertia: Value::Fixed(inertia),
                    ratio: Value::Fixed(Dd::ONE),
                    carrier: Some(Gyrostat {
                        link: body,
                        axis: frame.axis,
                    }),
                });
            }
        }
        let old = graph.rotors.len();
        for carrier in self.multibody.rotors[..old].iter_mut() {
            if let Some(carrier) = &mut carrier.carrier {
                carrier.link = body_of[carrier.link.0].unwrap_or(carrier.link);
            }
        }
    }
}

/// Returns the links from the world to the first one that can move in every way.
fn path_to_base(graph: &Multibody) -> Option<Vec<LinkId>> {
    let children = |parent: Option<LinkId>| {
        let all = graph.frames.iter().enumerate();
        let all = all.filter(move |(_, frame)| frame.parent == parent);
        all.map(|(i, _)| LinkId(i)).collect::<Vec<_>>()
    };
    let (mut path, mut count) = (Vec::new(), 0);
    let mut next = children(None);
    while let [link] = next[..] {
        let frame = &graph.frames[link.0];
        let degrees = &frame.degrees;
        let own = &degrees.velocities;
        if degrees.coupling.is_some() || !degrees.dependent.is_empty() || frame.motion.is_given() {
            return None;
        }
        if (graph.rotors.iter()).any(|rotor| own.contains(&rotor.coordinate)) {
            return None;
        }
        count += own.len();
        path.push(link);
        if count >= 6 {
            return (count == 6 && graph.base.is_none()).then_some(path);
        }
        if has_inertia(&graph.inertial(link)) {
            return None;
        }
        next = children(Some(link));
    }
    None
}

/// Returns the translations and the rotations among the velocities of joints in series, three each.
fn velocities(
    graph: &Multibody,
    path: &[LinkId],
) -> Option<([CoordinateId; 3], [CoordinateId; 3])> {
    let (mut linear, mut angular) = (Vec::new(), Vec::new());
    for (j, column) in path.iter().flat_map(|l| graph.frames[l.0].columns()) {
        let zero = |v: Vec3<Dd>| v.0.iter().all(|x| *x == Dd::ZERO);
        match (zero(column.linear), zero(column.angular)) {
            (false, true) => linear.push(j),
            (true, false) => angular.push(j),
            _ => return None,
        }
    }
    Some((linear.try_into().ok()?, angular.try_into().ok()?))
}

fn column(angular: Vec3<Dd>, linear: Vec3<Dd>) -> Column<Dd> {
    Column { angular, linear }
}

fn step(
    link: LinkId,
    frame: &LinkFrame,
    columns: Option<Vec<(CoordinateId, Column<Dd>)>>,
) -> ChainStep {
    ChainStep {
        link,
        outward: false,
        origin: frame.origin,
        motion: frame.motion,
        axis: frame.axis,
        degrees: frame.degrees.clone(),
        columns,
    }
}

/// Returns a pose without rounding errors of zeros and ones.
pub(super) fn tidy(pose: Pose) -> Pose {
    Pose {
        rotation: pose.rotation.map(snap),
        translation: pose.translation.map(snap),
    }
}

fn has_inertia(inertial: &Inertial) -> bool {
    inertial.mass != ZERO || inertial.inertia.entries != [ZERO; 6]
}

fn massless(mut inertial: Inertial) -> Inertial {
    inertial.mass = ZERO;
    inertial.com = Vec3([ZERO; 3]);
    inertial.inertia.entries = [ZERO; 6];
    inertial
}

/// Returns the moment of inertia about the axis of its joint of a link that is a body of revolution about it and
/// carries no other link.
fn spin_inertia(graph: &Multibody, link: LinkId) -> Option<Dd> {
    let frame = &graph.frames[link.0];
    let inertial = graph.inertial(link);
    let carries = graph.frames.iter().any(|other| other.parent == Some(link));
    let alone = frame.coordinate.is_some() && frame.degrees.coupling.is_none();
    if carries || !alone || frame.motion != Motion::Rotation || inertial.varies() {
        return None;
    }
    let number = |value: Value| match value {
        Value::Fixed(x) => x,
        Value::Parameter(_) => Dd::ZERO,
    };
    let [xx, yy, zz, xy, xz, yz] = inertial.inertia.entries.map(number);
    let own = Mat3([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]);
    let axes = inertial.inertia.axes;
    let tensor = axes * own * axes.transpose();
    let (axis, com) = (frame.axis, inertial.com.map(number));
    let spin = axis.dot(tensor * axis);
    let across = (xx + yy + zz - spin) * Dd::from_f64(0.5);
    let round = Mat3::from_fn(|i, j| {
        let one = if i == j { across } else { Dd::ZERO };
        one + (spin - across) * axis.0[i] * axis.0[j]
    });
    let differs = |x: Dd, size: Dd| x.to_f64().abs() > ROUNDING * size.to_f64().abs();
    let off = (tensor - round).0;
    let arm = com.cross(axis);
    let radius = frame.origin.translation.dot(frame.origin.translation) + Dd::ONE;
    let is_round = off.iter().flatten().all(|&x| !differs(x, xx + yy + zz));
    let centred = arm.0.iter().all(|&x| !differs(x, radius));
    (is_round && centred).then_some(spin)
}

//! The open tree on a free base: a link that moves along three axes, with no inertia before it.
//!
//! The joints from the world to the base are replaced by one free joint. Its velocities are the twist of the base in
//! its own axes: in these the inertia of the tree does not depend on where the base is, and gravity alone depends on
//! its direction; it is left out. The axes of the links are along those of joints ([`axes`]).

mod axes;

pub use axes::snap;
use axes::{Base, link_axes};
use bgdyn_runtime::Dd;

use super::build::connected;
use super::{BondGraph, ClosedTree, Coordinate, LinkFrame, Multibody, PositionVariable};
use crate::math::{Mat3, Vec3, angle_of};
use crate::mechanism::closure::{ChainStep, LoopChain};
use crate::mechanism::joint::{Column, floating};
use crate::mechanism::{CoordinateId, Degrees, Inertial, LinkId, Motion, Pose, PositionId, Value};

/// Components of a unit vector deviate by less by rounding.
const ROUNDING: f64 = 1e-24;

const ZERO: Value = Value::Fixed(Dd::ZERO);

/// The open tree of a mechanism with contacts, on a free base.
#[derive(Clone, Debug)]
pub struct FreeBase {
    /// Its graph, without gravity. The free joint has seven positions after those of the tree, which no function reads.
    pub graph: BondGraph,
    /// The links from the world to the base, which is the last one.
    pub path: Vec<LinkId>,
    /// The velocities of the tree that are those of the base along its axes, and about them.
    pub linear: [CoordinateId; 3],
    /// Those about them.
    pub angular: [CoordinateId; 3],
    /// The rotations among the joints that the free one replaces, three at most; none if the base has a floating joint.
    pub turns: Vec<CoordinateId>,
    /// Pose of the new axes of each link in its old ones.
    pub axes: Vec<Pose>,
}

impl FreeBase {
    /// Returns the tree on each link that can be the base; none if no link moves along three axes before one with
    /// inertia.
    pub fn all(closed: &ClosedTree) -> Vec<Self> {
        let graph = &closed.tree.multibody;
        let paths = paths_to_bases(graph).into_iter();
        paths.filter_map(|path| Self::on(closed, path)).collect()
    }

    fn on(closed: &ClosedTree, path: Vec<LinkId>) -> Option<Self> {
        let graph = &closed.tree.multibody;
        let base = *path.last()?;
        let merged = path.len() > 1;
        let (linear, turns) = velocities(graph, &path)?;
        let first = graph.coordinates.len();
        let further = (first..).map(CoordinateId);
        let angular: Vec<CoordinateId> = turns.iter().copied().chain(further).take(3).collect();
        let angular = [angular[0], angular[1], angular[2]];
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
        let made = FreeTree {
            graph,
            path: &path,
            velocities: (linear, angular),
            axes: &axes,
        };
        Some(FreeBase {
            graph: connected(made.multibody()),
            turns: if merged { turns } else { Vec::new() },
            path,
            linear,
            angular,
            axes,
        })
    }

    /// Returns the base.
    pub fn base(&self) -> LinkId {
        self.path[self.path.len() - 1]
    }

    /// Returns the step from a link that the base carries to its parent, in the new axes.
    pub fn step(&self, link: LinkId) -> ChainStep {
        let frame = &self.graph.frames[link.0];
        let mut step = step(link, frame, None);
        let phase = turned_about(frame.origin.rotation, frame.axis);
        if let (Some(phase), Motion::Rotation) = (phase, frame.motion) {
            step.origin.rotation = Pose::IDENTITY.rotation;
            step.phase = phase;
        }
        step
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
        let none = || of_base.then(Vec::new);
        let inward = self.path.iter().rev();
        let steps = inward.map(|&link| step(link, &graph.frames[link.0], none()));
        let mut steps: Vec<ChainStep> = steps.collect();
        let (new, base) = (self.axes[self.base().0], &graph.frames[self.base().0]);
        match turned_about(new.rotation, base.axis) {
            // About the joint's axis: a constant part of its angle.
            Some(phase) if base.motion == Motion::Rotation && new.translation == zero => {
                steps[0].phase = phase;
                steps[0].columns = of_base.then_some(own);
            }
            _ => {
                let fixed = LinkFrame {
                    origin: new,
                    motion: Motion::None,
                    degrees: Degrees::default(),
                    ..base.clone()
                };
                steps.insert(0, step(self.base(), &fixed, Some(own)));
            }
        }
        LoopChain {
            start: Pose::IDENTITY,
            steps,
            end: Pose::IDENTITY,
        }
    }
}

/// What the tree on a free base is made of.
struct FreeTree<'a> {
    /// The open tree.
    graph: &'a Multibody,
    path: &'a [LinkId],
    velocities: ([CoordinateId; 3], [CoordinateId; 3]),
    axes: &'a [Pose],
}

impl FreeTree<'_> {
    fn multibody(&self) -> Multibody {
        let mut made = self.graph.clone();
        made.gravity = Vec3([Dd::ZERO; 3]);
        self.set_frames(&mut made);
        self.set_joint(&mut made);
        self.set_bodies(&mut made);
        made
    }

    fn base(&self) -> LinkId {
        self.path[self.path.len() - 1]
    }

    /// Sets the frames of the links in their new axes.
    fn set_frames(&self, made: &mut Multibody) {
        for (i, frame) in made.frames.iter_mut().enumerate() {
            let replaced = self.path.contains(&LinkId(i));
            if let (false, Some(parent)) = (replaced, frame.parent) {
                let origin = self.axes[parent.0].inverse().of(frame.origin);
                frame.origin = tidy(origin.of(self.axes[i]));
                frame.axis = (self.axes[i].rotation.transpose() * frame.axis).map(snap);
            } else if replaced {
                frame.parent = None;
                frame.origin = Pose::IDENTITY;
                frame.coordinate = None;
                frame.degrees = Degrees::default();
                frame.motion = Motion::None;
            }
        }
    }

    /// Sets the free joint.
    fn set_joint(&self, made: &mut Multibody) {
        let (linear, angular) = self.velocities;
        let (base, motion) = (self.base(), floating().motion);
        let first = made.positions.len();
        for k in 0..7 {
            made.positions.push(PositionVariable {
                name: format!("base_{k}"),
                link: base,
                unit: if k < 3 { "m" } else { "" },
                coordinate: None,
            });
        }
        let frame = &mut made.frames[base.0];
        frame.motion = motion;
        frame.degrees.velocities = linear.into_iter().chain(angular).collect();
        frame.degrees.positions = (first..first + 7).map(PositionId).collect();
        for j in linear.into_iter().chain(angular) {
            // One more if fewer than six velocities are replaced.
            if j.0 == made.coordinates.len() {
                made.coordinates.push(Coordinate {
                    name: format!("base_turn_{}", j.0),
                    ..made.coordinates[linear[0].0].clone()
                });
            }
            let coordinate = &mut made.coordinates[j.0];
            coordinate.link = base;
            coordinate.motion = motion;
            coordinate.linear = linear.contains(&j);
        }
    }

    /// Adds each link with inertia as a body without joint, in its old axes.
    fn set_bodies(&self, made: &mut Multibody) {
        let graph = self.graph;
        for (i, frame) in graph.frames.iter().enumerate() {
            let link = LinkId(i);
            let inertial = graph.inertial(link);
            made.inertials[i] = massless(inertial);
            let carriers = made.rotors.iter_mut().filter_map(|r| r.carrier.as_mut());
            let mut carriers = carriers.filter(|carrier| carrier.link == link).peekable();
            if !has_inertia(&inertial) && carriers.peek().is_none() {
                continue;
            }
            let body = LinkId(made.frames.len());
            carriers.for_each(|carrier| carrier.link = body);
            made.frames.push(LinkFrame {
                parent: Some(link),
                origin: tidy(self.axes[i].inverse()),
                motion: Motion::None,
                coordinate: None,
                degrees: Degrees::default(),
                hidden: true,
                ..frame.clone()
            });
            made.inertials.push(inertial);
        }
    }
}

/// Returns the links from the world to each one that moves along three axes, without inertia before it.
fn paths_to_bases(graph: &Multibody) -> Vec<Vec<LinkId>> {
    let children = |parent: Option<LinkId>| {
        let all = graph.frames.iter().enumerate();
        let all = all.filter(move |(_, frame)| frame.parent == parent);
        all.map(|(i, _)| LinkId(i)).collect::<Vec<_>>()
    };
    let (mut paths, mut path) = (Vec::new(), Vec::new());
    let mut next = children(None);
    while let ([link], None) = (&next[..], graph.base) {
        let link = *link;
        let frame = &graph.frames[link.0];
        let degrees = &frame.degrees;
        let rotor = |j: &CoordinateId| graph.rotors.iter().any(|rotor| rotor.coordinate == *j);
        let own = degrees.coupling.is_none() && degrees.dependent.is_empty();
        if !own || frame.motion.is_given() || degrees.velocities.iter().any(rotor) {
            break;
        }
        path.push(link);
        match velocities(graph, &path) {
            Some(_) => paths.push(path.clone()),
            None if !paths.is_empty() => break,
            None => {}
        }
        if has_inertia(&graph.inertial(link)) {
            break;
        }
        next = children(Some(link));
    }
    paths
}

/// Returns three translations and at most three rotations, the velocities of joints in series; `None` if they have
/// others.
fn velocities(
    graph: &Multibody,
    path: &[LinkId],
) -> Option<([CoordinateId; 3], Vec<CoordinateId>)> {
    let (mut linear, mut angular) = (Vec::new(), Vec::new());
    for (j, column) in path.iter().flat_map(|l| graph.frames[l.0].columns()) {
        let zero = |v: Vec3<Dd>| v.0.iter().all(|x| *x == Dd::ZERO);
        match (zero(column.linear), zero(column.angular)) {
            (false, true) => linear.push(j),
            (true, false) => angular.push(j),
            _ => return None,
        }
    }
    Some((linear.try_into().ok()?, angular)).filter(|(_, turns)| turns.len() <= 3)
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
        phase: Dd::ZERO,
        columns,
    }
}

/// Returns the angle of a rotation about an axis; `None` of one about another axis.
fn turned_about(rotation: Mat3<Dd>, axis: Vec3<Dd>) -> Option<Dd> {
    let off = rotation * axis - axis;
    if off.dot(off).to_f64() > ROUNDING * ROUNDING {
        return None;
    }
    let unit = |k: usize| {
        Vec3(std::array::from_fn(|i| {
            Dd::from_f64(f64::from(u8::from(i == k)))
        }))
    };
    let size = |k: &usize| axis.0[*k].to_f64().abs();
    let least = (0..3).min_by(|a, b| size(a).total_cmp(&size(b)))?;
    let across = axis.cross(unit(least));
    let turned = rotation * across;
    let (cos, sin) = (across.dot(turned), axis.dot(across.cross(turned)));
    Some(angle_of((cos, sin)))
}

/// Returns a pose without rounding errors of zeros and ones.
pub fn tidy(pose: Pose) -> Pose {
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

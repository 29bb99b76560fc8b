//! The chain of a planar loop, and the arcs between its unknown joints.

use bgdyn_runtime::Dd;

use super::shape::{AngleTerm, PlaneJoint, PolygonSide, TurnedVector};
use super::vectors::PlaneVector;
use crate::math::Vec3;
use crate::mechanism::Motion;
use crate::mechanism::closure::KinematicLoop;
use crate::mechanism::joint::DoubleDouble;

/// The largest component along the loop's axis of a direction in its plane.
const IN_PLANE: f64 = 1e-26;

/// The motion of a step along the chain of a planar loop.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum ChainMotion {
    Fixed,
    Turn(AngleTerm),
    Slide(PlaneJoint, PlaneVector),
}

impl ChainMotion {
    pub(super) fn joint(&self) -> Option<PlaneJoint> {
        match self {
            ChainMotion::Fixed => None,
            ChainMotion::Turn(term) => Some(term.joint),
            ChainMotion::Slide(joint, _) => Some(*joint),
        }
    }
}

/// The chain of a loop in its plane, with all joints at zero.
pub(super) struct PlaneChain {
    pub(super) steps: Vec<ChainMotion>,
    outward: Vec<bool>,
    /// From place a to the first link's origin, then from link to link, then to place b.
    segments: Vec<PlaneVector>,
    /// The index of the link that carries the loop.
    pub(super) root: usize,
}

/// An arc of the polygon.
#[derive(Clone, Default)]
pub(super) struct Arc {
    pub(super) sides: Vec<PolygonSide>,
    /// The first of its links, counted along the chain.
    pub(super) link: usize,
}

impl PlaneChain {
    pub(super) fn new(one: &KinematicLoop, positions: usize) -> Option<Self> {
        let chain = &one.chain;
        let frames = chain.frames(&vec![Dd::ZERO; positions], &DoubleDouble);
        let axis_of = |k: usize| {
            let step = &chain.steps[k];
            frames.link(if step.outward { k + 1 } else { k }).0 * step.axis
        };
        let turns = |k: &usize| chain.steps[*k].motion == Motion::Rotation;
        let normal = axis_of((0..chain.steps.len()).find(turns)?);
        let slide = |k: &usize| chain.steps[*k].motion == Motion::Translation;
        let along = (0..chain.steps.len()).find(slide).map(axis_of);
        let plane = plane_axes(normal, along)?;
        let flat = |v: Vec3<Dd>| plane.map(|axis| axis.dot(v));
        let step = |k: usize| -> Option<ChainMotion> {
            let step = &chain.steps[k];
            let axis = axis_of(k);
            let across = axis.dot(normal);
            if step.motion == Motion::None {
                return Some(ChainMotion::Fixed);
            }
            let (&[position], &[velocity], None) = (
                &step.degrees.positions[..],
                &step.degrees.velocities[..],
                &step.degrees.coupling,
            ) else {
                return None;
            };
            let joint = PlaneJoint { position, velocity };
            let is = |x: Dd, y: f64| (x - Dd::from_f64(y)).to_f64().abs() <= IN_PLANE;
            let opposite = across < Dd::ZERO;
            match step.motion {
                Motion::Rotation if is(across.abs(), 1.0) => {
                    Some(ChainMotion::Turn(AngleTerm { joint, opposite }))
                }
                Motion::Translation if is(across, 0.0) => {
                    let axis = if step.outward { axis } else { -axis };
                    Some(ChainMotion::Slide(joint, flat(axis)))
                }
                _ => None,
            }
        };
        let steps: Option<Vec<ChainMotion>> = (0..chain.steps.len()).map(step).collect();
        let outward: Vec<bool> = chain.steps.iter().map(|step| step.outward).collect();
        let mut at: Vec<Vec3<Dd>> = (0..=chain.steps.len()).map(|k| frames.link(k).1).collect();
        at.insert(0, Vec3([Dd::ZERO; 3]));
        at.push(frames.end());
        let segments = at.windows(2).map(|pair| flat(pair[1] - pair[0]));
        let root = outward.iter().take_while(|out| !**out).count();
        let turns_once = outward[root..].iter().all(|out| *out);
        turns_once.then_some(PlaneChain {
            steps: steps?,
            segments: segments.collect(),
            outward,
            root,
        })
    }

    /// Returns the angle of a link: the sum of the rotations between it and the link that carries the loop.
    pub(super) fn angle(&self, link: usize) -> Vec<AngleTerm> {
        let between = link.min(self.root)..link.max(self.root);
        let turn = |step: &ChainMotion| match step {
            ChainMotion::Turn(term) => Some(*term),
            _ => None,
        };
        self.steps[between].iter().filter_map(turn).collect()
    }

    /// Returns the arcs between place a, the two unknown joints, and place b.
    pub(super) fn arcs(&self, unknown: [usize; 2]) -> [Arc; 3] {
        let mut arcs: [Arc; 3] = Default::default();
        let mut at = 0;
        let side = |link: usize, vector: PlaneVector, slide: Option<PlaneJoint>| PolygonSide {
            turned: TurnedVector {
                angle: self.angle(link),
                vector,
            },
            slide,
        };
        arcs[0].sides.push(side(0, self.segments[0], None));
        for (k, step) in self.steps.iter().enumerate() {
            let link = if self.outward[k] { k } else { k + 1 };
            let own = side(link, self.segments[k + 1], None);
            let ends = unknown.contains(&k);
            if ends && !self.outward[k] {
                at += 1;
                arcs[at].link = k + 1;
            }
            arcs[at].sides.push(own);
            if let (ChainMotion::Slide(joint, direction), false) = (step, ends) {
                arcs[at].sides.push(side(link, *direction, Some(*joint)));
            }
            if ends && self.outward[k] {
                at += 1;
                arcs[at].link = k + 1;
            }
        }
        let last = self.steps.len();
        arcs[2]
            .sides
            .push(side(last, self.segments[last + 1], None));
        arcs
    }
}

/// Returns two axes of the plane; the first one is `along`, if there is a slide.
fn plane_axes(normal: Vec3<Dd>, along: Option<Vec3<Dd>>) -> Option<[Vec3<Dd>; 2]> {
    let units = (0..3).map(|k| {
        Vec3(std::array::from_fn(|i| {
            Dd::from_f64(f64::from(u8::from(i == k)))
        }))
    });
    let across = |v: Vec3<Dd>| v - normal.scale(v.dot(normal));
    let size = |v: &Vec3<Dd>| v.dot(*v).to_f64();
    let other = units.map(across).find(|v| size(v) > 0.3)?;
    let first = along.unwrap_or(other);
    let first = first.scale(Dd::ONE / first.dot(first).sqrt());
    Some([first, normal.cross(first)])
}

//! Planar loops whose dependent joints follow in closed form from the independent ones: polygons of three unknown
//! joints.
//!
//! The chain of a loop and its closing pin are a polygon. Two of its joints are dependent, the closing pin is the third
//! unknown one; they divide the polygon into three arcs. One arc contains the link that carries the loop, and all
//! independent joints: its vector D, from its first unknown joint S to its last one E, is known. The other two are
//! rigid:
//!
//! | unknown joints | form | equations |
//! |---|---|---|
//! | three pins | triangle | D, and two lengths a and b |
//! | two pins and a slide beside D | slider | a length, and a line on which its end moves |
//! | two pins and a slide opposite D | cylinder | the direction of D, and the length of D |
//!
//! Vectors are in the plane of the loop, with all joints at zero: joint angles turn them.

use bgdyn_runtime::Dd;

use super::{ClosingRow, Closure, KinematicLoop, RowKind};
use crate::math::Vec3;
use crate::mechanism::joint::DoubleDouble;
use crate::mechanism::{CoordinateId, Motion, PositionId};

/// The largest component along the loop's axis of a direction in its plane.
const IN_PLANE: f64 = 1e-26;

/// The least length of a rigid arc, m, and the least sine of an angle that tells the branch.
const LEAST: f64 = 1e-9;

/// A vector in the plane of a loop: components along two axes that are perpendicular to each other.
pub type PlaneVector = [Dd; 2];

/// A joint with one position and one velocity, in the open tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlaneJoint {
    /// Its position.
    pub position: PositionId,
    /// Its velocity.
    pub velocity: CoordinateId,
}

/// A joint whose rotation is part of an angle, and whether it turns against the loop's axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AngleTerm {
    /// The joint.
    pub joint: PlaneJoint,
    /// Whether its axis is opposite to that of the loop.
    pub opposite: bool,
}

/// A vector fixed in a link.
#[derive(Clone, Debug, PartialEq)]
pub struct TurnedVector {
    /// The angle of the link relative to the link that carries the loop: the sum of these joints.
    pub angle: Vec<AngleTerm>,
    /// The vector where this angle is zero, m.
    pub vector: PlaneVector,
}

/// A part of the known arc: fixed in a link, or along a slide.
#[derive(Clone, Debug, PartialEq)]
pub struct PolygonSide {
    /// The vector, m; per unit displacement of the slide if there is one.
    pub turned: TurnedVector,
    /// The slide.
    pub slide: Option<PlaneJoint>,
}

/// The unknown joints of a polygon.
#[derive(Clone, Debug, PartialEq)]
pub enum PolygonForm {
    /// Three pins: D = first − second, with first from S and second from E to the third pin.
    Triangle {
        /// From S to the third pin.
        first: TurnedVector,
        /// From E to the third pin.
        second: TurnedVector,
        /// The joints of the open tree among the pins.
        pins: [PlaneJoint; 2],
    },
    /// Two pins and a slide beside the known arc: arm = D + x · along, with the known angle of `along`.
    Slider {
        /// The rigid link between the pins.
        arm: TurnedVector,
        /// The direction of the slide, a unit vector.
        along: TurnedVector,
        /// The pin of the open tree.
        pin: PlaneJoint,
        /// The slide, with the displacement x.
        slide: PlaneJoint,
    },
    /// A slide between two pins: D = (x + start) · along + across · along⊥, with the unknown angle of `along`.
    Cylinder {
        /// The direction of the slide, a unit vector.
        along: TurnedVector,
        /// Distance of the pins along the slide at displacement zero, m.
        start: Dd,
        /// Distance of the pins across the slide, m.
        across: Dd,
        /// The pin of the open tree.
        pin: PlaneJoint,
        /// The slide, with the displacement x.
        slide: PlaneJoint,
    },
}

/// A planar loop in closed form.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    /// The index of its loop.
    pub closes: usize,
    /// The vector D of the known arc.
    pub known: Vec<PolygonSide>,
    /// Its unknown joints.
    pub form: PolygonForm,
    /// Whether the root is positive: first × second of a triangle, arm · along of a slider, x + start of a cylinder.
    pub positive: bool,
}

impl Polygon {
    /// Returns the joints of the open tree that it determines.
    pub fn dependents(&self) -> [PlaneJoint; 2] {
        match self.form {
            PolygonForm::Triangle { pins, .. } => pins,
            PolygonForm::Slider { pin, slide, .. } | PolygonForm::Cylinder { pin, slide, .. } => {
                [pin, slide]
            }
        }
    }
}

/// Returns the loops of a mechanism as polygons, each after those that it depends on; `None` if a dependent velocity
/// does not follow from one.
pub fn polygons(closure: &Closure) -> Option<Vec<Polygon>> {
    if !closure.combined.is_empty() || !closure.compounds.is_empty() || closure.nonholonomic() {
        return None;
    }
    let mut unsolved: Vec<CoordinateId> = closure.dependents().collect();
    let mut found: Vec<Polygon> = Vec::new();
    while !unsolved.is_empty() {
        let open = (0..closure.loops.len()).filter(|l| found.iter().all(|one| one.closes != *l));
        let next = open
            .filter_map(|closes| polygon(closure, closes, &unsolved))
            .next()?;
        let solved = next.dependents().map(|joint| joint.velocity);
        unsolved.retain(|j| !solved.contains(j));
        found.push(next);
    }
    (!found.is_empty()).then_some(found)
}

/// The motion of a step along the chain of a planar loop.
#[derive(Clone, Copy, PartialEq)]
enum Step {
    Fixed,
    Turn(AngleTerm),
    Slide(PlaneJoint, PlaneVector),
}

impl Step {
    fn joint(&self) -> Option<PlaneJoint> {
        match self {
            Step::Fixed => None,
            Step::Turn(term) => Some(term.joint),
            Step::Slide(joint, _) => Some(*joint),
        }
    }
}

/// The chain of a loop in its plane, with all joints at zero.
struct PlaneChain {
    steps: Vec<Step>,
    outward: Vec<bool>,
    /// From place a to the first link's origin, then from link to link, then to place b.
    segments: Vec<PlaneVector>,
    /// The index of the link that carries the loop.
    root: usize,
}

/// An arc of the polygon.
#[derive(Clone, Default)]
struct Arc {
    sides: Vec<PolygonSide>,
    /// The first of its links, counted along the chain.
    link: usize,
}

impl PlaneChain {
    fn new(one: &KinematicLoop, positions: usize) -> Option<Self> {
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
        let step = |k: usize| -> Option<Step> {
            let step = &chain.steps[k];
            let axis = axis_of(k);
            let across = axis.dot(normal);
            if step.motion == Motion::None {
                return Some(Step::Fixed);
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
                    Some(Step::Turn(AngleTerm { joint, opposite }))
                }
                Motion::Translation if is(across, 0.0) => {
                    let axis = if step.outward { axis } else { -axis };
                    Some(Step::Slide(joint, flat(axis)))
                }
                _ => None,
            }
        };
        let steps: Option<Vec<Step>> = (0..chain.steps.len()).map(step).collect();
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
    fn angle(&self, link: usize) -> Vec<AngleTerm> {
        let between = link.min(self.root)..link.max(self.root);
        let turn = |step: &Step| match step {
            Step::Turn(term) => Some(*term),
            _ => None,
        };
        self.steps[between].iter().filter_map(turn).collect()
    }

    /// Returns the arcs between place a, the two unknown joints, and place b.
    fn arcs(&self, unknown: [usize; 2]) -> [Arc; 3] {
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
            if let (Step::Slide(joint, direction), false) = (step, ends) {
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

/// Returns a loop as a polygon if two of the `unsolved` velocities are its unknown joints.
fn polygon(closure: &Closure, closes: usize, unsolved: &[CoordinateId]) -> Option<Polygon> {
    let one = &closure.loops[closes];
    let rows = closure.rows.iter().filter(|row| row.closes == closes);
    let places = rows
        .clone()
        .all(|row| matches!(row.kind, RowKind::Closing(ClosingRow::Place(_))));
    if rows.count() != 2 || !places || one.contact.is_some() {
        return None;
    }
    let chain = PlaneChain::new(one, closure.start.len())?;
    let is_unsolved = |k: &usize| {
        chain.steps[*k]
            .joint()
            .is_some_and(|j| unsolved.contains(&j.velocity))
    };
    let unknown: Vec<usize> = (0..chain.steps.len()).filter(is_unsolved).collect();
    let &[i, j] = &unknown[..] else { return None };
    let arcs = chain.arcs([i, j]);
    let arc_of = |link: usize| usize::from(link > i) + usize::from(link > j);
    let known = arc_of(chain.root);
    let moves = |k: usize| chain.steps[k].joint().is_some() && k != i && k != j;
    if (0..chain.steps.len()).any(|k| moves(k) && arc_of(k) != known) {
        return None;
    }
    let sides = merged(&arcs[known].sides);
    let form = form(&chain, [i, j], (&arcs, known))?;
    let (known, form) = match form {
        Found::Whole(form) => (sides, form),
        Found::Slide { before, form, last } => {
            let mut sides = sides;
            sides.push(last);
            let sides = merged(&sides);
            (if before { opposite(&sides) } else { sides }, form)
        }
    };
    let polygon = Polygon {
        closes,
        known,
        form,
        positive: true,
    };
    let mut signs = closure
        .samples
        .iter()
        .chain([&closure.start])
        .map(|q| polygon.root_at(q));
    let first = polygon.root_at(&closure.start);
    let same = first.abs() > LEAST && signs.all(|x| x.abs() > LEAST && (x > 0.0) == (first > 0.0));
    same.then_some(Polygon {
        positive: first > 0.0,
        ..polygon
    })
}

/// The unknown joints; with a slide beside the known arc, before or after it, also the rigid arc that turns with it.
enum Found {
    Whole(PolygonForm),
    Slide {
        before: bool,
        form: PolygonForm,
        last: PolygonSide,
    },
}

/// Returns the form of the unknown joints: the steps i and j and the closing pin.
fn form(
    chain: &PlaneChain,
    [i, j]: [usize; 2],
    (arcs, known): (&[Arc; 3], usize),
) -> Option<Found> {
    let rigid = |arc: &Arc| TurnedVector {
        angle: chain.angle(arc.link),
        vector: (arc.sides.iter()).fold([Dd::ZERO; 2], |sum, side| plus(sum, side.turned.vector)),
    };
    let (next, last) = (rigid(&arcs[(known + 1) % 3]), rigid(&arcs[(known + 2) % 3]));
    let joints = [i, j].map(|k| chain.steps[k].joint());
    let [Some(first_joint), Some(second_joint)] = joints else {
        return None;
    };
    let slides = [i, j].map(|k| match chain.steps[k] {
        Step::Slide(joint, direction) => Some((joint, direction)),
        _ => None,
    });
    let long = |turned: &TurnedVector| length(turned.vector).to_f64() > LEAST;
    let (slide, direction, pin, at) = match slides {
        [None, None] => {
            let (first, second) = (last.negated(), next);
            let pins = [first_joint, second_joint];
            let form = PolygonForm::Triangle {
                first,
                second,
                pins,
            };
            let PolygonForm::Triangle { first, second, .. } = &form else {
                return None;
            };
            return (long(first) && long(second)).then_some(Found::Whole(form));
        }
        // The unknown joints in their order along the polygon: the closing pin, step i, step j.
        [Some((slide, direction)), None] => (slide, direction, second_joint, 1),
        [None, Some((slide, direction))] => (slide, direction, first_joint, 2),
        [Some(_), Some(_)] => return None,
    };
    let unit = direction.map(|x| x / length(direction));
    if at == (known + 2) % 3 {
        let whole = times(plus(next.vector, last.vector), conjugate(unit));
        let along = TurnedVector {
            angle: next.angle,
            vector: negated(unit),
        };
        let [start, across] = whole;
        return Some(Found::Whole(PolygonForm::Cylinder {
            along,
            start,
            across,
            pin,
            slide,
        }));
    }
    // A slide after the known arc: arm = D + (next + x · unit), one before it: arm = −(D + last + x · unit).
    let before = at == known;
    let (arm, turning) = if before {
        (next, last)
    } else {
        (last.negated(), next)
    };
    let along = TurnedVector {
        angle: turning.angle.clone(),
        vector: if before { negated(unit) } else { unit },
    };
    let last = PolygonSide {
        turned: turning,
        slide: None,
    };
    let found = Found::Slide {
        before,
        last,
        form: PolygonForm::Slider {
            arm: arm.clone(),
            along,
            pin,
            slide,
        },
    };
    long(&arm).then_some(found)
}

impl TurnedVector {
    fn negated(&self) -> Self {
        TurnedVector {
            angle: self.angle.clone(),
            vector: negated(self.vector),
        }
    }

    /// Returns the vector at a position of the open tree.
    fn at(&self, q: &[Dd]) -> PlaneVector {
        let sum = self.angle.iter().fold(Dd::ZERO, |sum, term| {
            let q = q[term.joint.position.0];
            if term.opposite { sum - q } else { sum + q }
        });
        let (sin, cos) = sum.sin_cos();
        times(self.vector, [cos, sin])
    }
}

impl Polygon {
    /// Returns a number with the sign of the root at a closed position.
    fn root_at(&self, q: &[Dd]) -> f64 {
        let root = match &self.form {
            PolygonForm::Triangle { first, second, .. } => {
                let ([x, y], [u, v]) = (first.at(q), second.at(q));
                (x * v - y * u) / (length(first.vector) * length(second.vector))
            }
            PolygonForm::Slider { arm, along, .. } => {
                let ([x, y], [u, v]) = (arm.at(q), along.at(q));
                (x * u + y * v) / length(arm.vector)
            }
            PolygonForm::Cylinder { start, slide, .. } => q[slide.position.0] + *start,
        };
        root.to_f64()
    }
}

/// Returns the sides with those of one angle added up; sides of length zero are left out.
fn merged(sides: &[PolygonSide]) -> Vec<PolygonSide> {
    let mut all: Vec<PolygonSide> = Vec::new();
    for side in sides {
        let same = |one: &&mut PolygonSide| {
            one.turned.angle == side.turned.angle && one.slide.is_none() && side.slide.is_none()
        };
        match all.iter_mut().find(same) {
            Some(one) => one.turned.vector = plus(one.turned.vector, side.turned.vector),
            None => all.push(side.clone()),
        }
    }
    all.retain(|side| length(side.turned.vector).to_f64() > 1e-24);
    all
}

fn opposite(sides: &[PolygonSide]) -> Vec<PolygonSide> {
    let turned = sides.iter().map(|side| PolygonSide {
        turned: side.turned.negated(),
        slide: side.slide,
    });
    turned.collect()
}

fn negated(v: PlaneVector) -> PlaneVector {
    v.map(|x| -x)
}

fn plus([x, y]: PlaneVector, [u, v]: PlaneVector) -> PlaneVector {
    [x + u, y + v]
}

fn length([x, y]: PlaneVector) -> Dd {
    (x * x + y * y).sqrt()
}

fn conjugate([x, y]: PlaneVector) -> PlaneVector {
    [x, -y]
}

/// Returns the product of complex numbers.
fn times([x, y]: PlaneVector, [u, v]: PlaneVector) -> PlaneVector {
    [x * u - y * v, x * v + y * u]
}

//! The sides of a planar loop whose joints are all revolute, and parallelograms among such loops.
//!
//! A link of the loop carries a vector w from one axis to the next, in the plane of the loop, and turns by an angle
//! φ = Σ ±q, relative to place a: Σ w e^{iφ} = 0. Vectors whose angles differ by a constant are one side. With four
//! sides, a + c = 0 and b + d = 0 is a factor of that equation if |a| = |c| and |b| = |d|: on this branch φ_a − φ_c and
//! φ_b − φ_d are constant. With two sides there is no other one.

use bgdyn_runtime::Dd;

use super::placed::{loop_axis, parallel, turn_to_axis};
use crate::math::{Mat3, Vec3, angle_of};
use crate::mechanism::closure::LoopChain;
use crate::mechanism::joint::DoubleDouble;
use crate::mechanism::{CoordinateId, Degrees, Leader, LinkId, Motion, PositionId};

/// Lengths that differ by less, relative to the length of the loop, are equal.
const EQUAL: f64 = 1e-20;

/// Components of a unit vector below this are rounding errors.
const ROUNDING: f64 = 1e-28;

/// A vector of the plane, m.
type Planar = [Dd; 2];

/// A side of a loop.
#[derive(Clone, Debug)]
pub(super) struct LoopSide {
    /// The joints whose positions add to its angle.
    pub(super) angle: Vec<Leader>,
    /// The side where these joints are at zero.
    vector: Planar,
    /// Its segments of the chain from place a to place b.
    pub(super) segments: Vec<usize>,
}

/// The sides of a loop, in their order.
#[derive(Clone, Debug)]
pub(super) struct LoopSides {
    /// Those that are not zero.
    pub(super) all: Vec<LoopSide>,
    /// By how much place b is above place a along the axes, m.
    pub(super) height: Dd,
    /// The sum of the lengths of all segments, m.
    size: f64,
}

/// What a loop with a parallel branch cannot have.
pub(super) enum NotPlanar {
    /// A joint, by its link, that moves and is not revolute.
    Joint(LinkId),
    /// Axes that are not parallel.
    Axes,
}

/// Joints whose positions have a constant sum: Σ ratio · q = offset, rad.
pub(super) type AngleRelation = (Vec<Leader>, Dd);

/// Returns the sides of a loop. `reduced` returns a sum of joints' positions in independent ones, and a constant. If
/// `axial`, axis z of both places must be the loop's.
///
/// # Errors
/// If its joints are not revolute, with parallel axes.
pub(super) fn sides(
    chain: &LoopChain,
    axial: bool,
    reduced: impl Fn(&[Leader]) -> AngleRelation,
) -> Result<LoopSides, NotPlanar> {
    let moves = |motion| !matches!(motion, Motion::None | Motion::Rotation);
    if let Some(step) = chain.steps.iter().find(|step| moves(step.motion)) {
        return Err(NotPlanar::Joint(step.link));
    }
    let chain = at_zero(chain);
    let axis = loop_axis(&chain).ok_or(NotPlanar::Axes)?;
    let frames = chain.frames(&[Dd::ZERO], &DoubleDouble);
    let last = frames.last_axes() * chain.end.rotation;
    let z = Vec3([Dd::ZERO, Dd::ZERO, Dd::ONE]);
    let along = |v: Vec3<Dd>| parallel(axis, v);
    let same_way = last.column(2).dot(z) > Dd::ZERO;
    if axial && !(along(z) && along(last.column(2)) && same_way) {
        return Err(NotPlanar::Axes);
    }
    let angles = angles(&chain, axis, |k| frames.link(k).0);
    let across = turn_to_axis(axis).transpose();
    let mut found = LoopSides {
        all: Vec::new(),
        height: Dd::ZERO,
        size: 0.0,
    };
    for k in 0..chain.steps.len() + 2 {
        // A segment is on the link before a step outward, and after a step inward.
        let on = match k.checked_sub(1).map(|step| chain.steps.get(step)) {
            None => 0,
            Some(Some(step)) if !step.outward => k,
            Some(_) => k - 1,
        };
        let [x, y, along] = (across * frames.segment(k)).0;
        found.height += along;
        found.size += frames.segment(k).dot(frames.segment(k)).to_f64().sqrt();
        let (angle, constant) = reduced(&angles[on]);
        found.add(angle, turned([x, y], constant), k);
    }
    let zero = EQUAL * found.size;
    found.all.retain(|side| side.length().to_f64() > zero);
    Ok(found)
}

/// Returns the chain with a position of its own for each joint: the only one, at which all are zero.
fn at_zero(chain: &LoopChain) -> LoopChain {
    let mut chain = chain.clone();
    for step in &mut chain.steps {
        step.degrees = Degrees {
            positions: vec![PositionId(0)],
            velocities: vec![CoordinateId(0)],
            ..Degrees::default()
        };
    }
    chain
}

/// Returns the angle of each link of a chain about the axis, from place a to place b. `axes` are those of the links.
fn angles(chain: &LoopChain, axis: Vec3<Dd>, axes: impl Fn(usize) -> Mat3<Dd>) -> Vec<Vec<Leader>> {
    let mut angle: Vec<Leader> = Vec::new();
    let mut all = vec![angle.clone()];
    for (k, step) in chain.steps.iter().enumerate() {
        if step.motion == Motion::Rotation {
            let own = axes(k + usize::from(step.outward)) * step.axis;
            let positive = (own.dot(axis) > Dd::ZERO) == step.outward;
            let ratio = if positive { Dd::ONE } else { -Dd::ONE };
            let link = step.link;
            angle.push(Leader { link, ratio });
        }
        all.push(angle.clone());
    }
    all
}

fn turned([x, y]: Planar, angle: Dd) -> Planar {
    if angle == Dd::ZERO {
        return [x, y];
    }
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

impl LoopSide {
    /// Returns its length, m.
    pub(super) fn length(&self) -> Dd {
        let [x, y] = self.vector;
        (x * x + y * y).sqrt()
    }
}

impl LoopSides {
    /// Adds a segment to the side with this angle.
    fn add(&mut self, angle: Vec<Leader>, [x, y]: Planar, segment: usize) {
        let same = |side: &&mut LoopSide| is_same(&side.angle, &angle);
        match self.all.iter_mut().find(same) {
            Some(side) => {
                let [own_x, own_y] = side.vector;
                side.vector = [own_x + x, own_y + y];
                side.segments.push(segment);
            }
            None => self.all.push(LoopSide {
                angle,
                vector: [x, y],
                segments: vec![segment],
            }),
        }
    }

    /// Returns the lengths of the sides, m.
    pub(super) fn lengths(&self) -> Vec<f64> {
        let lengths = self.all.iter().map(|side| side.length().to_f64());
        lengths.collect()
    }

    /// Returns by how much opposite sides differ, m.
    pub(super) fn differences(&self) -> Vec<f64> {
        let (first, opposite) = self.all.split_at(self.all.len() / 2);
        let pairs = first.iter().zip(opposite);
        let differences = pairs.map(|(a, c)| (a.length() - c.length()).to_f64().abs());
        differences.collect()
    }

    /// Returns whether the places are at one height.
    pub(super) fn level(&self) -> bool {
        self.height.to_f64().abs() <= EQUAL * self.size
    }

    /// Returns the opposite sides of a parallelogram, or the only two sides of a loop, if they are equally long;
    /// nothing for a loop without sides. `None` for others.
    pub(super) fn opposite(&self) -> Option<Vec<[&LoopSide; 2]>> {
        let pairs = match self.all.as_slice() {
            [] => vec![],
            [a, b] => vec![[a, b]],
            [a, b, c, d] => vec![[a, c], [b, d]],
            _ => return None,
        };
        let equal = |[a, b]: &[&LoopSide; 2]| self.difference([a, b]) <= EQUAL;
        pairs.iter().all(equal).then_some(pairs)
    }

    /// Returns the largest difference of opposite sides, relative to the length of the loop; `None` for a loop that
    /// has no pairs of sides.
    pub(super) fn largest_difference(&self) -> Option<f64> {
        match self.all.as_slice() {
            [a, b] => Some(self.difference([a, b])),
            [a, b, c, d] => Some(self.difference([a, c]).max(self.difference([b, d]))),
            _ => None,
        }
    }

    fn difference(&self, [a, b]: [&LoopSide; 2]) -> f64 {
        (a.length() - b.length()).to_f64().abs() / self.size
    }
}

/// Returns whether two sums of positions are equal.
fn is_same(a: &[Leader], b: &[Leader]) -> bool {
    let of = |all: &[Leader], link: LinkId| {
        let own = all.iter().filter(|leader| leader.link == link);
        own.fold(Dd::ZERO, |sum, leader| sum + leader.ratio)
    };
    let mut links = a.iter().chain(b).map(|leader| leader.link);
    links.all(|link| (of(a, link) - of(b, link)).to_f64().abs() <= EQUAL)
}

/// Returns the relation of two sides that are opposite and equally long: a e^{iφ_a} + c e^{iφ_c} = 0, so that
/// φ_a − φ_c = arg(−c ā), from −π to π.
pub(super) fn relation([a, c]: [&LoopSide; 2]) -> AngleRelation {
    let negative = c.angle.iter().map(|leader| Leader {
        ratio: -leader.ratio,
        ..*leader
    });
    let terms = a.angle.iter().copied().chain(negative);
    let ([ax, ay], [cx, cy]) = (a.vector, c.vector);
    let size = ax * ax + ay * ay;
    let (cos, sin) = (-(cx * ax + cy * ay) / size, (cx * ay - cy * ax) / size);
    (terms.collect(), exact_angle(cos, sin))
}

/// Returns the angle with this cosine and sine; exact for quarter turns.
fn exact_angle(cos: Dd, sin: Dd) -> Dd {
    let small = |x: Dd| x.to_f64().abs() < ROUNDING;
    match (small(sin), small(cos)) {
        (true, _) if cos > Dd::ZERO => Dd::ZERO,
        (true, _) => Dd::PI,
        (_, true) if sin > Dd::ZERO => Dd::FRAC_PI_2,
        (_, true) => -Dd::FRAC_PI_2,
        _ => angle_of((cos, sin)),
    }
}

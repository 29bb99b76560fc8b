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

mod plane_chain;
mod unknown_joints;
mod vectors;

use bgdyn_runtime::Dd;

use super::{ClosingRow, Closure, RowKind};
use crate::mechanism::{CoordinateId, PositionId};
use plane_chain::PlaneChain;
use unknown_joints::{Found, form};
pub use vectors::PlaneVector;
use vectors::{conjugate, length, merged, opposite, times};

/// The least length of a rigid arc, m, and the least sine of an angle that tells the branch.
const LEAST: f64 = 1e-9;

/// The relative difference of lengths that are equal: positions of the two branches are then as near as rounding errors.
const NEARLY_EQUAL: f64 = 1e-12;

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
    let one_branch = same && !polygon.changes_branch();
    one_branch.then_some(Polygon {
        positive: first > 0.0,
        ..polygon
    })
}

impl Polygon {
    /// Returns whether the root changes its sign at regular positions: there two branches meet. Such loops are
    /// parallelograms and kites, with two pairs of equal sides, and slides through the pivot of a crank that is as long
    /// as the rod.
    fn changes_branch(&self) -> bool {
        let equal = |x: Dd, y: Dd| (x - y).to_f64().abs() <= NEARLY_EQUAL * x.to_f64();
        let known: Vec<Dd> = (self.known.iter())
            .map(|side| length(side.turned.vector))
            .collect();
        let slides = self.known.iter().any(|side| side.slide.is_some());
        match (&self.form, &known[..]) {
            (PolygonForm::Triangle { first, second, .. }, &[x, y]) if !slides => {
                let (a, b) = (length(first.vector), length(second.vector));
                (equal(a, x) && equal(b, y)) || (equal(a, y) && equal(b, x))
            }
            (PolygonForm::Slider { arm, along, .. }, _) if !slides => {
                let turning = |side: &&PolygonSide| side.turned.angle != along.angle;
                let turns: Vec<&PolygonSide> = self.known.iter().filter(turning).collect();
                let fixed = self.known.iter().filter(|side| !turning(side));
                let across =
                    |side: &PolygonSide| times(side.turned.vector, conjugate(along.vector))[1];
                let off = fixed.fold(Dd::ZERO, |sum, side| sum + across(side));
                let long = length(arm.vector);
                off.to_f64().abs() <= NEARLY_EQUAL * long.to_f64()
                    && matches!(turns[..], [one] if equal(length(one.turned.vector), long))
            }
            _ => false,
        }
    }

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

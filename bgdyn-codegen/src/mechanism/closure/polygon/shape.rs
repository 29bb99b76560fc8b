//! The sides of a polygon and its unknown joints.

use bgdyn_runtime::Dd;

use super::vectors::{PlaneVector, conjugate, length, negated, plus, times};
use crate::mechanism::{CoordinateId, PositionId};

/// The least length of a rigid arc, m, and the least sine of an angle that tells the branch.
pub(super) const LEAST: f64 = 1e-9;

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

impl TurnedVector {
    pub(super) fn negated(&self) -> Self {
        TurnedVector {
            angle: self.angle.clone(),
            vector: negated(self.vector),
        }
    }

    /// Returns the vector at a position of the open tree.
    pub(super) fn at(&self, q: &[Dd]) -> PlaneVector {
        let sum = self.angle.iter().fold(Dd::ZERO, |sum, term| {
            let q = q[term.joint.position.0];
            if term.opposite { sum - q } else { sum + q }
        });
        let (sin, cos) = sum.sin_cos();
        times(self.vector, [cos, sin])
    }
}

impl Polygon {
    /// Returns whether the root changes its sign at regular positions: there two branches meet. Such loops are
    /// parallelograms and kites, with two pairs of equal sides, and slides through the pivot of a crank that is as long
    /// as the rod.
    pub(super) fn changes_branch(&self) -> bool {
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
    pub(super) fn root_at(&self, q: &[Dd]) -> f64 {
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
pub(super) fn merged(sides: &[PolygonSide]) -> Vec<PolygonSide> {
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

pub(super) fn opposite(sides: &[PolygonSide]) -> Vec<PolygonSide> {
    let turned = sides.iter().map(|side| PolygonSide {
        turned: side.turned.negated(),
        slide: side.slide,
    });
    turned.collect()
}

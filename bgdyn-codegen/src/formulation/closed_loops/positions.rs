//! Positions of planar loops from those of the independent joints: directions of the dependent links, without their
//! angles.
//!
//! | form | equations |
//! |---|---|
//! | triangle | L² = D·D, 2H = ±√[((a + b)² − L²)(L² − (a − b)²)], first = ((L² + a² − b²) D + 2H D⊥)/(2L²), second = first − D |
//! | slider | e = along × D, y = ±√(a² − e²), arm = y along + e along⊥, x = y − D·along |
//! | cylinder | y = ±√(D·D − across²), along = D (y − i across)/D·D, x = y − start |
//!
//! H = first × second. The dependent angles are not needed: a sum of angles is one of independent angles and those of
//! the directions, and its cosine and sine are a product of complex numbers.

use bgdyn_runtime::{Dd, OUT_OF_REACH};

use super::plane::{InPlane, direction};
use super::sums::{JointSum, JointSums, unknown};
use crate::expr::{AngleSum, Builder, Expr, Leaf};
use crate::formulation::elimination::at;
use crate::formulation::velocity_map::FirstPivot;
use crate::mechanism::closure::{
    Closure, PlaneVector, Polygon, PolygonForm, PolygonSide, TurnedVector, snapped,
};

/// A way to write the positions.
#[derive(Clone, Copy, Debug)]
pub(super) struct PositionForm<'s> {
    /// L² of an arm on the link that carries the loop by the law of cosines.
    pub by_cosine: bool,
    /// The axes in which the vectors of a polygon are written: 0 for the link that carries the loop, k for those that
    /// turn with the k-th angle of its known arc, if there are so many.
    pub axes: usize,
    /// Sums of angles of the open tree's functions: their constants are used for the angles of links as well.
    pub angles: &'s [AngleSum],
    /// With checks of pivots: the index of the first loop's.
    pub first_pivot: FirstPivot,
}

/// The unknown joints of a polygon at a position.
#[derive(Clone, Copy)]
pub(super) enum SolvedPolygon<'g> {
    Triangle {
        first: InPlane<'g>,
        second: InPlane<'g>,
        /// 1 / H
        inverse: Expr<'g>,
        /// first · first, first · second, second · second
        products: [Expr<'g>; 3],
    },
    Slider {
        along: InPlane<'g>,
        displacement: Expr<'g>,
        y: Expr<'g>,
        e: Expr<'g>,
        /// 1 / y
        inverse: Expr<'g>,
    },
    Cylinder {
        along: InPlane<'g>,
        y: Expr<'g>,
        across: Expr<'g>,
        /// 1 / y
        inverse: Expr<'g>,
    },
}

/// The positions of all planar loops.
pub(super) struct ClosedPositions<'a, 'g> {
    pub b: &'g Builder,
    closure: &'a Closure,
    pub polygons: &'a [Polygon],
    pub sums: JointSums,
    form: PositionForm<'a>,
    q: Vec<Expr<'g>>,
    /// For each polygon the angle of its axes.
    axes: Vec<JointSum>,
    /// Cosine and sine of each unknown angle in these axes; the displacement of a slide as first component.
    unknown: Vec<InPlane<'g>>,
    pub solved: Vec<SolvedPolygon<'g>>,
}

impl<'a, 'g> ClosedPositions<'a, 'g> {
    pub(super) fn new(
        b: &'g Builder,
        (closure, polygons): (&'a Closure, &'a [Polygon]),
        q: &[Expr<'g>],
        form: PositionForm<'a>,
    ) -> Self {
        b.section(|| "directions of the links in loops".into());
        let mut positions = ClosedPositions {
            b,
            closure,
            polygons,
            sums: JointSums::new(polygons),
            form,
            q: q.to_vec(),
            axes: Vec::new(),
            unknown: Vec::new(),
            solved: Vec::new(),
        };
        for (p, polygon) in polygons.iter().enumerate() {
            debug_assert_eq!(positions.unknown.len(), unknown(p));
            let axes = positions.axes_of(polygon);
            positions.axes.push(axes);
            let (solved, unknown) = positions.solve(p);
            positions.solved.push(solved);
            positions.unknown.extend(unknown);
        }
        positions
    }

    /// Returns the position of a joint: of a dependent slide its expression. `None` for a dependent angle.
    pub(super) fn position(&self, p: usize) -> Option<Expr<'g>> {
        if !self.sums.depends(p) {
            return Some(self.q[p]);
        }
        let sum = self.sums.position(p);
        let slide = self
            .polygons
            .iter()
            .enumerate()
            .find_map(|(k, polygon)| match polygon.form {
                PolygonForm::Slider { slide, .. } | PolygonForm::Cylinder { slide, .. } => {
                    (slide.position.0 == p).then_some(unknown(k) + 1)
                }
                PolygonForm::Triangle { .. } => None,
            });
        slide
            .filter(|_| sum.own.is_empty())
            .map(|k| self.unknown[k].0[0])
    }

    /// Returns the angle of the axes of a polygon's vectors.
    fn axes_of(&self, polygon: &Polygon) -> JointSum {
        let sides = polygon.known.iter();
        let mut angles: Vec<JointSum> = Vec::new();
        for angle in sides.map(|side| self.sums.angle(&side.turned.angle)) {
            if angle != JointSum::default() && !angles.contains(&angle) {
                angles.push(angle);
            }
        }
        let wanted = self.form.axes.checked_sub(1).and_then(|k| angles.get(k));
        wanted.cloned().unwrap_or_default()
    }

    /// Returns cosine and sine of a sum of angles and a constant.
    pub(super) fn direction(&self, sum: &JointSum, offset: Dd) -> InPlane<'g> {
        let mut left = sum.clone();
        let mut whole: Option<InPlane<'g>> = None;
        // The axes of a polygon depend on earlier polygons alone.
        while let Some((k, n)) = left.unknown.pop_last() {
            let one = self.unknown[k];
            let one = if n < 0 { one.mirrored() } else { one };
            for _ in 0..n.unsigned_abs() {
                whole = Some(whole.map_or(one, |whole| whole.along(one)));
            }
            left.add(&self.axes[k / 2], n);
        }
        let own = (!left.own.is_empty()).then(|| self.own_direction(&left));
        let turned = match (whole, own) {
            (Some(whole), Some(own)) => whole.along(own),
            (Some(one), None) | (None, Some(one)) => one,
            (None, None) => InPlane([self.b.constant(Dd::ONE), self.b.zero()]),
        };
        turned.along(InPlane::constant(self.b, direction(offset)))
    }

    /// Returns cosine and sine of a sum of independent angles, from those of a sum with a constant that the open
    /// tree's functions have.
    fn own_direction(&self, sum: &JointSum) -> InPlane<'g> {
        let terms: Vec<Expr<'g>> = (sum.own.iter())
            .flat_map(|(&p, &n)| {
                let q = if n < 0 { -self.q[p] } else { self.q[p] };
                std::iter::repeat_n(q, n.unsigned_abs() as usize)
            })
            .collect();
        let same = |angle: &AngleSum, sign: i32| {
            let mut found = JointSum::default();
            for (leaf, negative) in &angle.terms {
                let Some(Leaf::Position(p)) = leaf else {
                    return false;
                };
                let one = JointSum {
                    own: [(*p, 1)].into(),
                    ..JointSum::default()
                };
                found.add(&one, if *negative { -sign } else { sign });
            }
            found.own == sum.own
        };
        let offsets = self.form.angles.iter().filter_map(|angle| {
            let plus = same(angle, 1).then_some(angle.offset);
            plus.or_else(|| same(angle, -1).then_some(-angle.offset))
        });
        let offset = offsets.min_by(|x, y| x.abs().to_f64().total_cmp(&y.abs().to_f64()));
        let offset = offset.unwrap_or(Dd::ZERO);
        let (cos, sin) = self.b.cos_sin(&terms, offset);
        InPlane([cos, sin]).along(InPlane::constant(self.b, direction(-offset)))
    }

    /// Returns the vector that a link carries, in the axes of polygon p.
    pub(super) fn vector(&self, p: usize, turned: &TurnedVector) -> InPlane<'g> {
        let vector = InPlane::constant(self.b, snapped(turned.vector));
        let mut angle = self.sums.angle(&turned.angle);
        angle.add(&self.axes[p], -1);
        vector.along(self.direction(&angle, Dd::ZERO))
    }

    /// Returns a side of the known arc of polygon p.
    pub(super) fn side(&self, p: usize, side: &PolygonSide) -> InPlane<'g> {
        let vector = self.vector(p, &side.turned);
        let slide = side.slide.and_then(|joint| self.position(joint.position.0));
        slide.map_or(vector, |x| vector.scale(x))
    }

    /// Returns the vector D of the known arc.
    fn known(&self, p: usize) -> InPlane<'g> {
        let sides = self.polygons[p].known.iter();
        let sides = sides.map(|side| self.side(p, side));
        sides.fold(InPlane::zero(self.b), |sum, side| sum + side)
    }

    /// Returns D·D; by the law of cosines if D is a constant side and one that turns.
    fn squared(&self, p: usize, known: InPlane<'g>) -> Expr<'g> {
        let sides = &self.polygons[p].known[..];
        if let ([one, other], true) = (sides, self.form.by_cosine)
            && one.slide.is_none()
            && other.slide.is_none()
            && (one.turned.angle.is_empty() || other.turned.angle.is_empty())
        {
            let [x, y] = [one, other].map(|side| self.side(p, side));
            let squares = [one, other].map(|side| square(side.turned.vector));
            return x.dot(y) * Dd::from_f64(2.0) + self.b.constant(squares[0] + squares[1]);
        }
        known.dot(known)
    }

    /// Returns a root with the sign of the branch. Its argument is checked: it is refused where it is negative, out of
    /// reach, or a rounding error of the terms that are subtracted in it, which have this `size`; without one of its
    /// largest sampled value.
    fn root(&self, polygon: &Polygon, argument: Expr<'g>, size: Option<Dd>) -> Expr<'g> {
        let b = self.b;
        let varies = argument.as_constant().is_none();
        let checked = match self.form.first_pivot.filter(|_| varies) {
            None => argument,
            Some(first) => {
                let samples = self.closure.samples.iter();
                let sampled = samples.map(|q| at(b, &[argument.signed()], q)[0]);
                let size = size.map(Dd::to_f64);
                let size = size.unwrap_or_else(|| sampled.fold(0.0, f64::max));
                argument.pivot(b.number(size), OUT_OF_REACH + first + polygon.closes)
            }
        };
        let root = checked.sqrt();
        if polygon.positive { root } else { -root }
    }

    /// Returns the unknown joints of a polygon, and cosine and sine of its unknown angles or a displacement.
    fn solve(&self, p: usize) -> (SolvedPolygon<'g>, [InPlane<'g>; 2]) {
        let (b, polygon) = (self.b, &self.polygons[p]);
        let one = || b.constant(Dd::ONE);
        let known = self.known(p);
        match &polygon.form {
            PolygonForm::Triangle { first, second, .. } => {
                let [aa, bb] = [first, second].map(|v| square(v.vector));
                let twice = aa.sqrt() * bb.sqrt() * Dd::from_f64(2.0);
                let squared = self.squared(p, known);
                let reach = b.constant(aa + bb + twice) - squared;
                let argument = reach * (squared - b.constant(aa + bb - twice));
                // Near the ends of the reach the rounding error of L², and the other factor, are below these.
                let size = (aa + bb + twice) * twice * Dd::from_f64(8.0);
                let root = self.root(polygon, argument, Some(size));
                let half = b.number(0.5) / squared;
                let along = (squared + b.constant(aa - bb)) * half;
                let a = known.scale(along) + known.turned().scale(root * half);
                let c = a - known;
                let solved = SolvedPolygon::Triangle {
                    first: a,
                    second: c,
                    inverse: b.number(2.0) / root,
                    products: [
                        b.constant(aa),
                        (b.constant(aa + bb) - squared) * Dd::from_f64(0.5),
                        b.constant(bb),
                    ],
                };
                (
                    solved,
                    [
                        self.turn_of(a, first.vector),
                        self.turn_of(c, second.vector),
                    ],
                )
            }
            PolygonForm::Slider { arm, along, .. } => {
                let along = self.vector(p, along);
                let aa = square(arm.vector);
                let e = along.cross(known);
                let twice = aa * Dd::from_f64(2.0);
                let y = self.root(polygon, b.constant(aa) - e * e, Some(twice));
                let x = y - known.dot(along);
                let moved = along.scale(y) + along.turned().scale(e);
                let solved = SolvedPolygon::Slider {
                    along,
                    displacement: x,
                    y,
                    e,
                    inverse: one() / y,
                };
                let turn = self.turn_of(moved, arm.vector);
                (solved, [turn, InPlane([x, b.zero()])])
            }
            PolygonForm::Cylinder {
                along,
                start,
                across,
                ..
            } => {
                let squared = known.dot(known);
                let across = across_or_zero(*across, *start);
                let y = self.root(polygon, squared - b.constant(across * across), None);
                let inverse = one() / y;
                let across = b.constant(across);
                let unit = match across.is_zero() {
                    true => known.scale(inverse),
                    false => {
                        let per = one() / squared;
                        known.along(InPlane([y * per, -(across * per)]))
                    }
                };
                let solved = SolvedPolygon::Cylinder {
                    along: unit,
                    y,
                    across,
                    inverse,
                };
                let x = y - b.constant(*start);
                (
                    solved,
                    [self.turn_of(unit, along.vector), InPlane([x, b.zero()])],
                )
            }
        }
    }

    /// Returns cosine and sine of the angle by which a link turned its vector.
    fn turn_of(&self, moved: InPlane<'g>, vector: PlaneVector) -> InPlane<'g> {
        let [x, y] = snapped(vector);
        let inverse = Dd::ONE / square(vector);
        moved.along(InPlane::constant(self.b, [x * inverse, -(y * inverse)]))
    }
}

/// Returns zero for a distance that is a rounding error.
fn across_or_zero(across: Dd, start: Dd) -> Dd {
    let size = start.abs().to_f64().max(1e-3);
    if across.abs().to_f64() < 1e-28 * size {
        Dd::ZERO
    } else {
        across
    }
}

fn square([x, y]: PlaneVector) -> Dd {
    x * x + y * y
}

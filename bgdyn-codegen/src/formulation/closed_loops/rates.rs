//! Velocities and accelerations of planar loops in closed form, and their transposed: efforts on independent joints.
//!
//! Ḋ and D̈ follow from the independent joints; the rates ω of the unknown links and ẋ of the slide from the first and
//! second derivatives of the equations of the positions:
//!
//! | form | rates | accelerations |
//! |---|---|---|
//! | triangle | ω₁ = Ḋ·second/H, ω₂ = Ḋ·first/H | with E = D̈ + ω₁² first − ω₂² second: α₁ = E·second/H, α₂ = E·first/H |
//! | slider | V = Ḋ + w x along⊥: ω = V·along⊥/y, ẋ = −ω e − V·along | V = D̈ + x (α along⊥ − w² along): α = (V·along⊥ + 2 w ẋ + ω² e)/y, ẍ = −ω² y − α e − V·along |
//! | cylinder | ω = Ḋ·along⊥/y, ẋ = Ḋ·along + ω across | α = (D̈·along⊥ − 2 ω ẋ + ω² across)/y, ẍ = D̈·along + α across + ω² y |

use bgdyn_runtime::Dd;

use super::plane::InPlane;
use super::positions::{ClosedPositions, SolvedPolygon};
use super::sums::{JointSum, unknown};
use crate::expr::Expr;
use crate::mechanism::closure::{Polygon, PolygonForm, PolygonSide};

/// Velocities, accelerations or efforts: of the open tree's joints by their number, zero for the dependent ones; and of
/// the unknown joints of the polygons.
#[derive(Clone)]
pub(super) struct JointRates<'g> {
    pub own: Vec<Expr<'g>>,
    pub unknown: Vec<Expr<'g>>,
}

impl<'g> JointRates<'g> {
    /// Returns the value of a sum.
    pub(super) fn of(&self, zero: Expr<'g>, sum: &JointSum) -> Expr<'g> {
        let own = sum.own.iter().map(|(&k, &n)| (self.own[k], n));
        let unknown = sum.unknown.iter().map(|(&k, &n)| (self.unknown[k], n));
        let terms = unknown.chain(own);
        terms.fold(zero, |total, (x, n)| total + x * Dd::from_f64(f64::from(n)))
    }

    /// Adds an effort on a sum of rates.
    pub(super) fn push(&mut self, sum: &JointSum, effort: Expr<'g>) {
        for (k, n) in &sum.own {
            self.own[*k] = self.own[*k] + effort * Dd::from_f64(f64::from(*n));
        }
        for (k, n) in &sum.unknown {
            self.unknown[*k] = self.unknown[*k] + effort * Dd::from_f64(f64::from(*n));
        }
    }
}

impl<'g> ClosedPositions<'_, 'g> {
    /// Returns zero rates, with these numbers of velocities of the open tree and of unknown joints.
    pub(super) fn still(&self, joints: usize) -> JointRates<'g> {
        JointRates {
            own: vec![self.b.zero(); joints],
            unknown: vec![self.b.zero(); unknown(self.polygons.len())],
        }
    }

    /// Returns the rates of all joints for those of the independent ones.
    pub(super) fn rates(&self, own: Vec<Expr<'g>>) -> JointRates<'g> {
        let mut rates = self.still(own.len());
        rates.own = own;
        for (p, polygon) in self.polygons.iter().enumerate() {
            let of = |sum: &JointSum| rates.of(self.b.zero(), sum);
            let found = self.unknown_rates((p, polygon), self.solved[p], of);
            rates.unknown[unknown(p)..unknown(p) + 2].copy_from_slice(&found);
        }
        rates
    }

    fn unknown_rates(
        &self,
        (p, polygon): (usize, &Polygon),
        solved: SolvedPolygon<'g>,
        of: impl Fn(&JointSum) -> Expr<'g>,
    ) -> [Expr<'g>; 2] {
        let side = |side: &PolygonSide| {
            let w = of(&self.sums.rate(&side.turned.angle));
            let turned = self.side(p, side).turned().scale(w);
            match side.slide {
                None => turned,
                Some(joint) => {
                    let rate = of(&self.sums.velocity(joint.velocity.0));
                    turned + self.vector(p, &side.turned).scale(rate)
                }
            }
        };
        let sides = polygon.known.iter().map(side);
        let moved = sides.fold(InPlane::zero(self.b), |sum, side| sum + side);
        match (solved, &polygon.form) {
            (
                SolvedPolygon::Triangle {
                    first,
                    second,
                    inverse,
                    ..
                },
                _,
            ) => [moved.dot(second) * inverse, moved.dot(first) * inverse],
            (
                SolvedPolygon::Slider {
                    along,
                    displacement,
                    e,
                    inverse,
                    ..
                },
                PolygonForm::Slider { along: turned, .. },
            ) => {
                let w = of(&self.sums.rate(&turned.angle));
                let moved = moved + along.turned().scale(w * displacement);
                let omega = moved.dot(along.turned()) * inverse;
                [omega, -(omega * e) - moved.dot(along)]
            }
            (
                SolvedPolygon::Cylinder {
                    along,
                    across,
                    inverse,
                    ..
                },
                _,
            ) => {
                let omega = moved.dot(along.turned()) * inverse;
                [omega, moved.dot(along) + omega * across]
            }
            _ => unreachable!("a slider is solved as one"),
        }
    }

    /// Returns the accelerations of all joints for those of the independent ones, at these rates.
    pub(super) fn accelerations(
        &self,
        rates: &JointRates<'g>,
        own: Vec<Expr<'g>>,
    ) -> JointRates<'g> {
        let mut found = self.still(own.len());
        found.own = own;
        for (p, polygon) in self.polygons.iter().enumerate() {
            let of = |sum: &JointSum| found.of(self.b.zero(), sum);
            let own = [rates.unknown[unknown(p)], rates.unknown[unknown(p) + 1]];
            let both = self.unknown_accelerations((p, polygon), self.solved[p], (rates, own), of);
            found.unknown[unknown(p)..unknown(p) + 2].copy_from_slice(&both);
        }
        found
    }

    fn unknown_accelerations(
        &self,
        (p, polygon): (usize, &Polygon),
        solved: SolvedPolygon<'g>,
        (rates, [omega, other]): (&JointRates<'g>, [Expr<'g>; 2]),
        of: impl Fn(&JointSum) -> Expr<'g>,
    ) -> [Expr<'g>; 2] {
        let two = Dd::from_f64(2.0);
        let rate = |sum: &JointSum| rates.of(self.b.zero(), sum);
        let side = |side: &PolygonSide| {
            let sum = self.sums.rate(&side.turned.angle);
            let (w, alpha) = (rate(&sum), of(&sum));
            let at = self.side(p, side);
            let turned = at.turned().scale(alpha) - at.scale(w * w);
            match side.slide {
                None => turned,
                Some(joint) => {
                    let along = self.vector(p, &side.turned);
                    let sum = self.sums.velocity(joint.velocity.0);
                    let carried = along.turned().scale(w * rate(&sum) * two);
                    turned + along.scale(of(&sum)) + carried
                }
            }
        };
        let sides = polygon.known.iter().map(side);
        let moved = sides.fold(InPlane::zero(self.b), |sum, side| sum + side);
        match (solved, &polygon.form) {
            (
                SolvedPolygon::Triangle {
                    first,
                    second,
                    inverse,
                    products: [aa, ab, bb],
                },
                _,
            ) => {
                let (ww, oo) = (omega * omega, other * other);
                let along_second = moved.dot(second) + (ww * ab - oo * bb);
                let along_first = moved.dot(first) + (ww * aa - oo * ab);
                [along_second * inverse, along_first * inverse]
            }
            (
                SolvedPolygon::Slider {
                    along,
                    displacement: x,
                    y,
                    e,
                    inverse,
                    ..
                },
                PolygonForm::Slider { along: turned, .. },
            ) => {
                let sum = self.sums.rate(&turned.angle);
                let (w, alpha) = (rate(&sum), of(&sum));
                let carried = along.turned().scale(alpha * x) - along.scale(w * w * x);
                let moved = moved + carried;
                let ww = omega * omega;
                let turning = moved.dot(along.turned()) + w * other * two + ww * e;
                let turning = turning * inverse;
                [turning, -(ww * y) - turning * e - moved.dot(along)]
            }
            (
                SolvedPolygon::Cylinder {
                    along,
                    y,
                    across,
                    inverse,
                },
                _,
            ) => {
                let ww = omega * omega;
                let turning = moved.dot(along.turned()) - omega * other * two + ww * across;
                let turning = turning * inverse;
                [turning, moved.dot(along) + turning * across + ww * y]
            }
            _ => unreachable!("a slider is solved as one"),
        }
    }

    /// Returns efforts on the independent joints with the same power as these: the efforts on the unknown joints become
    /// forces on the ends of the known arcs.
    pub(super) fn transposed(&self, mut efforts: JointRates<'g>) -> Vec<Expr<'g>> {
        for (p, polygon) in self.polygons.iter().enumerate().rev() {
            let k = unknown(p);
            let [g, other] = [efforts.unknown[k], efforts.unknown[k + 1]];
            let force = match self.solved[p] {
                SolvedPolygon::Triangle {
                    first,
                    second,
                    inverse,
                    ..
                } => (second.scale(g) + first.scale(other)).scale(inverse),
                SolvedPolygon::Slider {
                    along, e, inverse, ..
                } => {
                    let turning = (g - e * other) * inverse;
                    along.turned().scale(turning) - along.scale(other)
                }
                SolvedPolygon::Cylinder {
                    along,
                    across,
                    inverse,
                    ..
                } => {
                    let turning = (g + across * other) * inverse;
                    along.turned().scale(turning) + along.scale(other)
                }
            };
            for side in &polygon.known {
                let torque = self.side(p, side).cross(force);
                efforts.push(&self.sums.rate(&side.turned.angle), torque);
                if let Some(joint) = side.slide {
                    let along = self.vector(p, &side.turned).dot(force);
                    efforts.push(&self.sums.velocity(joint.velocity.0), along);
                }
            }
            if let (
                SolvedPolygon::Slider {
                    along,
                    displacement,
                    ..
                },
                PolygonForm::Slider { along: turned, .. },
            ) = (self.solved[p], &polygon.form)
            {
                let torque = along.scale(displacement).cross(force);
                efforts.push(&self.sums.rate(&turned.angle), torque);
            }
        }
        efforts.own
    }

    /// Returns efforts on the joints of the open tree as efforts on the independent and the unknown ones.
    pub(super) fn gathered(&self, f: &[Expr<'g>]) -> JointRates<'g> {
        let mut gathered = self.still(f.len());
        for (j, &f) in f.iter().enumerate() {
            gathered.push(&self.sums.velocity(j), f);
        }
        gathered
    }

    /// Returns the velocities of the open tree's joints.
    pub(super) fn of_tree(&self, rates: &JointRates<'g>) -> Vec<Expr<'g>> {
        let all = 0..rates.own.len();
        all.map(|j| rates.of(self.b.zero(), &self.sums.velocity(j)))
            .collect()
    }
}

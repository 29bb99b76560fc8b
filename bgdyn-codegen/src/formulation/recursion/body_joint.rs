//! The coordinates of a body's joint, as expressions: signed, scaled to the unit of length of the plan.

use bgdyn_runtime::Dd;

use super::geometry::Body;
use super::joint_columns::JointColumn;
use crate::bond_graph::LinkFrame;
use crate::expr::{Builder, Expr};
use crate::formulation::arguments::Arguments;
use crate::formulation::joint_motion::joint_rates;
use crate::math::Vec3;
use crate::mechanism::Motion;
use crate::mechanism::joint::Column;

/// A joint with an axis or without one, and the unit of length.
pub(super) struct BodyJoint<'a> {
    pub body: &'a Body,
    pub link: &'a LinkFrame,
    pub unit: Dd,
}

impl BodyJoint<'_> {
    fn signed<'g>(&self, e: Expr<'g>) -> Expr<'g> {
        if self.body.opposite { -e } else { e }
    }

    /// Returns its position, without the offset of a coupled joint: as a rotation about or a translation
    /// along z.
    fn position<'g>(&self, b: &'g Builder, x: &Arguments<'g>) -> Expr<'g> {
        let degrees = &self.link.degrees;
        let terms = degrees.positions.iter().zip(degrees.position_ratios());
        let terms = terms.map(|(p, ratio)| self.signed(x.q[p.0]) * ratio);
        terms.fold(b.zero(), |sum, term| sum + term)
    }

    fn offset(&self) -> Dd {
        let offset = self.link.degrees.offset();
        if self.body.opposite { -offset } else { offset }
    }

    /// Returns the angle about z, if it rotates: its variable part, and cosine and sine of its constant
    /// part.
    pub fn angle<'g>(&self, b: &'g Builder, x: &Arguments<'g>) -> (Option<Expr<'g>>, (Dd, Dd)) {
        let offset = self.offset();
        if self.body.motion == Motion::Translation {
            return (None, (Dd::ONE, Dd::ZERO));
        }
        let (sin, cos) = offset.sin_cos();
        let offset = if offset == Dd::ZERO {
            (Dd::ONE, Dd::ZERO)
        } else {
            (cos, sin)
        };
        (Some(self.position(b, x)), offset)
    }

    /// Returns a position with the displacement along z.
    pub fn slid<'g>(
        &self,
        b: &'g Builder,
        mut at: Vec3<Expr<'g>>,
        x: &Arguments<'g>,
    ) -> Vec3<Expr<'g>> {
        let per_position = match self.body.motion {
            Motion::Rotation => return at,
            Motion::Translation => Dd::ONE / self.unit,
            _ => self.link.degrees.advance / self.unit,
        };
        let moved = self.position(b, x) * per_position;
        at.0[2] = at.0[2] + moved;
        if self.offset() != Dd::ZERO {
            at.0[2] = at.0[2] + b.constant(self.offset() * per_position);
        }
        at
    }

    /// Returns rate and second rate about or along z; zero for a joint with several velocities.
    pub fn rates<'g>(
        &self,
        b: &'g Builder,
        columns: &[JointColumn],
        x: &Arguments<'g>,
    ) -> (Expr<'g>, Expr<'g>) {
        let still = (b.zero(), b.zero());
        if !self.body.axial {
            return still;
        }
        columns.iter().fold(still, |(rate, second), column| {
            let signed = |e: Expr<'g>| match column.effort < Dd::ZERO {
                true => -e * -column.effort,
                false => e * column.effort,
            };
            let (v, a) = (x.v[column.coordinate], x.a[column.coordinate]);
            (rate + signed(v), second + signed(a))
        })
    }

    /// Returns the twist of a joint with several velocities, and its rate for constant columns.
    pub fn relative<'g>(&self, b: &'g Builder, x: &Arguments<'g>) -> Option<[Column<Expr<'g>>; 2]> {
        if self.body.axial {
            return None;
        }
        if self.body.motion.is_given() {
            return Some(self.base_motion(b, x));
        }
        let of = |rates: &[Expr<'g>]| {
            let still = Vec3([b.zero(); 3]);
            let start = Column {
                angular: still,
                linear: still,
            };
            let rates = joint_rates(b, self.link, rates);
            let columns = self.link.columns().into_iter().zip(rates);
            columns.fold(start, |sum, ((_, column), rate)| Column {
                angular: sum.angular + b.vector(column.angular).scale(rate),
                linear: sum.linear + b.vector(column.linear).scale(rate * (Dd::ONE / self.unit)),
            })
        };
        Some([of(&x.v), of(&x.a)])
    }

    /// Returns angular velocity, and accelerations, of a base whose motion is given; zero for methods that
    /// do not depend on them. The velocity of its origin changes no effort.
    fn base_motion<'g>(&self, b: &'g Builder, x: &Arguments<'g>) -> [Column<Expr<'g>>; 2] {
        let still = Vec3([b.zero(); 3]);
        let zero = Column {
            angular: still,
            linear: still,
        };
        let Some(base) = &x.base else {
            return [zero, zero];
        };
        let velocity = Column {
            angular: base.omega,
            linear: still,
        };
        let acceleration = Column {
            angular: base.omega_dot,
            linear: base.acceleration.map(|f| f * (Dd::ONE / self.unit)),
        };
        [velocity, acceleration]
    }
}

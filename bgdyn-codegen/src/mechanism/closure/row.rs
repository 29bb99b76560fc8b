//! The rows of a loop: what must vanish at the closed position, with its derivatives.

use std::ops::Mul;

use bgdyn_runtime::Dd;

use super::chain::{RelativePlace, RelativeRates};
use crate::math::{Ring, Vec3};
use crate::mechanism::joint::Column;

/// A scalar condition on the motion of place b relative to place a.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowKind {
    /// A component of the origin of b, m.
    Place(usize),
    /// A component of the angle between the z axes, about x or y of a, rad.
    Tilt(usize),
    /// A component of the rotation, about an axis of a, rad.
    Turn(usize),
    /// The distance less its length, m: (d·d − L²) / 2L.
    Length,
    /// The cosine of the angle between z of a and x of b.
    Angle,
}

impl RowKind {
    /// Returns the value that vanishes at the closed position; `length` is that of a rod.
    pub fn residual<E: Ring + Mul<Dd, Output = E>>(
        self,
        place: &RelativePlace<E>,
        length: Dd,
        constant: impl Fn(Dd) -> E,
    ) -> E {
        let r = place.rotation.0;
        let half = Dd::from_f64(0.5);
        match self {
            RowKind::Place(k) => place.position.0[k],
            RowKind::Tilt(0) => -r[1][2],
            RowKind::Tilt(_) => r[0][2],
            RowKind::Turn(k) => {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                (r[j][i] - r[i][j]) * half
            }
            RowKind::Length => {
                let d = place.position;
                (d.dot(d) - constant(length * length)) * (half / length)
            }
            RowKind::Angle => r[2][0],
        }
    }

    /// Returns the rate of the value for a twist of b, at a closed position.
    pub fn rate<E: Ring + Mul<Dd, Output = E>>(
        self,
        place: &RelativePlace<E>,
        twist: &Column<E>,
        length: Dd,
    ) -> E {
        match self {
            RowKind::Place(k) => twist.linear.0[k],
            RowKind::Tilt(k) | RowKind::Turn(k) => twist.angular.0[k],
            RowKind::Length => place.position.dot(twist.linear) * (Dd::ONE / length),
            RowKind::Angle => {
                // z · (ω × x)
                let Vec3([x, y, _]) = place.rotation.column(0);
                twist.angular.0[0] * y - twist.angular.0[1] * x
            }
        }
    }

    /// Returns the second derivative of the value if no joint accelerates, at a closed position with closed
    /// velocities.
    pub fn bias<E: Ring + Mul<Dd, Output = E>>(
        self,
        place: &RelativePlace<E>,
        rates: &RelativeRates<E>,
        length: Dd,
    ) -> E {
        let along = self.rate(place, &rates.bias, length);
        match self {
            RowKind::Place(_) | RowKind::Tilt(_) | RowKind::Turn(_) => along,
            RowKind::Length => {
                let v = rates.velocity.linear;
                along + v.dot(v) * (Dd::ONE / length)
            }
            RowKind::Angle => {
                // z · (ω × (ω × x))
                let omega = rates.velocity.angular;
                let turned = omega.cross(omega.cross(place.rotation.column(0)));
                along + turned.0[2]
            }
        }
    }

    /// Returns the unit of the value.
    pub fn unit(self) -> &'static str {
        match self {
            RowKind::Place(_) | RowKind::Length => "m",
            RowKind::Tilt(_) | RowKind::Turn(_) => "rad",
            RowKind::Angle => "",
        }
    }
}

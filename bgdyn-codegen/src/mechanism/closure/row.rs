//! The rows of a loop: what must vanish at the closed position, with its derivatives.

use std::ops::Mul;

use bgdyn_runtime::Dd;

use super::chain::{RelativePlace, RelativeRates};
use super::contact_shape::ContactRow;
use crate::math::{Ring, Vec3};
use crate::mechanism::joint::Column;

/// A scalar condition on the motion of place b relative to place a.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowKind {
    /// Of a loop: on positions.
    Closing(ClosingRow),
    /// Of a contact: on velocities, or on the height.
    Contact(ContactRow),
}

impl RowKind {
    /// Returns whether positions decide whether the row holds; otherwise velocities alone.
    pub fn has_positions(self) -> bool {
        !matches!(self, RowKind::Contact(row) if row.of_velocities())
    }

    /// Returns the unit of the value; of the rate for a row on velocities.
    pub fn unit(self) -> &'static str {
        match self {
            RowKind::Closing(row) => row.unit(),
            RowKind::Contact(row) if row.of_velocities() => "m/s",
            RowKind::Contact(_) => "m",
        }
    }
}

/// A condition of a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClosingRow {
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

impl ClosingRow {
    /// Returns the value that vanishes at the closed position; `length` is that of a rod.
    pub(crate) fn residual<E: Ring + Mul<Dd, Output = E>>(
        self,
        place: &RelativePlace<E>,
        length: Dd,
        constant: impl Fn(Dd) -> E,
    ) -> E {
        let r = place.rotation.0;
        let half = Dd::from_f64(0.5);
        match self {
            ClosingRow::Place(k) => place.position.0[k],
            ClosingRow::Tilt(0) => -r[1][2],
            ClosingRow::Tilt(_) => r[0][2],
            ClosingRow::Turn(k) => {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                (r[j][i] - r[i][j]) * half
            }
            ClosingRow::Length => {
                let d = place.position;
                (d.dot(d) - constant(length * length)) * (half / length)
            }
            ClosingRow::Angle => r[2][0],
        }
    }

    /// Returns the rate of the value for a twist of b, at a closed position.
    pub(super) fn rate<E: Ring + Mul<Dd, Output = E>>(
        self,
        place: &RelativePlace<E>,
        twist: &Column<E>,
        length: Dd,
    ) -> E {
        match self {
            ClosingRow::Place(k) => twist.linear.0[k],
            ClosingRow::Tilt(k) | ClosingRow::Turn(k) => twist.angular.0[k],
            ClosingRow::Length => place.position.dot(twist.linear) * (Dd::ONE / length),
            ClosingRow::Angle => {
                // z · (ω × x)
                let Vec3([x, y, _]) = place.rotation.column(0);
                twist.angular.0[0] * y - twist.angular.0[1] * x
            }
        }
    }

    /// Returns the second derivative of the value if no joint accelerates, at a closed position with closed
    /// velocities.
    pub(super) fn bias<E: Ring + Mul<Dd, Output = E>>(
        self,
        place: &RelativePlace<E>,
        rates: &RelativeRates<E>,
        length: Dd,
    ) -> E {
        let along = self.rate(place, &rates.bias, length);
        match self {
            ClosingRow::Place(_) | ClosingRow::Tilt(_) | ClosingRow::Turn(_) => along,
            ClosingRow::Length => {
                let v = rates.velocity.linear;
                along + v.dot(v) * (Dd::ONE / length)
            }
            ClosingRow::Angle => {
                // z · (ω × (ω × x))
                let omega = rates.velocity.angular;
                let turned = omega.cross(omega.cross(place.rotation.column(0)));
                along + turned.0[2]
            }
        }
    }

    /// Returns the unit of the value.
    fn unit(self) -> &'static str {
        match self {
            ClosingRow::Place(_) | ClosingRow::Length => "m",
            ClosingRow::Tilt(_) | ClosingRow::Turn(_) => "rad",
            ClosingRow::Angle => "",
        }
    }
}

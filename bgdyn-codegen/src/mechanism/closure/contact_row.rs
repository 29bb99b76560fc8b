//! The rows of a contact: their rates and the derivatives of these. The equations are in [`super::contact`].

use std::ops::Mul;

use bgdyn_runtime::Dd;

use super::chain::RelativeRates;
use super::contact::ContactFrame;
use super::contact_shape::{ContactAxes, ContactRow};
use crate::math::{Ring, Vec3};
use crate::mechanism::joint::Column;

impl ContactRow {
    /// Returns the direction of the row's force on the wheel, ball or edge: t, l or z of the plane, or that of the edge.
    pub(super) fn direction<E: Ring + Mul<Dd, Output = E>>(
        self,
        frame: &ContactFrame<E>,
    ) -> Vec3<E> {
        match self {
            ContactRow::Edge => frame.axle,
            ContactRow::Longitudinal => frame.forward,
            // l = z × t
            ContactRow::Lateral => frame.normal.cross(frame.forward),
            ContactRow::Slip(k) => frame.plane[k],
            ContactRow::Height => frame.normal,
        }
    }

    /// Returns the rate of its direction on a tyre, from ż and κ; that of an ellipsoid's rows along the plane is not
    /// needed, because V is zero.
    fn direction_rate<E: Ring + Mul<Dd, Output = E>>(
        self,
        frame: &ContactFrame<E>,
        (normal_rate, turn): (Vec3<E>, E),
    ) -> Vec3<E> {
        let forward_rate = -frame.upward.scale(turn);
        match self {
            ContactRow::Longitudinal => forward_rate,
            ContactRow::Lateral => {
                normal_rate.cross(frame.forward) + frame.normal.cross(forward_rate)
            }
            ContactRow::Height => normal_rate,
            ContactRow::Edge | ContactRow::Slip(_) => Vec3([frame.zero; 3]),
        }
    }

    /// Returns its component of the force in the axes of the contact: ahead, along the axle in the plane, normal to it;
    /// of a ball along x and y of the plane; `None` for a knife edge.
    pub fn contact_axis(self) -> Option<usize> {
        match self {
            ContactRow::Edge => None,
            _ => Some(self.component()),
        }
    }

    /// Returns whether positions do not decide whether the row holds.
    pub fn of_velocities(self) -> bool {
        self != ContactRow::Height
    }

    /// Returns the height above the plane less that of contact, m; zero for rows on velocities. `height` is that of
    /// the centre.
    pub(super) fn residual<E: Ring + Mul<Dd, Output = E>>(
        self,
        height: E,
        frame: &ContactFrame<E>,
    ) -> E {
        match self {
            ContactRow::Height => {
                let touching = match &frame.round {
                    Some(round) => round.height,
                    None => frame.radius * frame.cosine[0],
                };
                height - touching
            }
            _ => frame.zero,
        }
    }

    /// Returns the rate of the row for a twist of the wheel.
    pub(super) fn rate<E: Ring + Mul<Dd, Output = E>>(
        self,
        frame: &ContactFrame<E>,
        twist: &Column<E>,
        axes: ContactAxes,
    ) -> E {
        let (omega, v, r) = (twist.angular, twist.linear, frame.radius);
        if let Some(round) = &frame.round {
            let velocity = v + omega.cross(round.arm);
            return match axes {
                ContactAxes::Link => velocity.0[self.component()],
                _ => self.direction(frame).dot(velocity),
            };
        }
        let along_axle = || frame.axle.dot(v) + r * frame.forward.dot(omega);
        let upward = || frame.upward.dot(v);
        match (self, axes) {
            (ContactRow::Edge, _) => frame.axle.dot(v),
            (_, ContactAxes::Link) => {
                let k = self.component();
                v.0[k] - omega.cross(frame.upward).0[k] * r
            }
            (ContactRow::Longitudinal, _) => frame.forward.dot(v) - r * frame.axle.dot(omega),
            (ContactRow::Lateral, ContactAxes::Wheel) => along_axle(),
            (ContactRow::Lateral, ContactAxes::Plane) => {
                frame.cosine[0] * along_axle() - frame.sine * upward()
            }
            (ContactRow::Slip(k), _) => frame.plane[k].dot(v - omega.cross(frame.normal).scale(r)),
            (ContactRow::Height, ContactAxes::Wheel) => upward(),
            (ContactRow::Height, ContactAxes::Plane) => {
                frame.normal.dot(v) + r * (frame.sine * frame.forward.dot(omega))
            }
        }
    }

    /// Returns the component of V in link axes for this row.
    fn component(self) -> usize {
        match self {
            ContactRow::Edge | ContactRow::Longitudinal => 0,
            ContactRow::Lateral => 1,
            ContactRow::Slip(k) => k,
            ContactRow::Height => 2,
        }
    }

    /// Returns the derivative of the rate if no joint accelerates, for velocities at which all rows of the contact
    /// hold; `turning` is the angular velocity of the plane relative to place a.
    pub(super) fn bias<E: Ring + Mul<Dd, Output = E>>(
        self,
        frame: &ContactFrame<E>,
        (rates, turning): (&RelativeRates<E>, Vec3<E>),
        axes: ContactAxes,
    ) -> E {
        let (omega, v, r) = (rates.velocity.angular, rates.velocity.linear, frame.radius);
        let along = |row: ContactRow, axes| row.rate(frame, &rates.bias, axes);
        let normal_rate = turning.cross(frame.normal);
        let turn = match frame.upright {
            true => frame.zero,
            false => frame.forward.dot(normal_rate) * frame.cosine[1],
        };
        if let Some(round) = &frame.round {
            let arm_rate = round.arm_rate(normal_rate, frame.forward.scale(turn));
            let changed = omega.cross(arm_rate);
            return match axes {
                ContactAxes::Link => along(self, axes) + changed.0[self.component()],
                _ => {
                    // ḋ · V, which is not zero where the wheel slips along its axle.
                    let velocity = v + omega.cross(round.arm);
                    let turned = self
                        .direction_rate(frame, (normal_rate, turn))
                        .dot(velocity);
                    along(self, axes) + self.direction(frame).dot(changed) + turned
                }
            };
        }
        let along_axle = || {
            let turned = turn * frame.upward.dot(omega);
            along(ContactRow::Lateral, ContactAxes::Wheel) - r * turned
        };
        let upward = || along(ContactRow::Height, ContactAxes::Wheel) + turn * frame.forward.dot(v);
        match (self, axes) {
            (ContactRow::Edge, _) => along(self, axes),
            (_, ContactAxes::Link) => {
                let upward_rate = match frame.ball {
                    true => normal_rate,
                    false => frame.forward.scale(turn),
                };
                along(self, axes) - omega.cross(upward_rate).0[self.component()] * r
            }
            (ContactRow::Longitudinal, _) => along(self, axes) - turn * frame.upward.dot(v),
            (ContactRow::Lateral, ContactAxes::Wheel) => along_axle(),
            (ContactRow::Lateral, ContactAxes::Plane) => {
                frame.cosine[0] * along_axle() - frame.sine * upward()
            }
            (ContactRow::Slip(k), _) => {
                along(self, axes) - frame.plane[k].dot(omega.cross(normal_rate)) * r
            }
            (ContactRow::Height, ContactAxes::Wheel) => upward(),
            (ContactRow::Height, ContactAxes::Plane) => {
                let leaning = normal_rate.dot(frame.axle) * frame.forward.dot(omega);
                let turned = frame.sine * (turn * frame.upward.dot(omega));
                along(self, axes) + normal_rate.dot(v) + r * (leaning - turned)
            }
        }
    }
}

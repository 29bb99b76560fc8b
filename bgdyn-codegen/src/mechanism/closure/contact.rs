//! Contacts: a wheel or a ball that rolls on a plane without slipping, and a knife edge.
//!
//! Their rows are conditions on velocities (Neimark and Fufaev 1972); only the height of a wheel or a ball above
//! its plane has a position.
//!
//! A wheel is a thin disc of radius r with the unit vector n along its axle; z is the normal of its plane, c its
//! centre. With s = |z − (z·n) n|, e = (z − (z·n) n) / s and t = n × e, the lowest point of its rim is c − r e, and its
//! material point there has the velocity V = ċ − r ω × e. The rows:
//!
//! - longitudinal: t · V = t · ċ − r n · ω
//! - lateral: l · V with l = z × t, horizontal; or n · V = n · ċ + r t · ω
//! - height: z · V = z · ċ + r (z·n) t · ω, the rate of z · c − r s; or e · V = e · ċ
//!
//! (l, z) is (n, e) turned by the lean: both pairs together hold at the same velocities, and the second one takes
//! fewer operations. Where e turns, all three rows are the components of V. All are in the axes of the link that
//! carries the axle, in which n is constant: the angle of the wheel about its axle does not enter. Accelerations are
//! those of the twist of the wheel relative to the plane at the fixed point of these axes (spatial accelerations,
//! Featherstone 2008), so that the derivative of a row needs only those of z, e and t: with κ = t · ż / s they are ż = Ω × z, ė = κ t, ṫ = −κ e.

use std::ops::Mul;

use bgdyn_runtime::Dd;

use super::chain::{RelativePlace, RelativeRates};
use super::contact_shape::{ContactAxes, ContactNumbers, ContactRow, ContactShape, PlaneContact};
use super::round_contact::RoundContact;
use super::row::RowKind;
use crate::math::{Ring, Vec3};
use crate::mechanism::CoordinateId;
use crate::mechanism::joint::{Column, PoseNumbers};

/// The directions of a contact at one position, in the axes of place a.
pub struct ContactFrame<E> {
    /// n of a wheel, the direction of a knife edge; z of a ball.
    pub(super) axle: Vec3<E>,
    /// z
    pub(super) normal: Vec3<E>,
    /// e
    pub(super) upward: Vec3<E>,
    /// t
    pub(super) forward: Vec3<E>,
    /// s and 1 / s, the cosine of the lean
    pub(super) cosine: [E; 2],
    /// n · z, the sine of the lean
    pub(super) sine: E,
    /// Axes of the plane.
    pub(super) plane: [Vec3<E>; 2],
    pub(super) radius: E,
    pub(super) zero: E,
    /// Whether e is constant.
    pub(super) upright: bool,
    /// Whether it is that of a ball, for which e is z.
    pub(super) ball: bool,
    /// Of an ellipsoid or a tyre.
    pub(super) round: Option<RoundContact<E>>,
}

impl PlaneContact {
    /// Returns the twist of the wheel relative to the plane per unit velocity, from that of the plane relative to
    /// place a.
    pub(super) fn columns<E: Ring + Mul<Dd, Output = E>>(
        &self,
        place: &RelativePlace<E>,
        numbers: &impl PoseNumbers<E>,
    ) -> Vec<(CoordinateId, Column<E>)> {
        let opposite = |(j, column): &(CoordinateId, Column<E>)| {
            let (angular, linear) = (-column.angular, -column.linear);
            (*j, Column { angular, linear })
        };
        let mut all: Vec<_> = place.columns.iter().map(opposite).collect();
        let ContactShape::Disc(axle) = self.shape else {
            return all;
        };
        let zero = Vec3([numbers.constant(Dd::ZERO); 3]);
        for &(j, factor) in &self.spin {
            let angular = axle.scale(factor).map(|x| numbers.constant(x));
            match all.iter_mut().find(|(k, _)| *k == j) {
                Some((_, column)) => column.angular = column.angular + angular,
                None => all.push((
                    j,
                    Column {
                        angular,
                        linear: zero,
                    },
                )),
            }
        }
        all
    }

    /// Returns the twist of the wheel relative to the plane and its acceleration without accelerations of joints, from
    /// those of the plane relative to place a.
    pub(super) fn rates<E: Ring + Mul<Dd, Output = E>>(
        &self,
        of_plane: &RelativeRates<E>,
        v: &[E],
        numbers: &impl PoseNumbers<E>,
    ) -> RelativeRates<E> {
        let opposite = |column: &Column<E>| Column {
            angular: -column.angular,
            linear: -column.linear,
        };
        let (mut velocity, bias) = (opposite(&of_plane.velocity), opposite(&of_plane.bias));
        if let ContactShape::Disc(axle) = self.shape {
            for &(j, factor) in &self.spin {
                let own = axle.scale(factor).map(|x| numbers.constant(x));
                velocity.angular = velocity.angular + own.scale(v[j.0]);
            }
        }
        RelativeRates { velocity, bias }
    }

    /// Returns the axes in which its rows are solved: those of the body, if its rows there hold at the same
    /// velocities.
    pub fn solved_in(&self, kept: impl Fn(ContactRow) -> bool) -> ContactAxes {
        let all = kept(ContactRow::Height);
        let lateral = kept(ContactRow::Lateral);
        match self.shape {
            _ if self.solved.is_some() => self.solved.unwrap_or(ContactAxes::Plane),
            ContactShape::Edge(_) => ContactAxes::Wheel,
            ContactShape::Disc(_) if self.crown != Dd::ZERO => {
                match all && lateral && kept(ContactRow::Longitudinal) {
                    true => ContactAxes::Link,
                    false => ContactAxes::Plane,
                }
            }
            ContactShape::Disc(_)
                if all && lateral && kept(ContactRow::Longitudinal) && self.upward.is_none() =>
            {
                ContactAxes::Link
            }
            // Without the lateral row the one along e is not the rate of the height.
            ContactShape::Disc(_) if lateral => ContactAxes::Wheel,
            ContactShape::Sphere | ContactShape::Ellipsoid(_) if all => ContactAxes::Link,
            _ => ContactAxes::Plane,
        }
    }

    /// Returns its directions.
    pub(super) fn frame<E: Ring + Mul<Dd, Output = E>>(
        &self,
        place: &RelativePlace<E>,
        numbers: &impl ContactNumbers<E>,
    ) -> ContactFrame<E> {
        let constant = |x: Dd| numbers.constant(x);
        let (zero, one) = (constant(Dd::ZERO), constant(Dd::ONE));
        let normal = place.rotation.column(2);
        let axle = match self.shape {
            ContactShape::Edge(n) | ContactShape::Disc(n) => n.map(constant),
            ContactShape::Sphere | ContactShape::Ellipsoid(_) => normal,
        };
        let (upward, cosine, sine) = match (self.shape, self.upward) {
            (ContactShape::Disc(_), Some(upward)) => {
                let upward = upward.map(constant);
                let cosine = upward.dot(normal);
                (upward, [cosine, numbers.inverse(cosine)], axle.dot(normal))
            }
            (ContactShape::Disc(_), None) => {
                let sine = axle.dot(normal);
                let across = normal - axle.scale(sine);
                let cosine = numbers.leaning(numbers.root(across.dot(across)));
                let inverse = numbers.inverse(cosine);
                (across.scale(inverse), [cosine, inverse], sine)
            }
            _ => (normal, [one; 2], zero),
        };
        ContactFrame {
            axle,
            normal,
            upward,
            forward: axle.cross(upward),
            cosine,
            sine,
            plane: [place.rotation.column(0), place.rotation.column(1)],
            radius: constant(self.radius),
            zero,
            upright: self.upward.is_some(),
            ball: self.shape == ContactShape::Sphere,
            round: RoundContact::new(self, (normal, upward, cosine[0]), numbers),
        }
    }
}

impl<E: Ring> ContactFrame<E> {
    /// Returns whether a rotation about the axle enters a row: it moves the contact along t only.
    pub(super) fn moved_by_spin(&self, row: RowKind, axes: ContactAxes) -> bool {
        let beside = [ContactRow::Lateral, ContactRow::Height].map(RowKind::Contact);
        axes == ContactAxes::Link || !beside.contains(&row)
    }

    /// Returns the contact, from the centre: −r e, or that of a rounded body.
    pub(super) fn contact(&self) -> Vec3<E> {
        match &self.round {
            Some(round) => round.arm,
            None => -self.upward.scale(self.radius),
        }
    }

    /// Returns the cosine of a wheel's lean, s; 1 for balls and knife edges.
    pub(super) fn cosine_of_lean(&self) -> E {
        self.cosine[0]
    }
}

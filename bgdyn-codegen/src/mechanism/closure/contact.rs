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
use crate::math::{Ring, Vec3};
use crate::mechanism::joint::{Column, DoubleDouble, PoseNumbers};
use crate::mechanism::{CoordinateId, Pose};

/// The functions of the numbers that the directions of a contact are computed with.
pub trait ContactNumbers<E>: PoseNumbers<E> {
    /// Returns 1 / x.
    fn inverse(&self, x: E) -> E;
    /// Returns the square root.
    fn root(&self, x: E) -> E;
    /// Returns the cosine of a wheel's lean; a wheel that lies flat may be refused.
    fn leaning(&self, cosine: E) -> E {
        cosine
    }
}

impl ContactNumbers<Dd> for DoubleDouble {
    fn inverse(&self, x: Dd) -> Dd {
        Dd::ONE / x
    }

    fn root(&self, x: Dd) -> Dd {
        x.sqrt()
    }
}

/// A row of a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactRow {
    /// The velocity of a knife edge along its direction, m/s.
    Edge,
    /// The velocity of a wheel's contact along the plane, across the axle, m/s.
    Longitudinal,
    /// The velocity of a wheel's contact along the plane, along the axle, m/s.
    Lateral,
    /// The velocity of a ball's contact along x or y of the plane, m/s.
    Slip(usize),
    /// The height of a wheel or a ball above its plane, m.
    Height,
}

/// What touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactShape {
    /// A knife edge, with the direction in which it does not slip, in the axes of place a.
    Edge(Vec3<Dd>),
    /// A thin disc, with its axle in the axes of place a.
    Disc(Vec3<Dd>),
    /// A sphere.
    Sphere,
}

/// A wheel, a ball or a knife edge. Place a is at its centre, on the link that carries its axle; place b is the plane,
/// with z along its normal.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaneContact {
    /// What touches.
    pub shape: ContactShape,
    /// Its place on its own link, with the axes of place a where the angle of the axle is zero.
    pub place: Pose,
    /// Radius, m; 0 for a knife edge.
    pub radius: Dd,
    /// The velocities of the joint at the axle, with their factors: rotation about the axle relative to place a.
    pub spin: Vec<(CoordinateId, Dd)>,
    /// Its rows, with their names.
    pub rows: Vec<(&'static str, ContactRow)>,
    /// The direction e from the contact to the centre, if it is constant in the axes of place a.
    pub upward: Option<Vec3<Dd>>,
}

/// In which directions a contact's rows are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactAxes {
    /// Along the plane and its normal.
    Plane,
    /// Along t, n and e of a wheel, which takes fewer operations; with the same solutions.
    Wheel,
    /// The three components of V in the axes of place a: the pivots of ċ are 1, however the wheel or ball turns.
    Link,
}

/// Rows of a knife edge.
pub const EDGE_ROWS: [(&str, ContactRow); 1] = [("slip", ContactRow::Edge)];

/// Rows of a wheel.
pub const DISC_ROWS: [(&str, ContactRow); 3] = [
    ("longitudinal", ContactRow::Longitudinal),
    ("lateral", ContactRow::Lateral),
    ("height", ContactRow::Height),
];

/// Rows of a ball.
pub const SPHERE_ROWS: [(&str, ContactRow); 3] = [
    ("x", ContactRow::Slip(0)),
    ("y", ContactRow::Slip(1)),
    ("height", ContactRow::Height),
];

/// The directions of a contact at one position, in the axes of place a.
pub struct ContactFrame<E> {
    /// n of a wheel, the direction of a knife edge; z of a ball.
    axle: Vec3<E>,
    /// z
    normal: Vec3<E>,
    /// e
    upward: Vec3<E>,
    /// t
    forward: Vec3<E>,
    /// s and 1 / s, the cosine of the lean
    cosine: [E; 2],
    /// n · z, the sine of the lean
    sine: E,
    /// Axes of the plane.
    plane: [Vec3<E>; 2],
    radius: E,
    zero: E,
    /// Whether e is constant.
    upright: bool,
    /// Whether it is that of a ball, for which e is z.
    ball: bool,
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
            ContactShape::Edge(_) => ContactAxes::Wheel,
            ContactShape::Disc(_)
                if all && lateral && kept(ContactRow::Longitudinal) && self.upward.is_none() =>
            {
                ContactAxes::Link
            }
            // Without the lateral row the one along e is not the rate of the height.
            ContactShape::Disc(_) if lateral => ContactAxes::Wheel,
            ContactShape::Sphere if all => ContactAxes::Link,
            ContactShape::Disc(_) | ContactShape::Sphere => ContactAxes::Plane,
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
            ContactShape::Sphere => normal,
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
        }
    }
}

impl<E: Ring> ContactFrame<E> {
    /// Returns the contact, from the centre: −r e.
    pub(super) fn contact(&self) -> Vec3<E> {
        -self.upward.scale(self.radius)
    }

    /// Returns the cosine of a wheel's lean, s; 1 for balls and knife edges.
    pub(super) fn cosine_of_lean(&self) -> E {
        self.cosine[0]
    }
}

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
            ContactRow::Height => height - frame.radius * frame.cosine[0],
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

//! What touches a plane, and its rows, as data.

use bgdyn_runtime::Dd;

use crate::math::Vec3;
use crate::mechanism::joint::{DoubleDouble, PoseNumbers};
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

impl PlaneContact {
    /// Returns its sizes, m: the radius, of a tyre with that of its sections; of an ellipsoid its half-axes.
    pub fn sizes(&self) -> Vec<f64> {
        let all = match self.shape {
            ContactShape::Ellipsoid(half_axes) => half_axes.to_vec(),
            _ if self.crown != Dd::ZERO => vec![self.radius, self.crown],
            _ => vec![self.radius],
        };
        all.iter().map(|x| x.to_f64()).collect()
    }
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

/// What touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactShape {
    /// A knife edge, with the direction in which it does not slip, in the axes of place a.
    Edge(Vec3<Dd>),
    /// A thin disc, with its axle in the axes of place a.
    Disc(Vec3<Dd>),
    /// A sphere.
    Sphere,
    /// An ellipsoid, with its half-axes along the axes of place a, m.
    Ellipsoid([Dd; 3]),
}

/// A wheel, a ball or a knife edge. Place a is at its centre, on the link that carries its axle; place b is the plane,
/// with z along its normal.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaneContact {
    /// What touches.
    pub shape: ContactShape,
    /// Its place on its own link, with the axes of place a where the angle of the axle is zero.
    pub place: Pose,
    /// Radius, m, of a tyre to the middles of its sections; 0 for a knife edge, the largest half-axis of an ellipsoid.
    pub radius: Dd,
    /// Radius of a tyre's sections, m; 0 for all others.
    pub crown: Dd,
    /// The velocities of the joint at the axle, with their factors: rotation about the axle relative to place a.
    pub spin: Vec<(CoordinateId, Dd)>,
    /// Its rows, with their names.
    pub rows: Vec<(&'static str, ContactRow)>,
    /// The direction e from the contact to the centre, if it is constant in the axes of place a.
    pub upward: Option<Vec3<Dd>>,
    /// The axes in which its rows are solved, if not those of [`PlaneContact::solved_in`].
    pub solved: Option<ContactAxes>,
}

//! Contacts of rounded bodies: an ellipsoid, and a tyre, which is a wheel with a rounded rim (a torus).
//!
//! z is the normal of the plane in the axes of place a, and ż its rate in these axes. From the centre, the lowest
//! point p and the height h of the centre above the plane:
//!
//! - ellipsoid with the half-axes a_k: p = −A z / h, h = √(z · A z), A = diag(a_k²); ṗ = −(A ż + ḣ p) / h with
//!   ḣ = −p · ż (Garcia and Hubbard 1988)
//! - tyre with the radius r of the circle through the middles of its sections, which have the radius ρ:
//!   p = −r e − ρ z, h = r s + ρ; ṗ = −r ė − ρ ż
//!
//! The material point at p has the velocity V = ċ + ω × p. Each row is d · V, with the direction d of its force.

use std::ops::Mul;

use bgdyn_runtime::Dd;

use super::contact_shape::{ContactNumbers, ContactShape, PlaneContact};
use crate::math::{Ring, Vec3};

/// The contact of a rounded body at one position, in the axes of place a.
pub(super) struct RoundContact<E> {
    /// p, m.
    pub(super) arm: Vec3<E>,
    /// h, m.
    pub(super) height: E,
    surface: Surface<E>,
}

enum Surface<E> {
    /// a_k² and 1 / h.
    Ellipsoid(Vec3<E>, E),
    /// r and ρ.
    Tyre(E, E),
}

impl<E: Ring + Mul<Dd, Output = E>> RoundContact<E> {
    /// Returns the contact of an ellipsoid or a tyre; `None` for other shapes. `cosine` is s.
    pub(super) fn new(
        contact: &PlaneContact,
        (normal, upward, cosine): (Vec3<E>, Vec3<E>, E),
        numbers: &impl ContactNumbers<E>,
    ) -> Option<Self> {
        match contact.shape {
            ContactShape::Ellipsoid(half_axes) => {
                let squares = Vec3(half_axes.map(|a| numbers.constant(a * a)));
                let stretched = scaled(squares, normal);
                let height = numbers.root(normal.dot(stretched));
                let inverse = numbers.inverse(height);
                Some(RoundContact {
                    arm: -stretched.scale(inverse),
                    height,
                    surface: Surface::Ellipsoid(squares, inverse),
                })
            }
            ContactShape::Disc(_) if contact.crown != Dd::ZERO => {
                let (radius, crown) = (
                    numbers.constant(contact.radius),
                    numbers.constant(contact.crown),
                );
                Some(RoundContact {
                    arm: -(upward.scale(radius) + normal.scale(crown)),
                    height: radius * cosine + crown,
                    surface: Surface::Tyre(radius, crown),
                })
            }
            _ => None,
        }
    }

    /// Returns ṗ from ż and ė.
    pub(super) fn arm_rate(&self, normal_rate: Vec3<E>, upward_rate: Vec3<E>) -> Vec3<E> {
        match &self.surface {
            Surface::Ellipsoid(squares, inverse) => {
                let height_rate = -self.arm.dot(normal_rate);
                let stretched = scaled(*squares, normal_rate);
                -(stretched + self.arm.scale(height_rate)).scale(*inverse)
            }
            Surface::Tyre(radius, crown) => {
                -(upward_rate.scale(*radius) + normal_rate.scale(*crown))
            }
        }
    }
}

fn scaled<E: Ring>(by: Vec3<E>, v: Vec3<E>) -> Vec3<E> {
    Vec3(std::array::from_fn(|k| by.0[k] * v.0[k]))
}

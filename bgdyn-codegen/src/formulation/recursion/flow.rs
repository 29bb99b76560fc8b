//! How the mass beyond a joint moves relative to a body, as far as derivatives need it.

use bgdyn_runtime::Dd;

use super::inertia::{Inertia, turn};
use crate::expr::{Builder, Ex};
use crate::math::{Mat3, Vec3};
use crate::mechanism::Motion;

/// First moments of velocity: with Q = ∫ v sᵀ dm about a point, E = tr(Q)·1 − Q and p = ∫ v dm.
/// The velocities v are relative to a body with its axes, and may be scaled by a factor.
#[derive(Clone, Copy)]
pub(super) struct Flow<'g> {
    /// E
    pub moment: Mat3<Ex<'g>>,
    /// p
    pub linear: Vec3<Ex<'g>>,
}

impl<'g> Flow<'g> {
    /// Of nothing.
    pub fn zero(b: &'g Builder) -> Self {
        Flow {
            moment: Mat3([[b.zero(); 3]; 3]),
            linear: Vec3([b.zero(); 3]),
        }
    }

    /// Of both.
    pub fn plus(&self, other: &Self) -> Self {
        Flow {
            moment: self.moment + other.moment,
            linear: self.linear + other.linear,
        }
    }

    /// Of mass that moves at a joint's `rate` along or about z.
    pub fn of_joint(b: &'g Builder, motion: Motion, rate: Ex<'g>, inertia: &Inertia<'g>) -> Self {
        let d = |i, j| rate * inertia.d(i, j);
        let [x, y, z] = inertia.first.map(|h| rate * h).0;
        let zero = b.zero();
        match motion {
            Motion::Rotation => Flow {
                moment: Mat3([
                    [d(0, 1), d(1, 1), d(1, 2)],
                    [-d(0, 0), -d(0, 1), -d(0, 2)],
                    [zero; 3],
                ]),
                linear: Vec3([-y, x, zero]),
            },
            _ => Flow {
                moment: Mat3([[z, zero, zero], [zero, z, zero], [-x, -y, zero]]),
                linear: Vec3([zero, zero, rate * inertia.axial]),
            },
        }
    }

    /// The same seen from a point from which this one's origin is displaced by r:
    /// E + (p·r)·1 − p rᵀ.
    pub fn shifted(&self, r: Vec3<Ex<'g>>) -> Self {
        let products = Mat3::from_fn(|i, j| self.linear.0[i] * r.0[j]);
        let entry = |i: usize, j: usize| {
            if i == j {
                let (k, l) = ((i + 1) % 3, (i + 2) % 3);
                self.moment.0[i][i] + (products.0[k][k] + products.0[l][l])
            } else {
                self.moment.0[i][j] - products.0[i][j]
            }
        };
        Flow {
            moment: Mat3::from_fn(entry),
            linear: self.linear,
        }
    }

    /// In axes in which the present ones have the columns of the constant `r`: R E Rᵀ, R p.
    pub fn rotated(&self, b: &'g Builder, r: Mat3<Dd>) -> Self {
        let r = r.map(|x| b.constant(x));
        Flow {
            moment: r * self.moment * r.transpose(),
            linear: r * self.linear,
        }
    }

    /// Turned by Rz: four multiplications for the 2 × 2 block, with
    /// e = s (E_xx − E_yy) + c (E_xy + E_yx).
    pub fn turned(&self, (c, s): (Ex<'g>, Ex<'g>)) -> Self {
        let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = self.moment.0;
        let e = s * (xx - yy) + c * (xy + yx);
        let (se, ce) = (s * e, c * e);
        Flow {
            moment: Mat3([
                [xx - se, ce - yx, c * xz - s * yz],
                [ce - xy, yy + se, s * xz + c * yz],
                [c * zx - s * zy, s * zx + c * zy, zz],
            ]),
            linear: turn(self.linear, (c, s)),
        }
    }
}

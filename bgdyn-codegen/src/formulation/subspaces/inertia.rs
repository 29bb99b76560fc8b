//! Mass, first moment and pseudo-inertia of a body.
//!
//! D = ∫ s sᵀ dm about the origin; the tensor is J = tr(D)·1 − D, and D = ½ tr(J)·1 − J.

use bgdyn_runtime::Dd;

use crate::expr::{Builder, Expr};
use crate::formulation::arguments::value;
use crate::math::{Mat3, Vec3};
use crate::mechanism::{Inertial, Pose};

/// The inertia of a body about its origin, in its own axes.
#[derive(Clone, Copy)]
pub(super) struct Inertia<'g> {
    /// m, kg
    pub(super) mass: Expr<'g>,
    /// ∫ s dm, kg·m
    pub(super) first: Vec3<Expr<'g>>,
    /// D, kg·m²; symmetric
    pub(super) pseudo: Mat3<Expr<'g>>,
}

impl<'g> Inertia<'g> {
    pub(super) fn zero(b: &'g Builder) -> Self {
        Inertia {
            mass: b.zero(),
            first: Vec3([b.zero(); 3]),
            pseudo: Mat3([[b.zero(); 3]; 3]),
        }
    }

    /// Returns the inertia of a link whose axes have this pose in the body's axes.
    pub(super) fn of_link(b: &'g Builder, inertial: &Inertial, pose: &Pose) -> Self {
        let [xx, yy, zz, xy, xz, yz] = inertial.inertia.entries.map(|x| value(b, x));
        let half = (xx + yy + zz) * Dd::from_f64(0.5);
        let pseudo = Mat3([
            [half - xx, -xy, -xz],
            [-xy, half - yy, -yz],
            [-xz, -yz, half - zz],
        ]);
        let about_com = Inertia {
            mass: value(b, inertial.mass),
            first: Vec3([b.zero(); 3]),
            pseudo: rotated(inertial.inertia.axes.map(|x| b.constant(x)), pseudo),
        };
        let com = inertial.com.map(|x| value(b, x));
        let rotation = pose.rotation.map(|x| b.constant(x));
        about_com
            .shifted(com)
            .turned(rotation)
            .shifted(b.vector(pose.translation))
    }

    /// Returns the inertia about a point from which the origin is displaced by p:
    /// D + p hᵀ + h pᵀ + m p pᵀ.
    pub(super) fn shifted(self, p: Vec3<Expr<'g>>) -> Self {
        let h = self.first;
        let twice = h.map(|x| x * Dd::from_f64(2.0)) + p.scale(self.mass);
        let whole = h + p.scale(self.mass);
        let entry = |i: usize, j: usize| {
            let d = self.pseudo.0[i][j];
            match i == j {
                true => d + p.0[i] * twice.0[i],
                false => d + p.0[i] * h.0[j] + whole.0[i] * p.0[j],
            }
        };
        Inertia {
            mass: self.mass,
            first: whole,
            pseudo: symmetric(entry),
        }
    }

    /// Returns the inertia in axes in which the present axes have this rotation.
    pub(super) fn turned(self, rotation: Mat3<Expr<'g>>) -> Self {
        Inertia {
            mass: self.mass,
            first: rotation * self.first,
            pseudo: rotated(rotation, self.pseudo),
        }
    }

    pub(super) fn plus(self, other: Self) -> Self {
        Inertia {
            mass: self.mass + other.mass,
            first: self.first + other.first,
            pseudo: self.pseudo + other.pseudo,
        }
    }

    /// Returns J s = tr(D) s − D s.
    pub(super) fn tensor_times(&self, s: Vec3<Expr<'g>>) -> Vec3<Expr<'g>> {
        let d = self.pseudo.0;
        let [x, y, z] = s.0;
        Vec3([
            (d[1][1] + d[2][2]) * x - d[0][1] * y - d[0][2] * z,
            (d[0][0] + d[2][2]) * y - d[0][1] * x - d[1][2] * z,
            (d[0][0] + d[1][1]) * z - d[0][2] * x - d[1][2] * y,
        ])
    }
}

/// Returns R D Rᵀ.
fn rotated<'g>(r: Mat3<Expr<'g>>, d: Mat3<Expr<'g>>) -> Mat3<Expr<'g>> {
    let half = r * d;
    symmetric(|i, j| half.row(i).dot(r.row(j)))
}

/// Returns a symmetric matrix from its upper triangle.
fn symmetric<'g>(entry: impl Fn(usize, usize) -> Expr<'g>) -> Mat3<Expr<'g>> {
    let (xx, yy, zz) = (entry(0, 0), entry(1, 1), entry(2, 2));
    let (xy, xz, yz) = (entry(0, 1), entry(0, 2), entry(1, 2));
    Mat3([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
}

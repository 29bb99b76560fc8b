//! The inertia of an articulated body.
//!
//! It is the symmetric 6 × 6 matrix that maps the acceleration of a body to the required wrench, with the joints
//! outboard of it free to move.
//!
//! About the body's origin: moment n = J α + H a, force F = Hᵀ α + M a for the angular acceleration α and
//! the acceleration a of the origin.

use bgdyn_runtime::Dd;

use crate::expr::{Builder, Expr};
use crate::formulation::recursion::inertia::BodyInertia;
use crate::formulation::recursion::inverse_dynamics::BodyWrench;
use crate::formulation::recursion::joint_columns::ColumnDirection;
use crate::formulation::recursion::names::name_matrix;
use crate::formulation::recursion::rotation::Rotation;
use crate::math::{Mat3, Vec3};

/// Articulated-body inertia about one point, in one set of axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArticulatedInertia<'g> {
    /// J, symmetric.
    angular: Mat3<Expr<'g>>,
    /// H: moment of a unit acceleration.
    coupling: Mat3<Expr<'g>>,
    /// M, symmetric.
    linear: Mat3<Expr<'g>>,
}

/// The wrench of a unit acceleration of the joint, and its ratio to the pivot.
#[derive(Clone, Copy)]
pub(super) struct InertiaColumn<'g> {
    /// Wrench of a unit acceleration along the joint.
    pub wrench: BodyWrench<'g>,
    /// The same divided by the pivot.
    pub share: BodyWrench<'g>,
    /// One over the pivot: the component along the joint, plus the armature.
    pub inverse: Expr<'g>,
    /// The fraction of the inertia along the joint that acts on the parent: armature / (component along +
    /// armature); zero for a joint without a rotor.
    kept: Expr<'g>,
}

impl<'g> InertiaColumn<'g> {
    /// Applies `f`, a change of axes.
    pub fn map(&self, f: impl Fn(Vec3<Expr<'g>>) -> Vec3<Expr<'g>>) -> Self {
        InertiaColumn {
            wrench: self.wrench.map(&f),
            share: self.share.map(&f),
            ..*self
        }
    }
}

impl<'g> ArticulatedInertia<'g> {
    /// Returns zero.
    pub fn zero(b: &'g Builder) -> Self {
        let zero = Mat3([[b.zero(); 3]; 3]);
        ArticulatedInertia {
            angular: zero,
            coupling: zero,
            linear: zero,
        }
    }

    /// Returns the inertia of a rigid body: J = tr(D)·1 − D, H = [h]×, M = m·1.
    pub fn rigid(b: &'g Builder, inertia: &BodyInertia<'g>) -> Self {
        let [xx, yy, zz, xy, xz, yz] = inertia.pseudo;
        let ([x, y, z], o) = (inertia.first.0, b.zero());
        ArticulatedInertia {
            angular: Mat3([
                [yy + zz, -xy, -xz],
                [-xy, zz + xx, -yz],
                [-xz, -yz, xx + yy],
            ]),
            coupling: Mat3([[o, -z, y], [z, o, -x], [-y, x, o]]),
            linear: Mat3([
                [inertia.mass, o, o],
                [o, inertia.mass, o],
                [o, o, inertia.axial],
            ]),
        }
    }

    /// Returns the sum.
    pub fn plus(&self, other: &Self) -> Self {
        ArticulatedInertia {
            angular: self.angular + other.angular,
            coupling: self.coupling + other.coupling,
            linear: self.linear + other.linear,
        }
    }

    /// Names its entries.
    pub fn name(&self, owner: &str) {
        name_matrix(&self.angular, "ia", owner);
        name_matrix(&self.coupling, "ha", owner);
        name_matrix(&self.linear, "ma", owner);
    }

    /// Returns whether it is zero.
    pub fn is_zero(&self) -> bool {
        [self.angular, self.coupling, self.linear]
            .iter()
            .all(|m| m.0.iter().flatten().all(|e| e.is_zero()))
    }

    /// Returns the component in a direction: sᵀ I s.
    pub fn along(&self, direction: ColumnDirection) -> Expr<'g> {
        match direction {
            ColumnDirection::About(k) => self.angular.0[k][k],
            ColumnDirection::Along(k) => self.linear.0[k][k],
            ColumnDirection::Screw(_) => {
                let wrench = self.wrench(direction);
                direction.component(wrench.moment, wrench.force)
            }
        }
    }

    /// Returns I s, the wrench of a unit acceleration in a direction.
    fn wrench(&self, direction: ColumnDirection) -> BodyWrench<'g> {
        let about = |k: usize| BodyWrench {
            moment: self.angular.row(k),
            force: self.coupling.row(k),
        };
        let along = |k: usize| BodyWrench {
            moment: self.coupling.column(k),
            force: self.linear.row(k),
        };
        match direction {
            ColumnDirection::About(k) => about(k),
            ColumnDirection::Along(k) => along(k),
            ColumnDirection::Screw(pitch) => about(2).plus(along(2).map(|v| v.map(|x| x * pitch))),
        }
    }

    /// Returns I S, the wrench of a unit acceleration along the joint, and I S / `pivot`. The pivot is the
    /// component along the joint plus the `armature`, the inertia that only the joint's own rate moves.
    pub fn column(
        &self,
        b: &'g Builder,
        direction: ColumnDirection,
        pivot: Expr<'g>,
        armature: Expr<'g>,
    ) -> InertiaColumn<'g> {
        let wrench = self.wrench(direction);
        let inverse = b.constant(Dd::ONE) / pivot;
        let along = self.along(direction);
        // An entry equal to the pivot has a ratio of exactly one.
        let free = armature.is_zero();
        let share = |x: Expr<'g>| {
            if !free {
                x * inverse
            } else if x == along {
                b.number(1.0)
            } else if x == -along {
                b.number(-1.0)
            } else {
                x * inverse
            }
        };
        InertiaColumn {
            wrench,
            share: wrench.map(|v| v.map(share)),
            inverse,
            kept: if free { b.zero() } else { armature * inverse },
        }
    }

    /// Returns I − I S (SᵀI S + A)⁻¹ SᵀI with the armature A. The row and the column along the joint are
    /// multiplied by A/(SᵀI S + A): without a rotor they are set to zero exactly.
    pub fn projected(
        &self,
        b: &'g Builder,
        direction: ColumnDirection,
        column: &InertiaColumn<'g>,
    ) -> Self {
        let InertiaColumn {
            wrench,
            share,
            kept,
            ..
        } = column;
        let (angular, linear) = match direction {
            ColumnDirection::About(k) => (Some(k), None),
            ColumnDirection::Along(k) => (None, Some(k)),
            ColumnDirection::Screw(_) => (None, None),
        };
        let less = |m: &Mat3<Expr<'g>>,
                    row: (Vec3<Expr<'g>>, Option<usize>),
                    column: (Vec3<Expr<'g>>, Option<usize>)| {
            Mat3::from_fn(|i, j| {
                if row.1 == Some(i) || column.1 == Some(j) {
                    if kept.is_zero() {
                        b.zero()
                    } else {
                        m.0[i][j] * *kept
                    }
                } else {
                    m.0[i][j] - row.0.0[i] * column.0.0[j]
                }
            })
        };
        let (moment, force) = ((wrench.moment, angular), (wrench.force, linear));
        let share = ((share.moment, angular), (share.force, linear));
        ArticulatedInertia {
            angular: mirrored(less(&self.angular, share.0, moment)),
            coupling: less(&self.coupling, share.0, force),
            linear: mirrored(less(&self.linear, share.1, force)),
        }
    }

    /// Returns the inertia rotated.
    pub fn turned(&self, turn: Rotation<'g>, careful: bool) -> Self {
        let turn = match turn {
            Rotation::AboutZ(angle) => angle,
            Rotation::General(r) => return self.rotated(r),
        };
        ArticulatedInertia {
            angular: mirrored(turned(&self.angular, 2, turn, careful)),
            coupling: turned(&self.coupling, 2, turn, careful),
            linear: mirrored(turned(&self.linear, 2, turn, careful)),
        }
    }

    /// Returns the inertia in axes in which the present axes have the columns of the constant `r`: a twist,
    /// a rotation about x followed by one about z, or any rotation.
    pub fn twisted(&self, b: &'g Builder, r: Mat3<Dd>, careful: bool) -> Self {
        if r.0[2][0] != Dd::ZERO {
            return self.rotated(r.map(|x| b.constant(x)));
        }
        let [about_x, about_z] = [(r.0[2][2], r.0[2][1]), (r.0[0][0], r.0[1][0])];
        self.turned_by(b, 0, about_x, careful)
            .turned_by(b, 2, about_z, careful)
    }

    /// Returns the inertia in axes in which the present axes have the columns of `r`.
    fn rotated(&self, r: Mat3<Expr<'g>>) -> Self {
        let turned = |m: &Mat3<Expr<'g>>| (r * *m) * r.transpose();
        ArticulatedInertia {
            angular: mirrored(turned(&self.angular)),
            coupling: turned(&self.coupling),
            linear: mirrored(turned(&self.linear)),
        }
    }

    /// Rotates about an axis by a constant angle; quarter turns need no operations.
    fn turned_by(&self, b: &'g Builder, axis: usize, (c, s): (Dd, Dd), careful: bool) -> Self {
        let careful = careful || c == Dd::ZERO || s == Dd::ZERO;
        let turn = (b.constant(c), b.constant(s));
        let turned = |m: &Mat3<Expr<'g>>| turned(m, axis, turn, careful);
        ArticulatedInertia {
            angular: mirrored(turned(&self.angular)),
            coupling: turned(&self.coupling),
            linear: mirrored(turned(&self.linear)),
        }
    }

    /// Returns the inertia about a point from which the present origin is displaced by p:
    /// H' = H + [p]× M, J' = J − H [p]× + [p]× H'ᵀ.
    pub fn shifted(&self, b: &'g Builder, p: Vec3<Expr<'g>>) -> Self {
        let [x, y, z] = p.0;
        let o = b.zero();
        let cross = Mat3([[o, -z, y], [z, o, -x], [-y, x, o]]);
        let coupling = self.coupling + cross * self.linear;
        let angular = (self.angular - self.coupling * cross) + cross * coupling.transpose();
        ArticulatedInertia {
            angular: mirrored(angular),
            coupling,
            linear: self.linear,
        }
    }
}

/// Returns the symmetric matrix with this upper triangle.
fn mirrored<'g>(m: Mat3<Expr<'g>>) -> Mat3<Expr<'g>> {
    Mat3::from_fn(|i, j| m.0[i.min(j)][i.max(j)])
}

/// Returns R m Rᵀ for a rotation about an axis k, where i and j are the axes after it. The 2 × 2 block
/// uses e = s (m_ii − m_jj) + c (m_ij + m_ji), or two products, which need more operations but subtract no
/// large terms if one of the entries is zero.
fn turned<'g>(
    m: &Mat3<Expr<'g>>,
    k: usize,
    (c, s): (Expr<'g>, Expr<'g>),
    careful: bool,
) -> Mat3<Expr<'g>> {
    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
    let [[ii, ij], [ji, jj]] = [[m.0[i][i], m.0[i][j]], [m.0[j][i], m.0[j][j]]];
    let mut to = *m;
    if careful && !(ii == jj && (ij + ji).is_zero()) {
        let [[p, q], [r, t]] = [
            [c * ii - s * ji, c * ij - s * jj],
            [s * ii + c * ji, s * ij + c * jj],
        ];
        (to.0[i][i], to.0[i][j]) = (p * c - q * s, p * s + q * c);
        (to.0[j][i], to.0[j][j]) = (r * c - t * s, r * s + t * c);
    } else {
        // 2 c is the same for every symmetric block of the body.
        let across = if ij == ji {
            (c * Dd::from_f64(2.0)) * ij
        } else {
            c * (ij + ji)
        };
        let e = s * (ii - jj) + across;
        let (se, ce) = (s * e, c * e);
        (to.0[i][i], to.0[i][j]) = (ii - se, ce - ji);
        (to.0[j][i], to.0[j][j]) = (ce - ij, jj + se);
    }
    let turn = |x: Expr<'g>, y: Expr<'g>| (c * x - s * y, s * x + c * y);
    (to.0[i][k], to.0[j][k]) = turn(m.0[i][k], m.0[j][k]);
    (to.0[k][i], to.0[k][j]) = turn(m.0[k][i], m.0[k][j]);
    to
}

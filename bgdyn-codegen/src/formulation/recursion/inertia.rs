//! Inertia of a body as mass, first moment and pseudo-inertia D = ∫ s sᵀ dm about its origin.
//!
//! J = tr(D)·1 − D, D = ½ tr(J)·1 − J. Entries are expressions, so that constants fold and run-time
//! parameters use the same equations.

use bgdyn_runtime::Dd;

use super::rotation::Rotation;
use crate::expr::{Builder, Expr};
use crate::math::{Mat3, Vec3};

/// A symmetric matrix: xx, yy, zz, xy, xz, yz.
pub(super) type Symmetric<'g> = [Expr<'g>; 6];

/// Index of entry (i, j) in a [`Symmetric`].
const PLACE: [[usize; 3]; 3] = [[0, 3, 4], [3, 1, 5], [4, 5, 2]];

/// Mass, first moment and pseudo-inertia about one point, in one set of axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct BodyInertia<'g> {
    /// m, kg
    pub mass: Expr<'g>,
    /// The mass for motion along z, kg: equal to `mass`, except if a planar body's mass was moved to its
    /// parent and only its mass along the axis remains.
    pub axial: Expr<'g>,
    /// ∫ s dm, kg·m
    pub first: Vec3<Expr<'g>>,
    /// D = ∫ s sᵀ dm, kg·m²
    pub pseudo: Symmetric<'g>,
}

/// A point mass.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point<'g> {
    /// m, kg
    pub mass: Expr<'g>,
    /// s, m
    pub position: Vec3<Expr<'g>>,
}

impl<'g> Point<'g> {
    /// Returns whether everything is known at generation time.
    pub fn is_constant(&self) -> bool {
        let mut entries = self.position.0.iter().chain([&self.mass]);
        entries.all(|e| e.as_constant().is_some())
    }

    /// Returns it rotated.
    pub fn turned(&self, turn: Rotation<'g>) -> Self {
        Point {
            position: turn.apply(self.position),
            ..*self
        }
    }

    /// Converts to units of `length`; moments do not change.
    pub fn in_units_of(&self, length: Dd) -> Self {
        Point {
            mass: self.mass * (length * length),
            position: self.position.map(|s| s * (Dd::ONE / length)),
        }
    }
}

impl<'g> BodyInertia<'g> {
    /// Returns zero.
    pub fn zero(b: &'g Builder) -> Self {
        let zero = b.zero();
        BodyInertia {
            mass: zero,
            axial: zero,
            first: Vec3([zero; 3]),
            pseudo: [zero; 6],
        }
    }

    /// Returns the inertia of a point mass.
    pub fn of_point(b: &'g Builder, point: &Point<'g>) -> Self {
        BodyInertia {
            mass: point.mass,
            axial: point.mass,
            ..BodyInertia::zero(b)
        }
        .shifted(point.position)
    }

    /// Returns the inertia about the centre of mass, without the mass, from the tensor J about it.
    pub fn of_tensor(b: &'g Builder, tensor: Symmetric<'g>) -> Self {
        let [xx, yy, zz, xy, xz, yz] = tensor;
        let half = Dd::from_f64(0.5);
        let diagonal = |a: Expr<'g>, b: Expr<'g>, c: Expr<'g>| (a + b - c) * half;
        let pseudo = [
            diagonal(yy, zz, xx),
            diagonal(zz, xx, yy),
            diagonal(xx, yy, zz),
            -xy,
            -xz,
            -yz,
        ];
        BodyInertia {
            pseudo,
            ..BodyInertia::zero(b)
        }
    }

    /// Returns entry (i, j) of D.
    pub fn d(&self, i: usize, j: usize) -> Expr<'g> {
        self.pseudo[PLACE[i][j]]
    }

    /// Returns the inertia about a point from which the present origin is displaced by p:
    /// D + p hᵀ + h pᵀ + m p pᵀ.
    pub fn shifted(&self, p: Vec3<Expr<'g>>) -> Self {
        let h = self.first;
        let pseudo = symmetric(|i, j| {
            let (pi, pj) = (p.0[i], p.0[j]);
            let moments = if i == j {
                (pi * Dd::from_f64(2.0)) * h.0[i]
            } else {
                pi * h.0[j] + pj * h.0[i]
            };
            self.d(i, j) + moments + self.mass * pi * pj
        });
        BodyInertia {
            first: h + self.weigh(p),
            pseudo,
            ..*self
        }
    }

    /// Returns it in axes in which the present axes have the columns of the constant `r`: R D Rᵀ.
    pub fn rotated(&self, b: &'g Builder, r: Mat3<Dd>) -> Self {
        let r = r.map(|x| b.constant(x));
        let half =
            Mat3::from_fn(|i, j| (0..3).fold(b.zero(), |sum, k| sum + r.0[i][k] * self.d(k, j)));
        let pseudo =
            symmetric(|i, j| (0..3).fold(b.zero(), |sum, k| sum + half.0[i][k] * r.0[j][k]));
        BodyInertia {
            first: r * self.first,
            pseudo,
            ..*self
        }
    }

    /// Returns it rotated. A rotation about z does not change a round body.
    pub fn turned(&self, turn: Rotation<'g>) -> Self {
        match turn {
            Rotation::AboutZ(_) if self.round() => *self,
            Rotation::AboutZ(angle) => self.turned_about_z(angle),
            Rotation::General(r) => self.turned_by(r),
        }
    }

    /// Returns it rotated by R, from R J and (R J) Rᵀ with J = tr(D)·1 − D: the columns of R J are also the
    /// angular momenta of unit rates about the body's own axes.
    fn turned_by(&self, r: Mat3<Expr<'g>>) -> Self {
        let [xx, yy, zz, ..] = self.pseudo;
        let trace = xx + yy + zz;
        let half = r * self.tensor();
        let turned = symmetric(|i, j| half.row(i).dot(r.row(j)));
        let [jxx, jyy, jzz, jxy, jxz, jyz] = turned;
        BodyInertia {
            first: r * self.first,
            pseudo: [trace - jxx, trace - jyy, trace - jzz, -jxy, -jxz, -jyz],
            ..*self
        }
    }

    /// Returns J = tr(D)·1 − D.
    pub fn tensor(&self) -> Mat3<Expr<'g>> {
        let [xx, yy, zz, xy, xz, yz] = self.pseudo;
        Mat3([
            [yy + zz, -xy, -xz],
            [-xy, zz + xx, -yz],
            [-xz, -yz, xx + yy],
        ])
    }

    /// Returns it rotated by Rz: four multiplications for the 2 × 2 block, with e = s (D_xx − D_yy) + 2 c
    /// D_xy.
    fn turned_about_z(&self, (c, s): (Expr<'g>, Expr<'g>)) -> Self {
        let [xx, yy, zz, xy, xz, yz] = self.pseudo;
        let e = s * (xx - yy) + c * (xy * Dd::from_f64(2.0));
        let (se, ce) = (s * e, c * e);
        let pseudo = [
            xx - se,
            yy + se,
            zz,
            ce - xy,
            c * xz - s * yz,
            s * xz + c * yz,
        ];
        BodyInertia {
            first: Rotation::AboutZ((c, s)).apply(self.first),
            pseudo,
            ..*self
        }
    }

    /// Returns m v, with the axial mass along z.
    pub fn weigh(&self, v: Vec3<Expr<'g>>) -> Vec3<Expr<'g>> {
        let [x, y, z] = v.0;
        Vec3([x * self.mass, y * self.mass, z * self.axial])
    }

    /// Returns the sum.
    pub fn plus(&self, other: &Self) -> Self {
        BodyInertia {
            mass: self.mass + other.mass,
            axial: self.axial + other.axial,
            first: self.first + other.first,
            pseudo: std::array::from_fn(|k| self.pseudo[k] + other.pseudo[k]),
        }
    }

    /// Applies `f` to each entry.
    fn map(&self, f: impl Fn(Expr<'g>) -> Expr<'g>) -> Self {
        BodyInertia {
            mass: f(self.mass),
            axial: f(self.axial),
            first: self.first.map(&f),
            pseudo: self.pseudo.map(&f),
        }
    }

    /// Returns mass, axial mass, first moment and D.
    pub fn entries(&self) -> [Expr<'g>; 11] {
        let [hx, hy, hz] = self.first.0;
        let [xx, yy, zz, xy, xz, yz] = self.pseudo;
        [self.mass, self.axial, hx, hy, hz, xx, yy, zz, xy, xz, yz]
    }

    /// Returns [`BodyInertia::entries`], if all are known at generation time.
    pub fn numbers(&self) -> Option<[Dd; 11]> {
        let mut numbers = [Dd::ZERO; 11];
        for (number, entry) in numbers.iter_mut().zip(self.entries()) {
            *number = entry.as_constant()?;
        }
        Some(numbers)
    }

    /// Inverse of [`BodyInertia::numbers`].
    pub fn of_numbers(b: &'g Builder, numbers: &[Dd; 11]) -> Self {
        let [mass, axial, hx, hy, hz, pseudo @ ..] = numbers.map(|x| b.constant(x));
        BodyInertia {
            mass,
            axial,
            first: Vec3([hx, hy, hz]),
            pseudo,
        }
    }

    /// Splits the entries into those known at generation time, and the others if there are any; missing
    /// entries are 0.
    pub fn split(&self, b: &'g Builder) -> (Self, Option<Self>) {
        let known = |e: Expr<'g>| e.as_constant().is_some();
        let constant = self.map(|e| if known(e) { e } else { b.zero() });
        let varying = self.map(|e| if known(e) { b.zero() } else { e });
        (constant, (!self.is_constant()).then_some(varying))
    }

    /// Returns whether every entry is known at generation time.
    pub fn is_constant(&self) -> bool {
        let entries = self.first.0.iter().chain(&self.pseudo);
        let mut entries = entries.chain([&self.mass, &self.axial]);
        entries.all(|e| e.as_constant().is_some())
    }

    /// Returns whether it is zero.
    pub fn is_zero(&self) -> bool {
        let entries = self.first.0.iter().chain(&self.pseudo);
        let mut entries = entries.chain([&self.mass, &self.axial]);
        entries.all(|e| e.is_zero())
    }

    /// Returns whether a rotation about z does not change it.
    pub fn round(&self) -> bool {
        let [xx, yy, _, xy, xz, yz] = self.pseudo;
        let zero = [xx - yy, xy, xz, yz, self.first.0[0], self.first.0[1]];
        zero.into_iter().all(Expr::is_zero)
    }

    /// Converts to units of `length`; moments do not change.
    pub fn in_units_of(&self, length: Dd) -> Self {
        BodyInertia {
            mass: self.mass * (length * length),
            axial: self.axial * (length * length),
            first: self.first.map(|h| h * length),
            pseudo: self.pseudo,
        }
    }
}

/// Returns the upper triangle from `f(i, j)`.
fn symmetric<'g>(f: impl Fn(usize, usize) -> Expr<'g>) -> Symmetric<'g> {
    [f(0, 0), f(1, 1), f(2, 2), f(0, 1), f(0, 2), f(1, 2)]
}

//! The wrenches of the parameters of a body: what a one in the place of a parameter needs.
//!
//! A body needs F = m a + U h and N = h × a + skew(U D): the columns are entries of U and of a. They are in the order
//! of [`super::super::inertia::BodyInertia::entries`]: m, axial m, h, D_xx, D_yy, D_zz, D_xy, D_xz, D_yz.

use bgdyn_runtime::Dd;

use super::super::inverse_dynamics::BodyWrench;
use super::super::motion::{Spin, zero};
use super::directions::BodyTwist;
use crate::expr::{Builder, Expr};
use crate::math::{Mat3, Vec3, skew};

/// Number of entries of a body's inertia.
pub(super) const ENTRIES: usize = 11;

/// The angular motion that wrenches depend on.
pub(super) struct Angular<'g> {
    /// U = [ω̇]× + [ω]×[ω]×.
    pub u: Mat3<Expr<'g>>,
    /// U_zz − U_yy, U_xx − U_zz, U_yy − U_xx.
    pub differences: Vec3<Expr<'g>>,
    /// ω̇.
    pub omega_dot: Vec3<Expr<'g>>,
    /// ω_y ω_z, ω_x ω_z, ω_x ω_y.
    pub products: Vec3<Expr<'g>>,
}

impl<'g> From<&Spin<'g>> for Angular<'g> {
    fn from(spin: &Spin<'g>) -> Self {
        let [x, y, z] = spin.omega.0;
        Angular {
            u: spin.u,
            differences: spin.differences,
            omega_dot: spin.omega_dot,
            products: Vec3([y * z, x * z, x * y]),
        }
    }
}

impl<'g> Angular<'g> {
    /// Returns that of momenta: [ω]× in place of U.
    pub fn of_momentum(b: &'g Builder, omega: Vec3<Expr<'g>>) -> Self {
        Angular {
            u: skew(omega, b.zero()),
            differences: zero(b),
            omega_dot: omega,
            products: zero(b),
        }
    }
}

/// Returns the wrenches of the entries of a body's inertia.
pub(super) fn of_entries<'g>(
    b: &'g Builder,
    angular: &Angular<'g>,
    a: Vec3<Expr<'g>>,
) -> [BodyWrench<'g>; ENTRIES] {
    let o = b.zero();
    let u = &angular.u.0;
    let [dzy, dxz, dyx] = angular.differences.0;
    let [ax, ay, az] = a.0;
    let force = |x, y, z| BodyWrench {
        force: Vec3([x, y, z]),
        moment: zero(b),
    };
    let first = |k: usize, moment| BodyWrench {
        force: angular.u.column(k),
        moment: Vec3(moment),
    };
    let moment = |x, y, z| BodyWrench {
        force: zero(b),
        moment: Vec3([x, y, z]),
    };
    [
        force(ax, ay, o),
        force(o, o, az),
        first(0, [o, -az, ay]),
        first(1, [az, o, -ax]),
        first(2, [-ay, ax, o]),
        moment(o, -u[2][0], u[1][0]),
        moment(u[2][1], o, -u[0][1]),
        moment(-u[1][2], u[0][2], o),
        moment(u[2][0], -u[2][1], dyx),
        moment(-u[1][0], dxz, u[1][2]),
        moment(dzy, u[0][1], -u[0][2]),
    ]
}

/// Returns the wrenches of m, h, I_xx, I_xy, I_yy, I_xz, I_yz, I_zz in the axes of the body: N = I ω̇ + ω × I ω.
pub(super) fn of_parameters<'g>(
    b: &'g Builder,
    angular: &Angular<'g>,
    a: Vec3<Expr<'g>>,
) -> [BodyWrench<'g>; 10] {
    let entries = of_entries(b, angular, a);
    let [dx, dy, dz] = angular.omega_dot.0;
    let [yz, xz, xy] = angular.products.0;
    let moment = |x, y, z| BodyWrench {
        force: zero(b),
        moment: Vec3([x, y, z]),
    };
    let opposite = |wrench: BodyWrench<'g>| wrench.map(|v| -v);
    let mass = entries[0].plus(entries[1]);
    let [.., dxy, dxz, dyz] = entries;
    [
        mass,
        entries[2],
        entries[3],
        entries[4],
        moment(dx, xz, -xy),
        opposite(dxy),
        moment(-yz, dy, xy),
        opposite(dxz),
        opposite(dyz),
        moment(yz, -xz, dz),
    ]
}

/// Returns the kinetic energy of ones in the places of m, h, I_xx, I_xy, I_yy, I_xz, I_yz, I_zz:
/// T = ½ m u·u + h·(u × ω) + ½ ω·I ω.
pub(super) fn kinetic_energies<'g>(twist: &BodyTwist<'g>) -> [Expr<'g>; 10] {
    let half = Dd::from_f64(0.5);
    let (omega, u) = (twist.angular, twist.linear);
    let [x, y, z] = omega.0;
    let [hx, hy, hz] = u.cross(omega).0;
    [
        u.dot(u) * half,
        hx,
        hy,
        hz,
        x * x * half,
        x * y,
        y * y * half,
        x * z,
        y * z,
        z * z * half,
    ]
}

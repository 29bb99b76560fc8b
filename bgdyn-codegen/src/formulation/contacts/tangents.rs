//! Two directions across a unit normal (Duff et al. 2017, "Building an orthonormal basis, revisited").
//!
//! With s = 1, or −1 where n_z is negative, and a = −1/(s + n_z):
//!
//! x = (1 + s a n_x², s a n_x n_y, −s n_x), y = (a n_x n_y, s + a n_y², −n_y), and x × y = n.
//!
//! They change smoothly with n on either side of n_z = 0, and jump there.

use bgdyn_runtime::Dd;

use crate::expr::{Builder, Expr};
use crate::math::Vec3;

/// Returns the directions x and y.
pub(super) fn across<'g>(b: &'g Builder, normal: Vec3<Expr<'g>>) -> [Vec3<Expr<'g>>; 2] {
    let one = b.number(1.0);
    let [x, y, z] = normal.0;
    let side = z.if_less(b.zero(), -one, one);
    let a = -one / (side + z);
    let (ax, ay) = (a * x, a * y);
    let both = ax * y;
    let first = [
        side * x * ax + b.constant(Dd::ONE),
        side * both,
        -(side * x),
    ];
    let second = [both, side + ay * y, -y];
    [Vec3(first), Vec3(second)]
}

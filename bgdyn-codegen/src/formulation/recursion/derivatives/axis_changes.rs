//! Changes of the forces and momenta of a composite body with the position and rate of a joint.
//!
//! The joint rotates about z or slides along z.

use bgdyn_runtime::Dd;

use super::composite_flow::CompositeFlow;
use crate::expr::{Builder, Expr};
use crate::formulation::recursion::inertia::BodyInertia;
use crate::formulation::recursion::inverse_dynamics::{BodyWrench, dynamics};
use crate::formulation::recursion::motion::Spin;
use crate::math::{Mat3, Vec3};

/// The motion of a joint's axis, in one set of axes.
pub(in crate::formulation::recursion) struct JointAxis<'g> {
    /// Motion of the body.
    pub spin: Spin<'g>,
    /// Acceleration of the origin.
    pub a: Vec3<Expr<'g>>,
    /// 2, or 1 for the Coriolis matrix.
    pub factor: Dd,
}

impl<'g> JointAxis<'g> {
    /// Returns ω × z.
    pub(super) fn rate(&self, b: &'g Builder) -> Vec3<Expr<'g>> {
        let [x, y, _] = self.spin.omega.0;
        Vec3([y, -x, b.zero()])
    }

    /// Returns z̈ = U z.
    pub(super) fn second_rate(&self) -> Vec3<Expr<'g>> {
        self.spin.u.column(2)
    }
}

/// Returns z × v.
pub(super) fn across<'g>(b: &'g Builder, v: Vec3<Expr<'g>>) -> Vec3<Expr<'g>> {
    Vec3([-v.0[1], v.0[0], b.zero()])
}

/// Returns row i of D times v.
fn d_row<'g>(inertia: &BodyInertia<'g>, i: usize, v: Vec3<Expr<'g>>) -> Expr<'g> {
    Vec3(std::array::from_fn(|k| inertia.d(i, k))).dot(v)
}

/// Returns factor · ∫ v × (z × s) dm = row z of E + factor · D (ω × z).
pub(super) fn rotation_swirl<'g>(
    b: &'g Builder,
    whole: &CompositeFlow<'g>,
    axis: &JointAxis<'g>,
) -> Vec3<Expr<'g>> {
    let rate = axis.rate(b).map(|x| x * axis.factor);
    let turning = Vec3(std::array::from_fn(|i| d_row(&whole.inertia, i, rate)));
    whole.flow.moment.row(2) + turning
}

/// Returns factor · ω × (z × h) + z × p, and about the origin factor · (D ω) × z + column z of E.
pub(super) fn rotation_by_rate<'g>(
    b: &'g Builder,
    whole: &CompositeFlow<'g>,
    spin: &Spin<'g>,
    factor: Dd,
) -> BodyWrench<'g> {
    let omega = spin.omega.map(|x| x * factor);
    let [x, y] = [0, 1].map(|i| d_row(&whole.inertia, i, omega));
    BodyWrench {
        force: omega.cross(across(b, whole.inertia.first)) + across(b, whole.flow.linear),
        moment: Vec3([y, -x, b.zero()]) + whole.flow.moment.column(2),
    }
}

/// If the composite rotates about z, its inertia P and its flow change by Z P + P Zᵀ and Z Q + Q Zᵀ, and
/// the force and moment change accordingly; those of the relative accelerations rotate with it.
pub(super) fn rotation_by_position<'g>(
    b: &'g Builder,
    whole: &CompositeFlow<'g>,
    spin: &Spin<'g>,
    axis: &JointAxis<'g>,
) -> BodyWrench<'g> {
    let zero = b.zero();
    let d = |i, j| whole.inertia.d(i, j);
    let twice_xy = d(0, 1) * Dd::from_f64(2.0);
    let inertia = BodyInertia {
        mass: zero,
        axial: zero,
        first: across(b, whole.inertia.first),
        pseudo: [
            -twice_xy,
            twice_xy,
            zero,
            d(0, 0) - d(1, 1),
            -d(1, 2),
            d(0, 2),
        ],
    };
    let [[xx, xy, xz], [yx, yy, yz], [zx, zy, _]] = whole.flow.moment.0;
    let (sum, difference) = (xy + yx, xx - yy);
    let flow = Mat3([
        [-sum, difference, -yz],
        [difference, sum, xz],
        [-zy, zx, zero],
    ]);
    let of_flow = BodyWrench {
        force: spin.omega.cross(across(b, whole.flow.linear)),
        moment: flow * spin.omega,
    };
    // J_zz does not change.
    dynamics(&inertia, zero, spin, axis.a, false)
        .plus(of_flow)
        .plus(whole.rest.map(|v| across(b, v)))
}

/// Returns swirl, ∂/∂q and ∂/∂v of a translation along z.
pub(super) fn translation<'g>(
    b: &'g Builder,
    whole: &CompositeFlow<'g>,
    axis: &JointAxis<'g>,
    force: Vec3<Expr<'g>>,
) -> (Vec3<Expr<'g>>, BodyWrench<'g>, BodyWrench<'g>) {
    let h = whole.inertia.first;
    let times = |v: Vec3<Expr<'g>>| v.map(|x| x * axis.factor);
    let field = |v: Vec3<Expr<'g>>| BodyWrench {
        force: whole.inertia.weigh(v),
        moment: h.cross(v),
    };
    let drift = whole.flow.linear + times(axis.spin.omega).cross(h);
    // The point of application of the force changes.
    let mut by_position = field(axis.second_rate());
    by_position.moment = by_position.moment + across(b, force);
    (-across(b, drift), by_position, field(times(axis.rate(b))))
}

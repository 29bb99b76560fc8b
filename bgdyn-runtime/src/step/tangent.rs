//! Brackets of velocities and derivatives of `integrate`, for all joints of a mechanism at once.

use nalgebra::{SMatrix, SVector};

use super::products::multiple_of_one;
use crate::manifold::{Columns, floating, planar, spherical};
use crate::{QuasiJoint, QuasiJointKind, Scalar};

/// Returns the matrix of y ↦ \[x, y\]; zero for joints with q̇ = v.
pub(super) fn bracket<T: Scalar, const NV: usize>(
    joints: &[QuasiJoint],
    x: &SVector<T, NV>,
) -> SMatrix<T, NV, NV> {
    let mut all = SMatrix::repeat(T::from_f64(0.0));
    for joint in joints {
        let at = joint.velocity;
        match joint.kind {
            QuasiJointKind::Planar => set(&mut all, at, &planar::bracket(part(x, at))),
            QuasiJointKind::Spherical => set(&mut all, at, &spherical::bracket(part(x, at))),
            QuasiJointKind::Floating => set(&mut all, at, &floating::bracket(part(x, at))),
        }
    }
    all
}

/// Returns the derivatives of `integrate(q, d)` by q and by d along the tangent; 1 for joints with q̇ = v.
pub(super) fn integration_maps<T: Scalar, const NV: usize>(
    joints: &[QuasiJoint],
    d: &SVector<T, NV>,
) -> [SMatrix<T, NV, NV>; 2] {
    let [mut by_q, mut by_d] = [multiple_of_one(T::from_f64(1.0)); 2];
    for joint in joints {
        let at = joint.velocity;
        match joint.kind {
            QuasiJointKind::Planar => {
                let [q, d] = planar::integration_maps(part(d, at));
                set(&mut by_q, at, &q);
                set(&mut by_d, at, &d);
            }
            QuasiJointKind::Spherical => {
                let [q, d] = spherical::integration_maps(part(d, at));
                set(&mut by_q, at, &q);
                set(&mut by_d, at, &d);
            }
            QuasiJointKind::Floating => {
                let [q, d] = floating::integration_maps(part(d, at));
                set(&mut by_q, at, &q);
                set(&mut by_d, at, &d);
            }
        }
    }
    [by_q, by_d]
}

/// Returns N components from an index.
fn part<T: Scalar, const NV: usize, const N: usize>(x: &SVector<T, NV>, from: usize) -> [T; N] {
    let [all] = &x.data.0;
    core::array::from_fn(|i| all.get(from + i).copied().unwrap_or(T::from_f64(0.0)))
}

/// Writes a block on the diagonal from an index.
fn set<T: Scalar, const NV: usize, const N: usize>(
    all: &mut SMatrix<T, NV, NV>,
    from: usize,
    block: &Columns<T, N>,
) {
    for (to, column) in all.data.0.iter_mut().skip(from).zip(block) {
        for (to, &x) in to.iter_mut().skip(from).zip(column) {
            *to = x;
        }
    }
}

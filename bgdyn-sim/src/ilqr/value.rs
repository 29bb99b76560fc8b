//! The value of a state, the least cost from there on, to second order.

use bgdyn_runtime::step::SemiImplicitBlocks;
use nalgebra::SMatrix;

use super::cost::Quadratic;
use super::rows::inner;
use crate::real::Real;

/// A square matrix, row by row.
pub(super) type Square<T, const N: usize> = [[T; N]; N];

/// A number to second order in δq and in a change of velocities.
#[derive(Clone, Copy)]
pub(super) struct Value<T, const NV: usize> {
    /// First derivatives.
    pub(super) slope: [[T; NV]; 2],
    pub(super) qq: Square<T, NV>,
    /// Rows of q, columns of v.
    pub(super) qv: Square<T, NV>,
    pub(super) vv: Square<T, NV>,
}

impl<T: Real, const NV: usize> Value<T, NV> {
    /// Returns the value of the end of a motion.
    pub(super) fn of_end(cost: &Quadratic<T, NV>) -> Self {
        let [q, v, _] = cost.slope;
        let [of_q, of_v, _] = &cost.curvature;
        Value {
            slope: [q, v],
            qq: of_q.map(|[q, _, _]| q),
            qv: of_q.map(|[_, v, _]| v),
            vv: of_v.map(|[_, v, _]| v),
        }
    }

    /// Returns the value of the state after a step as that of δq before the step and of δv⁺.
    pub(super) fn before(&self, blocks: &SemiImplicitBlocks<T, NV>) -> Self {
        match &blocks.maps {
            None => self.before_plain(blocks.step),
            Some([e, j]) => self.before_mapped(e, &j.map(|x| blocks.step * x)),
        }
    }

    /// [`Value::before`] where δq⁺ = δq + h δv⁺: C = P_qv + h P_qq and A = P_vv + h (P_vq + C).
    fn before_plain(&self, h: T) -> Self {
        let mut before = *self;
        for i in 0..NV {
            before.slope[1][i] = h.mul_add(self.slope[0][i], self.slope[1][i]);
            for j in 0..NV {
                before.qv[i][j] = h.mul_add(self.qq[i][j], self.qv[i][j]);
            }
        }
        for i in 0..NV {
            for j in 0..NV {
                let mixed = self.qv[j][i] + before.qv[i][j];
                before.vv[i][j] = h.mul_add(mixed, self.vv[i][j]);
            }
        }
        before
    }

    /// [`Value::before`] where δq⁺ = E δq + D δv⁺: with R = P_qv + P_qq D, C = Eᵀ R and A = P_vv + Dᵀ R + P_vq D.
    fn before_mapped(&self, e: &SMatrix<T, NV, NV>, d: &SMatrix<T, NV, NV>) -> Self {
        // nalgebra's columns are the rows of the transposed matrix.
        let ([columns_of_e], [columns_of_d]) = ([&e.data.0], [&d.data.0]);
        let (e, d) = (transposed(columns_of_e), transposed(columns_of_d));
        let moved = plus(&self.qv, &product(&self.qq, &d));
        let through = product(&transposed(&self.qv), &d);
        let [q, v] = self.slope;
        let carried = |columns: &Square<T, NV>| columns.each_ref().map(|column| inner(column, &q));
        let by_d = carried(columns_of_d);
        Value {
            slope: [
                carried(columns_of_e),
                core::array::from_fn(|i| v[i] + by_d[i]),
            ],
            qq: product(columns_of_e, &product(&self.qq, &e)),
            qv: product(columns_of_e, &moved),
            vv: plus(&plus(&self.vv, &product(columns_of_d, &moved)), &through),
        }
    }
}

/// Returns the transpose.
fn transposed<T: Real, const N: usize>(a: &Square<T, N>) -> Square<T, N> {
    core::array::from_fn(|i| core::array::from_fn(|j| a[j][i]))
}

/// Returns a + b.
fn plus<T: Real, const N: usize>(a: &Square<T, N>, b: &Square<T, N>) -> Square<T, N> {
    core::array::from_fn(|i| core::array::from_fn(|j| a[i][j] + b[i][j]))
}

/// Returns a b.
fn product<T: Real, const N: usize>(a: &Square<T, N>, b: &Square<T, N>) -> Square<T, N> {
    let columns = transposed(b);
    a.each_ref()
        .map(|row| columns.each_ref().map(|column| inner(row, column)))
}

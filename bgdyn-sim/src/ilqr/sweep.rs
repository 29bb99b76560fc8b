//! The Riccati sweep: from the value after a step to that before it, in blocks.
//!
//! With P the second derivatives of the value after the step, δq⁺ = δq + h δv⁺ and δv⁺ = X δ(q, v, u), X = (F G), the
//! value by (δq, δv⁺) has the blocks A = P_vv + h (P_qv + P_vq) + h² P_qq and C = P_qv + h P_qq. The second derivatives
//! by (q, v, u) are then
//!
//! Q = L + Xᵀ A X + (C X in the rows of q, and its transpose) + (P_qq in the block of q)
//!
//! with L those of the node's cost: products of NV × NV by NV × 3NV in place of 2NV × 2NV by 2NV × 3NV. With the factor
//! of Q_uu = L Lᵀ and Y = L⁻¹ Q_ux, the value before the step has P = Q_xx − Yᵀ Y, and the gains are K = L⁻ᵀ Y. Efforts
//! at their limits do not react to the state: their rows of K are zero.

use bgdyn_runtime::step::SemiImplicitBlocks;

use super::boxed::{BoxMinimum, minimize};
use super::cost::{Quadratic, Row};
use super::rows::{add_rows, inner};
use super::value::Value;
use crate::real::Real;

/// The law of a node: δu = `step` − `gain` δ(q, v).
#[derive(Clone, Copy, Debug)]
pub(super) struct Law<T, const NV: usize> {
    pub(super) step: [T; NV],
    /// A row for each effort, columns of q and of v.
    pub(super) gain: [[[T; NV]; 2]; NV],
    /// Q_u: the derivative of the cost by the efforts, if later nodes follow their laws.
    pub(super) slope: [T; NV],
    /// Derivatives of the value by the node's efforts along `step`: the first, and the second.
    pub(super) promise: [T; 2],
}

/// Returns the rows of X = (F G).
#[inline]
fn rows_of<T: Real, const NV: usize>(blocks: &SemiImplicitBlocks<T, NV>) -> [Row<T, NV>; NV] {
    let [by_q, by_v] = &blocks.f;
    let columns = [&by_q.data.0, &by_v.data.0, &blocks.g.data.0];
    core::array::from_fn(|i| columns.map(|columns| core::array::from_fn(|j| columns[j][i])))
}

/// Adds the derivatives of the value after a step by (q, v, u) to those of the node's cost. Of the second derivatives
/// only the rows of u, the columns q and v of the rows of q, and the columns v of the rows of v are complete.
#[inline]
pub(super) fn add_value<T: Real, const NV: usize>(
    after: &Value<T, NV>,
    blocks: &SemiImplicitBlocks<T, NV>,
    sum: &mut Quadratic<T, NV>,
) {
    let of = after.before(blocks);
    let x = rows_of(blocks);
    // W = A X, and Cᵀ in the columns of q.
    let mut w = [[[T::from_f64(0.0); NV]; 3]; NV];
    for (i, row) in w.iter_mut().enumerate() {
        row[0] = core::array::from_fn(|j| of.qv[j][i]);
        let a = &of.vv[i];
        add_rows(
            row.as_flattened_mut(),
            0..NV,
            |k| a[k],
            |k| x[k].as_flattened(),
        );
    }
    let state = 2 * NV;
    let [of_q, of_v, of_u] = &mut sum.curvature;
    for i in 0..NV {
        add_rows(
            of_u[i].as_flattened_mut(),
            0..NV,
            |k| x[k][2][i],
            |k| w[k].as_flattened(),
        );
        let row = &mut of_q[i].as_flattened_mut()[..state];
        add_rows(
            row,
            0..NV,
            |k| x[k][0][i],
            |k| &w[k].as_flattened()[..state],
        );
        add_rows(
            row,
            0..NV,
            |k| of.qv[i][k],
            |k| &x[k].as_flattened()[..state],
        );
        for j in 0..NV {
            of_q[i][0][j] = of_q[i][0][j] + of.qq[i][j];
        }
        add_rows(&mut of_v[i][1], 0..NV, |k| x[k][1][i], |k| &w[k][1]);
    }
    let [by_q, by_v] = &of.slope;
    add_rows(
        sum.slope.as_flattened_mut(),
        0..NV,
        |k| by_v[k],
        |k| x[k].as_flattened(),
    );
    for j in 0..NV {
        sum.slope[0][j] = sum.slope[0][j] + by_q[j];
    }
}

/// Returns the law of a node and the value before its step, from the derivatives Q by (q, v, u). `damping` adds to Q_uu
/// this share of its diagonal. `None` if Q_uu is not positive definite.
#[inline]
pub(super) fn eliminate<T: Real, const NV: usize>(
    q: &Quadratic<T, NV>,
    damping: T,
    room: Option<&[[T; NV]; 2]>,
) -> Option<(Law<T, NV>, Value<T, NV>)> {
    let [_, _, of_u] = &q.curvature;
    let [_, _, slope] = q.slope;
    let mut matrix = of_u.map(|[_, _, u]| u);
    for i in 0..NV {
        matrix[i][i] = damping.mul_add(matrix[i][i], matrix[i][i]);
    }
    let least = minimize(&matrix, &slope, room)?;
    let bent = matrix.each_ref().map(|row| inner(row, &least.at));
    let y = reduced_rows(of_u, &least);
    let law = Law {
        step: least.at,
        gain: gain(&y, &least),
        slope,
        promise: [inner(&slope, &least.at), inner(&bent, &least.at)],
    };
    Some((law, value_before(q, &least.at, &y)))
}

/// Rows of a matrix with columns of q and of v.
type StateRows<T, const NV: usize> = [[[T; NV]; 2]; NV];

/// Returns Y = L⁻¹ Q_ux; rows of efforts at a limit are zero.
#[inline]
fn reduced_rows<T: Real, const NV: usize>(
    of_u: &[Row<T, NV>; NV],
    least: &BoxMinimum<T, NV>,
) -> StateRows<T, NV> {
    let factor = &least.factor;
    let mut y = [[[T::from_f64(0.0); NV]; 2]; NV];
    for i in 0..NV {
        if !least.free[i] {
            continue;
        }
        let (done, rest) = y.split_at_mut(i);
        let [by_q, by_v, _] = of_u[i];
        let row = &mut rest[0];
        *row = [by_q, by_v];
        let l = &factor.rows[i];
        add_rows(
            row.as_flattened_mut(),
            0..i,
            |k| -l[k],
            |k| done[k].as_flattened(),
        );
        for x in row.as_flattened_mut() {
            *x = *x * factor.reciprocals[i];
        }
    }
    y
}

/// Returns K = L⁻ᵀ Y.
#[inline]
fn gain<T: Real, const NV: usize>(
    y: &StateRows<T, NV>,
    least: &BoxMinimum<T, NV>,
) -> StateRows<T, NV> {
    let factor = &least.factor;
    let mut gain = *y;
    for i in (0..NV).rev() {
        let (rest, done) = gain.split_at_mut(i + 1);
        let row = rest[i].as_flattened_mut();
        let l = |k: usize| factor.rows[i + 1 + k][i];
        add_rows(row, 0..NV - 1 - i, |k| -l(k), |k| done[k].as_flattened());
        for x in row {
            *x = *x * factor.reciprocals[i];
        }
    }
    gain
}

/// Returns the value before the step: P = Q_xx − Yᵀ Y, and the slope Q_x + Q_xu times the step of the efforts.
#[inline]
fn value_before<T: Real, const NV: usize>(
    q: &Quadratic<T, NV>,
    step: &[T; NV],
    y: &StateRows<T, NV>,
) -> Value<T, NV> {
    let mut value = Value::of_end(q);
    let [_, _, of_u] = &q.curvature;
    let state = 2 * NV;
    add_rows(
        value.slope.as_flattened_mut(),
        0..NV,
        |k| step[k],
        |k| &of_u[k].as_flattened()[..state],
    );
    for i in 0..NV {
        let mut row = [value.qq[i], value.qv[i]];
        add_rows(
            row.as_flattened_mut(),
            0..NV,
            |k| -y[k][0][i],
            |k| y[k].as_flattened(),
        );
        [value.qq[i], value.qv[i]] = row;
        add_rows(&mut value.vv[i], 0..NV, |k| -y[k][1][i], |k| &y[k][1]);
    }
    // Rounding errors are not symmetric, and would grow.
    for i in 0..NV {
        for j in 0..i {
            value.qq[i][j] = value.qq[j][i];
            value.vv[i][j] = value.vv[j][i];
        }
    }
    value
}

/// What a sweep promises: the derivative of the cost along the laws' steps, and half of the second one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Promise<T> {
    pub(super) slope: T,
    pub(super) half_curvature: T,
}

impl<T: Real> Promise<T> {
    /// Returns by how much the cost should fall with a share of the step.
    pub(super) fn decrease(&self, share: T) -> T {
        -(share * (self.slope + share * self.half_curvature))
    }
}

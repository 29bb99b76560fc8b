//! Costs of a motion, node by node.

use bgdyn_runtime::step::State;
use nalgebra::{SMatrix, SVector};

use super::rows::inner;
use crate::real::Real;

/// The arguments of a node's cost, in the order of the blocks of [`Quadratic`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Positions, along the tangent.
    Q = 0,
    /// Velocities.
    V = 1,
    /// Efforts.
    U = 2,
}

/// A row of blocks: entries by positions, velocities and efforts.
pub(super) type Row<T, const NV: usize> = [[T; NV]; 3];

/// A number to second order in small changes of q (along the tangent), v and u.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadratic<T, const NV: usize> {
    /// First derivatives.
    pub(super) slope: Row<T, NV>,
    /// Second derivatives: rows of q, of v, of u.
    pub(super) curvature: [[Row<T, NV>; NV]; 3],
}

impl<T: Real, const NV: usize> Quadratic<T, NV> {
    /// Returns zero.
    pub fn zero() -> Self {
        let row = [[T::from_f64(0.0); NV]; 3];
        Quadratic {
            slope: row,
            curvature: [[row; NV]; 3],
        }
    }

    /// Adds to the first derivatives by a part.
    pub fn add_slope(&mut self, part: Part, slope: &SVector<T, NV>) {
        let [own] = &slope.data.0;
        for (to, &x) in self.slope[part as usize].iter_mut().zip(own) {
            *to = *to + x;
        }
    }

    /// Adds a symmetric block to the second derivatives by a part.
    pub fn add_curvature(&mut self, part: Part, block: &SMatrix<T, NV, NV>) {
        let at = part as usize;
        // A symmetric block: its columns are its rows.
        for (row, own) in self.curvature[at].iter_mut().zip(&block.data.0) {
            for (to, &x) in row[at].iter_mut().zip(own) {
                *to = *to + x;
            }
        }
    }

    /// Adds ∂²/∂a∂b of two different parts, with a row for each component of a, and its transpose to ∂²/∂b∂a.
    pub fn add_mixed(&mut self, [a, b]: [Part; 2], block: &SMatrix<T, NV, NV>) {
        let (a, b) = (a as usize, b as usize);
        for j in 0..NV {
            for i in 0..NV {
                let x = block.data.0[j][i];
                self.curvature[a][i][b][j] = self.curvature[a][i][b][j] + x;
                self.curvature[b][j][a][i] = self.curvature[b][j][a][i] + x;
            }
        }
    }

    /// Adds the derivatives of `weight` |x|²/2, where `value` is x, a part minus a constant.
    pub fn add_square(&mut self, part: Part, weight: T, value: &SVector<T, NV>) {
        let at = part as usize;
        for i in 0..NV {
            self.slope[at][i] = self.slope[at][i] + weight * value.data.0[0][i];
            self.curvature[at][i][at][i] = self.curvature[at][i][at][i] + weight;
        }
    }

    /// Adds the derivatives of `weight` |r|²/2 for R residuals r(q) with the derivatives `by_q` along the tangent, without
    /// the curvature of r (Gauss–Newton).
    pub fn add_residual<const R: usize>(
        &mut self,
        weight: T,
        value: &SVector<T, R>,
        by_q: &SMatrix<T, R, NV>,
    ) {
        let at = Part::Q as usize;
        let [value] = &value.data.0;
        for (i, column) in by_q.data.0.iter().enumerate() {
            let weighted = column.map(|x| weight * x);
            self.slope[at][i] = self.slope[at][i] + inner(&weighted, value);
            for (j, other) in by_q.data.0.iter().enumerate() {
                self.curvature[at][i][at][j] =
                    self.curvature[at][i][at][j] + inner(&weighted, other);
            }
        }
    }
}

/// The cost of a motion of `N` steps: the sum over its nodes, and that of the end.
///
/// Second derivatives may be approximate, as those of Gauss and Newton; they must be positive semidefinite, and positive
/// definite by the efforts.
pub trait Cost<M, T: Real, const NQ: usize, const NV: usize> {
    /// Returns the cost of node `k`, from whose state the efforts `tau` lead to the next.
    fn node(&self, model: &M, k: usize, state: &State<T, NQ, NV>, tau: &SVector<T, NV>) -> T;

    /// Returns the cost of the end.
    fn end(&self, model: &M, state: &State<T, NQ, NV>) -> T;

    /// Adds the derivatives of [`Cost::node`] to `sum`.
    fn add_node(
        &self,
        model: &M,
        k: usize,
        state: &State<T, NQ, NV>,
        tau: &SVector<T, NV>,
        sum: &mut Quadratic<T, NV>,
    );

    /// Adds the derivatives of [`Cost::end`] to `sum`; those by efforts are not read.
    fn add_end(&self, model: &M, state: &State<T, NQ, NV>, sum: &mut Quadratic<T, NV>);
}

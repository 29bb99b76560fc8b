//! Spatial vectors and 6×6 matrices of expressions, angular part first (Featherstone 2008).

use crate::expr::{Builder, Expr};
use crate::math::{Mat3, Vec3, skew};

/// A spatial vector: angular part, linear part.
pub(super) type Spatial<'g> = (Vec3<Expr<'g>>, Vec3<Expr<'g>>);

/// A matrix from motions to forces: rows give moment and force.
#[derive(Clone, Copy)]
pub(super) struct SpatialMatrix<'g>(pub(super) [[Mat3<Expr<'g>>; 2]; 2]);

impl<'g> SpatialMatrix<'g> {
    pub(super) fn times(&self, (angular, linear): Spatial<'g>) -> Spatial<'g> {
        let [[a, c], [d, e]] = self.0;
        (a * angular + c * linear, d * angular + e * linear)
    }

    pub(super) fn transposed_times(&self, (angular, linear): Spatial<'g>) -> Spatial<'g> {
        let [[a, c], [d, e]] = self.0.map(|row| row.map(Mat3::transpose));
        (a * angular + d * linear, c * angular + e * linear)
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        let entry = |i: usize, j: usize| self.0[i][j] + other.0[i][j];
        SpatialMatrix([[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]])
    }

    /// Returns it in axes in which the present axes have this rotation.
    pub(super) fn turned(&self, r: Mat3<Expr<'g>>) -> Self {
        SpatialMatrix(self.0.map(|row| row.map(|m| r * m * r.transpose())))
    }

    /// Returns it about a point from which the origin is displaced by p: a motion (ω, v) there is
    /// (ω, v + ω × p) here, a force (n, f) here is (n + p × f, f) there.
    pub(super) fn shifted(&self, b: &'g Builder, p: Vec3<Expr<'g>>) -> Self {
        let x = skew(p, b.zero());
        let [[a, c], [d, e]] = self.0;
        // Columns: v here = v − p × ω.
        let (a, d) = (a - c * x, d - e * x);
        SpatialMatrix([[a + x * d, c + x * e], [d, e]])
    }
}

/// Returns k·1.
pub(super) fn diagonal<'g>(b: &'g Builder, k: Expr<'g>) -> Mat3<Expr<'g>> {
    Mat3::from_fn(|i, j| if i == j { k } else { b.zero() })
}

//! Motions at rest at t = 0 as free numbers: the coefficients fulfil Σ a_k = 0 (velocity) and Σ k b_k = 0
//! (acceleration), so that they are combinations of orthonormal vectors that do.

use nalgebra::{DMatrix, DVector};

use super::limits::JointLimits;
use super::series::{FourierSeries, PeriodicMotion};

/// The map between free numbers and motions. A joint has 2K − 1 numbers: its centre in halves of its range, then those
/// of a_k and of b_k in parts of its speed limit.
#[derive(Clone, Debug)]
pub struct Shape {
    frequency: f64,
    /// Columns: vectors with Σ a_k = 0.
    sine: DMatrix<f64>,
    /// Columns: vectors with Σ k b_k = 0.
    cosine: DMatrix<f64>,
    /// Middle of the range, half of it, speed, by joint.
    scales: Vec<[f64; 3]>,
}

impl Shape {
    /// Returns the map for `harmonics` K ≥ 2.
    pub fn new(harmonics: usize, frequency: f64, limits: &[JointLimits]) -> Self {
        let scale = |l: &JointLimits| [l.middle(), l.half(), l.speed];
        Shape {
            frequency,
            sine: orthogonal_to(&DVector::repeat(harmonics, 1.0)),
            cosine: orthogonal_to(&DVector::from_fn(harmonics, |k, _| (k + 1) as f64)),
            scales: limits.iter().map(scale).collect(),
        }
    }

    /// Returns the count of free numbers of a joint.
    pub fn of_joint(&self) -> usize {
        1 + 2 * self.sine.ncols()
    }

    /// Returns the count of all free numbers.
    pub fn len(&self) -> usize {
        self.of_joint() * self.scales.len()
    }

    /// Returns whether there are none.
    pub fn is_empty(&self) -> bool {
        self.scales.is_empty()
    }

    /// Returns the motion of free numbers.
    pub fn motion(&self, x: &DVector<f64>) -> PeriodicMotion {
        let (n, k) = (self.of_joint(), self.sine.ncols());
        let joints = self.scales.iter().enumerate();
        let joint = |(j, [middle, half, speed]): (usize, &[f64; 3])| FourierSeries {
            centre: middle + half * x[n * j],
            sine: (&self.sine * x.rows(n * j + 1, k) * *speed)
                .as_slice()
                .to_vec(),
            cosine: (&self.cosine * x.rows(n * j + 1 + k, k) * *speed)
                .as_slice()
                .to_vec(),
        };
        PeriodicMotion {
            frequency: self.frequency,
            joints: joints.map(joint).collect(),
        }
    }

    /// Returns the free numbers of a motion at rest at t = 0.
    pub fn numbers(&self, motion: &PeriodicMotion) -> DVector<f64> {
        let mut x = DVector::zeros(self.len());
        let (n, k) = (self.of_joint(), self.sine.ncols());
        for (j, (series, [middle, half, speed])) in
            motion.joints.iter().zip(&self.scales).enumerate()
        {
            let sine = DVector::from_column_slice(&series.sine);
            let cosine = DVector::from_column_slice(&series.cosine);
            x[n * j] = (series.centre - middle) / half;
            x.rows_mut(n * j + 1, k)
                .copy_from(&(self.sine.tr_mul(&sine) / *speed));
            x.rows_mut(n * j + 1 + k, k)
                .copy_from(&(self.cosine.tr_mul(&cosine) / *speed));
        }
        x
    }

    /// Returns the slopes by free numbers from those by the coefficients, for each joint (q₀, a_k, b_k).
    pub fn slopes(&self, by_coefficients: &[FourierSeries]) -> DVector<f64> {
        let mut x = DVector::zeros(self.len());
        let (n, k) = (self.of_joint(), self.sine.ncols());
        for (j, (slope, [_, half, speed])) in by_coefficients.iter().zip(&self.scales).enumerate() {
            let sine = DVector::from_column_slice(&slope.sine);
            let cosine = DVector::from_column_slice(&slope.cosine);
            x[n * j] = slope.centre * half;
            x.rows_mut(n * j + 1, k)
                .copy_from(&(self.sine.tr_mul(&sine) * *speed));
            x.rows_mut(n * j + 1 + k, k)
                .copy_from(&(self.cosine.tr_mul(&cosine) * *speed));
        }
        x
    }
}

/// Returns orthonormal columns that span all vectors orthogonal to `v`: those of Householder's reflection of `v` to
/// the first axis, without the first.
fn orthogonal_to(v: &DVector<f64>) -> DMatrix<f64> {
    let n = v.len();
    let mut u = v / v.norm();
    u[0] += 1.0;
    let size = u.norm_squared();
    let reflection = DMatrix::identity(n, n) - (&u * u.transpose()) * (2.0 / size);
    reflection.columns(1, n - 1).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_orthonormal_and_at_rest() {
        for n in 2..8 {
            let v = DVector::from_fn(n, |k, _| (k + 1) as f64);
            let columns = orthogonal_to(&v);
            assert!((columns.tr_mul(&columns) - DMatrix::identity(n - 1, n - 1)).amax() < 1e-14);
            assert!(columns.tr_mul(&v).amax() < 1e-14);
        }
    }
}

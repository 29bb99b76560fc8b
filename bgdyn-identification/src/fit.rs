//! Weighted robust least squares: each joint is weighted by its own residual, outliers by Huber's weights.

use nalgebra::{DMatrix, DVector};

use crate::base::independent;
use crate::prepare::Samples;
use crate::statistics::median;
use crate::triangle::Triangle;

/// Rounds of weighting.
const ROUNDS: usize = 12;
/// Residuals beyond so many deviations have less weight (Huber).
const HUBER: f64 = 2.5;
/// A base parameter of which less is left beside the others is invisible in this motion.
const VISIBLE: f64 = 1e-6;

/// The result of least squares on base parameters.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The base parameters.
    pub values: DVector<f64>,
    /// Which of them this motion shows at all; the others keep the numbers of the file.
    pub visible: Vec<usize>,
    /// Robust deviation of the residual by joint, N·m or N.
    pub sigma: Vec<f64>,
    /// The weight of each row.
    pub weights: Vec<f64>,
    /// Scales of the columns.
    pub scales: Vec<f64>,
    /// R of the scaled, weighted columns.
    pub r: DMatrix<f64>,
    /// Qᵀ y.
    pub y: DVector<f64>,
    /// Condition number of the scaled columns.
    pub condition: f64,
}

/// Fits base parameters to efforts `tau`. `columns` are the base columns of the samples, `file` the numbers that
/// invisible parameters keep. Rows of joints slower than `still` have no weight.
pub fn fit(
    samples: &Samples,
    columns: &DMatrix<f64>,
    tau: &[f64],
    file: &DVector<f64>,
    still: f64,
) -> Fit {
    let n = samples.joints;
    let used: Vec<f64> = samples
        .v
        .iter()
        .map(|v| f64::from(v.abs() >= still))
        .collect();
    let mut sigma = vec![1.0; n];
    let mut huber = used.clone();
    let mut last = None;
    for _ in 0..ROUNDS {
        let weights: Vec<f64> = (0..tau.len()).map(|i| huber[i] / sigma[i % n]).collect();
        let solved = weighted(columns, tau, &weights, file);
        let residual: Vec<f64> = residuals(columns, tau, &solved.values);
        for j in 0..n {
            let own = (j..tau.len()).step_by(n).filter(|i| used[*i] > 0.0);
            let own: Vec<f64> = own.map(|i| residual[i].abs()).collect();
            sigma[j] = (1.4826 * median(own)).max(1e-12);
        }
        for i in 0..tau.len() {
            let u = residual[i].abs() / sigma[i % n];
            huber[i] = used[i] * if u > HUBER { (HUBER / u).sqrt() } else { 1.0 };
        }
        last = Some(solved);
    }
    let solved = last.expect("at least one round");
    Fit { sigma, ..solved }
}

/// Returns τ − Y π.
pub fn residuals(columns: &DMatrix<f64>, tau: &[f64], values: &DVector<f64>) -> Vec<f64> {
    let predicted = columns * values;
    tau.iter()
        .zip(predicted.iter())
        .map(|(t, p)| t - p)
        .collect()
}

fn weighted(columns: &DMatrix<f64>, tau: &[f64], weights: &[f64], file: &DVector<f64>) -> Fit {
    let p = columns.ncols();
    let mut scales = vec![0.0; p];
    for (c, scale) in scales.iter_mut().enumerate() {
        let column = columns.column(c);
        let square = column.iter().zip(weights).map(|(x, w)| (x * w).powi(2));
        *scale = square.sum::<f64>().sqrt();
    }
    let inverse: Vec<f64> = scales
        .iter()
        .map(|s| if *s > 0.0 { 1.0 / s } else { 0.0 })
        .collect();
    let mut triangle = Triangle::new(p);
    for (i, weight) in weights.iter().enumerate().filter(|(_, w)| **w > 0.0) {
        let row = columns.row(i);
        triangle.push(
            row.iter().zip(&inverse).map(|(x, s)| x * s),
            tau[i],
            *weight,
        );
    }
    let (r, y) = triangle.finish();
    let order: Vec<usize> = (0..p).collect();
    let visible = independent(&r, &order, VISIBLE);
    let (values, condition) = solve(&r, &y, &scales, &visible, file);
    Fit {
        values,
        visible,
        sigma: Vec::new(),
        weights: weights.to_vec(),
        scales,
        r,
        y,
        condition,
    }
}

/// Solves R z = y for the visible parameters, with the others as in the file.
fn solve(
    r: &DMatrix<f64>,
    y: &DVector<f64>,
    scales: &[f64],
    visible: &[usize],
    file: &DVector<f64>,
) -> (DVector<f64>, f64) {
    let mut values = file.clone();
    for &c in visible {
        values[c] = 0.0;
    }
    let scaled = DVector::from_fn(values.len(), |c, _| values[c] * scales[c]);
    let left = y - r * scaled;
    let own = r.select_columns(visible);
    let singular = own.singular_values();
    let condition = match singular.is_empty() {
        true => f64::INFINITY,
        false => singular.max() / singular.min(),
    };
    let qr = own.qr();
    let mut z = qr.q().tr_mul(&left);
    qr.r().solve_upper_triangular_mut(&mut z);
    for (k, &c) in visible.iter().enumerate() {
        values[c] = z[k] / scales[c];
    }
    (values, condition)
}

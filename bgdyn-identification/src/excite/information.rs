//! How much a motion says of base parameters: log det of AᵀA, its columns scaled and its rows weighted by noise, and its
//! slopes.

use nalgebra::{DMatrix, DVector};

use super::series::State;
use crate::base::Base;
use crate::model::{
    BODY_PARAMETERS, COULOMB, JOINT_COLUMNS, Model, SIGN_WIDTH, Unknown, joint_columns,
    joint_columns_within,
};

/// Weight of the logarithms of the columns' sizes in the objective. Scaled columns do not depend on sizes: a small motion
/// could be as good as a large one. With the whole sizes ascents end far from the best condition.
const SIZE: f64 = 0.1;
/// Step of central differences by positions, rad or m: their error is of the size 1e-8.
const STEP: f64 = 1e-4;

/// A pivot of AᵀA with scaled columns that is smaller is a rounding error.
const SINGULAR: f64 = 1e-13;

/// The columns of base parameters, and the weights of rows.
pub struct Information<'a> {
    model: &'a Model<'a>,
    /// Columns of base parameters from those of bodies.
    of_bodies: DMatrix<f64>,
    /// Base parameters that belong to joints: which, the column, the joint.
    of_joints: Vec<(usize, usize, usize)>,
    /// Parameters of the bodies in the file.
    file: DVector<f64>,
    /// 1/σ of each joint.
    weights: Vec<f64>,
    /// The width of the sign of Coulomb friction by joint: smooth enough for slopes.
    widths: Vec<f64>,
    /// AᵀA of an earlier log for a row of this motion: of weighted rows, and of rows without weights.
    prior: Option<[DMatrix<f64>; 2]>,
}

/// Whether rows are divided by their noise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Weighting {
    Noise,
    Equal,
}

/// A state with the rows of the bodies there.
pub struct Sample {
    /// The state.
    pub state: State,
    /// Y, as [`crate::model::Rows`] gives it.
    rows: DMatrix<f64>,
}

/// How the slope of a function of the rows and efforts follows from theirs.
pub struct Cotangent {
    /// Slopes by the rows of base parameters, n × p.
    pub rows: DMatrix<f64>,
    /// Slopes by efforts without Coulomb friction, n.
    pub efforts: DVector<f64>,
}

impl<'a> Information<'a> {
    /// Returns the columns of `base`; `sigma` is the noise of each joint's effort, N·m or N, `widths` a speed of each
    /// joint over which the sign of Coulomb friction is smoothed.
    pub fn new(model: &'a Model<'a>, base: &Base, sigma: &[f64], widths: Vec<f64>) -> Self {
        let bodies = BODY_PARAMETERS * model.rows.bodies();
        let mut of_bodies = DMatrix::zeros(bodies, base.kept.len());
        let mut of_joints = Vec::new();
        for (i, kept) in base.kept.iter().enumerate() {
            match base.free[*kept] {
                Unknown::Link(link, k) => {
                    let part = &model.links[link];
                    let at = BODY_PARAMETERS * part.body;
                    let own = part.in_body.column(k);
                    of_bodies
                        .view_mut((at, i), (BODY_PARAMETERS, 1))
                        .copy_from(&own);
                }
                Unknown::Joint(column, joint) => of_joints.push((i, column, joint)),
            }
        }
        let mut file = DVector::zeros(bodies);
        for link in &model.links {
            let own = link.in_body * link.file;
            let mut at = file.rows_mut(BODY_PARAMETERS * link.body, BODY_PARAMETERS);
            at += own;
        }
        Information {
            model,
            of_bodies,
            of_joints,
            file,
            weights: sigma.iter().map(|s| 1.0 / s).collect(),
            widths,
            prior: None,
        }
    }

    /// Counts what an earlier log says: its rows of base parameters, n for each time, each as much as `share` rows of
    /// this motion, divided by their count.
    pub fn set_prior(&mut self, rows: &DMatrix<f64>, share: f64) {
        let of = |weighting| self.square_of(rows, weighting) * share;
        self.prior = Some([of(Weighting::Noise), of(Weighting::Equal)]);
    }

    /// Returns the count of base parameters.
    pub fn len(&self) -> usize {
        self.of_bodies.ncols()
    }

    /// Returns whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the states with the rows of the bodies.
    pub fn samples(&self, states: Vec<State>) -> Vec<Sample> {
        let sample = |state: State| Sample {
            rows: self.bodies_at(&state),
            state,
        };
        states.into_iter().map(sample).collect()
    }

    /// Returns the weights of rows, by joint.
    fn weights(&self, weighting: Weighting) -> Vec<f64> {
        match weighting {
            Weighting::Noise => self.weights.clone(),
            Weighting::Equal => vec![1.0; self.weights.len()],
        }
    }

    fn bodies_at(&self, state: &State) -> DMatrix<f64> {
        let mut rows = DMatrix::zeros(self.model.joints.len(), self.of_bodies.nrows());
        let State { q, v, a } = state;
        self.model.rows.effort_rows(q, v, a, &mut rows);
        rows
    }

    /// Returns the rows of base parameters, not weighted; `widths` are those of the sign.
    fn rows(&self, sample: &Sample, widths: &[f64]) -> DMatrix<f64> {
        let mut rows = &sample.rows * &self.of_bodies;
        let state = &sample.state;
        for &(i, column, j) in &self.of_joints {
            rows[(j, i)] = joint_columns_within(state.v[j], state.a[j], widths[j])[column];
        }
        rows
    }

    /// Returns the efforts of the file's numbers, N·m or N.
    pub fn efforts(&self, state: &State) -> DVector<f64> {
        self.efforts_of(&self.bodies_at(state), state, |_| true)
    }

    /// Returns the same without Coulomb friction, which is smooth in the state.
    pub fn smooth_efforts(&self, sample: &Sample) -> DVector<f64> {
        self.efforts_of(&sample.rows, &sample.state, |column| column != COULOMB)
    }

    /// Returns the efforts with some of the columns of joints.
    fn efforts_of(
        &self,
        rows: &DMatrix<f64>,
        state: &State,
        counts: impl Fn(usize) -> bool,
    ) -> DVector<f64> {
        let mut efforts = rows * &self.file;
        for (j, joint) in self.model.joints.iter().enumerate() {
            let columns = joint_columns(state.v[j], state.a[j]);
            for (column, (x, k)) in columns.iter().zip(&joint.file).enumerate() {
                efforts[j] += if counts(column) { x * k } else { 0.0 };
            }
        }
        efforts
    }

    /// Returns the size of Coulomb friction in the file, N·m or N, by joint.
    pub fn coulomb(&self) -> impl Iterator<Item = f64> {
        self.model.joints.iter().map(|j| j.file[COULOMB].abs())
    }

    /// Returns Σ yᵀ y over the weighted rows of the states, divided by their count, with the prior.
    fn square(&self, samples: &[Sample], weighting: Weighting, widths: &[f64]) -> DMatrix<f64> {
        let n = self.model.joints.len();
        let mut all = DMatrix::zeros(n * samples.len(), self.len());
        for (s, sample) in samples.iter().enumerate() {
            all.rows_mut(n * s, n).copy_from(&self.rows(sample, widths));
        }
        let square = self.square_of(&all, weighting) / samples.len() as f64;
        match (&self.prior, weighting) {
            (Some([prior, _]), Weighting::Noise) | (Some([_, prior]), Weighting::Equal) => {
                square + prior
            }
            (None, _) => square,
        }
    }

    /// Returns AᵀA of rows of base parameters, n for each time.
    fn square_of(&self, rows: &DMatrix<f64>, weighting: Weighting) -> DMatrix<f64> {
        let weights = self.weights(weighting);
        let mut rows = rows.clone();
        for (mut row, weight) in rows.row_iter_mut().zip(weights.iter().cycle()) {
            row *= *weight;
        }
        rows.tr_mul(&rows)
    }

    /// Returns AᵀA as the search sees it: rows divided by noise, the sign of Coulomb friction smoothed.
    fn smooth_square(&self, samples: &[Sample]) -> DMatrix<f64> {
        self.square(samples, Weighting::Noise, &self.widths)
    }

    /// Returns what a search raises: log det of AᵀA with scaled columns, and a share of the logarithms of its diagonal;
    /// `None` where it is singular.
    pub fn value(&self, samples: &[Sample]) -> Option<f64> {
        let square = self.smooth_square(samples);
        let sizes: f64 = square.diagonal().iter().map(|x| x.ln()).sum();
        Some(log_det(&square)? + SIZE * sizes)
    }

    /// Returns log det of AᵀA with scaled columns, ≤ 0; `None` where it is singular.
    pub fn log_det(&self, samples: &[Sample]) -> Option<f64> {
        log_det(&self.smooth_square(samples))
    }

    /// Returns the condition number of A with scaled columns, with rows weighted by noise, as `identify` states it, and
    /// without weights.
    pub fn condition(&self, samples: &[Sample]) -> [f64; 2] {
        let sharp = vec![SIGN_WIDTH; self.model.joints.len()];
        [Weighting::Noise, Weighting::Equal]
            .map(|weighting| condition(&self.square(samples, weighting, &sharp)))
    }

    /// Returns the slopes of [`Information::value`] by the rows of base parameters, for all states:
    /// 2 w² Y (G⁻¹ − (1 − share)/diag G)/N with G = AᵀA.
    pub fn cotangents(&self, samples: &[Sample]) -> Option<Vec<DMatrix<f64>>> {
        let square = self.smooth_square(samples);
        let scales: Vec<f64> = square.diagonal().iter().map(|x| 1.0 / x.sqrt()).collect();
        let mut inverse = scaled(&square, &scales).cholesky()?.inverse();
        for (i, x) in scales.iter().enumerate() {
            inverse[(i, i)] -= 1.0 - SIZE;
            inverse.row_mut(i).scale_mut(*x);
            inverse.column_mut(i).scale_mut(*x);
        }
        let of = |sample: &Sample| {
            let mut slopes = self.rows(sample, &self.widths) * &inverse;
            for (mut row, weight) in slopes.row_iter_mut().zip(&self.weights) {
                row *= 2.0 * weight * weight / samples.len() as f64;
            }
            slopes
        };
        Some(samples.iter().map(of).collect())
    }

    /// Returns the slopes by position, velocity and acceleration of each joint of what has these slopes by rows and
    /// efforts: ⟨C, ∂Y⟩ for each of q, v, a. Rows are of second order in velocities and of first in accelerations, so
    /// that differences are exact there; by positions they are central ones.
    pub fn slopes(&self, sample: &Sample, by: &Cotangent) -> Vec<[f64; 3]> {
        let state = &sample.state;
        let n = self.model.joints.len();
        // Slopes by the rows of bodies.
        let all = &by.rows * self.of_bodies.transpose() + &by.efforts * self.file.transpose();
        let at = |of: &dyn Fn(&mut State)| {
            let mut other = state.clone();
            of(&mut other);
            all.dot(&self.bodies_at(&other))
        };
        let here = all.dot(&sample.rows);
        let mut by_state = vec![[0.0; 3]; n];
        for (j, slope) in by_state.iter_mut().enumerate() {
            let q = |step: f64| at(&|s| s.q[j] += step);
            let v = |step: f64| at(&|s| s.v[j] += step);
            *slope = [
                (q(STEP) - q(-STEP)) / (2.0 * STEP),
                (v(1.0) - v(-1.0)) / 2.0,
                at(&|s| s.a[j] += 1.0) - here,
            ];
        }
        self.add_joints(state, by, &mut by_state);
        by_state
    }

    /// Adds the slopes of the columns of joints.
    fn add_joints(&self, state: &State, by: &Cotangent, slopes: &mut [[f64; 3]]) {
        let mut add = |column: usize, j: usize, factor: f64| {
            let steep = 1.0 - (state.v[j] / self.widths[j]).tanh().powi(2);
            let [v, a] = match JOINT_COLUMNS[column] {
                "rotor" => [0.0, 1.0],
                "viscous" => [1.0, 0.0],
                "coulomb" => [steep / self.widths[j], 0.0],
                _ => [0.0, 0.0],
            };
            slopes[j][1] += factor * v;
            slopes[j][2] += factor * a;
        };
        for &(i, column, j) in &self.of_joints {
            add(column, j, by.rows[(j, i)]);
        }
        for (j, joint) in self.model.joints.iter().enumerate() {
            for (column, number) in joint.file.iter().enumerate() {
                if column != COULOMB {
                    add(column, j, by.efforts[j] * number);
                }
            }
        }
    }
}

fn scaled(square: &DMatrix<f64>, scales: &[f64]) -> DMatrix<f64> {
    DMatrix::from_fn(square.nrows(), square.ncols(), |i, k| {
        square[(i, k)] * scales[i] * scales[k]
    })
}

fn log_det(square: &DMatrix<f64>) -> Option<f64> {
    let scales: Vec<f64> = square.diagonal().iter().map(|x| 1.0 / x.sqrt()).collect();
    let factor = scaled(square, &scales).cholesky()?;
    let l = factor.l_dirty();
    let pivots = (0..l.nrows()).map(|i| l[(i, i)] * l[(i, i)]);
    if pivots.clone().any(|x| x < SINGULAR) {
        return None;
    }
    let sum: f64 = pivots.map(f64::ln).sum();
    sum.is_finite().then_some(sum)
}

/// Returns the condition number of A with scaled columns from AᵀA; infinite where a column is zero.
fn condition(square: &DMatrix<f64>) -> f64 {
    let scales: Vec<f64> = square.diagonal().iter().map(|x| 1.0 / x.sqrt()).collect();
    if scales.iter().any(|s| !s.is_finite()) {
        return f64::INFINITY;
    }
    let values = scaled(square, &scales).symmetric_eigenvalues();
    match values.min() > 0.0 {
        true => (values.max() / values.min()).sqrt(),
        false => f64::INFINITY,
    }
}

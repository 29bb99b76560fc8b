//! How much a motion says of base parameters: log det of AᵀA, its columns scaled and its rows weighted by noise, and its
//! slopes.

use nalgebra::{DMatrix, DVector, RowDVector};

use super::series::State;
use crate::base::Base;
use crate::model::{
    BODY_PARAMETERS, JOINT_COLUMNS, Model, SIGN_WIDTH, Unknown, joint_columns_within,
};

/// Weight of the logarithms of the columns' sizes in the objective. Scaled columns do not depend on sizes: a small motion
/// could be as good as a large one. With the whole sizes ascents end far from the best condition.
const SIZE: f64 = 0.1;
/// Step of central differences by positions, rad or m: their error is of the size 1e-8.
const STEP: f64 = 1e-4;

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
    /// AᵀA of an earlier log for a row of this motion.
    prior: Option<DMatrix<f64>>,
}

/// How the slope of a function of the rows and efforts follows from theirs.
pub struct Cotangent {
    /// Slopes by the rows of base parameters, n × p.
    pub rows: DMatrix<f64>,
    /// Slopes by efforts.
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

    /// Counts what an earlier log says: AᵀA of its weighted rows, for each row of this motion.
    pub fn set_prior(&mut self, prior: DMatrix<f64>) {
        self.prior = Some(prior);
    }

    /// Returns the count of base parameters.
    pub fn len(&self) -> usize {
        self.of_bodies.ncols()
    }

    /// Returns whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the weights 1/σ.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    fn bodies_at(&self, state: &State) -> DMatrix<f64> {
        let mut rows = DMatrix::zeros(self.model.joints.len(), self.of_bodies.nrows());
        let State { q, v, a } = state;
        self.model.rows.effort_rows(q, v, a, &mut rows);
        rows
    }

    /// Returns the rows of base parameters, not weighted; `widths` are those of the sign.
    fn rows(&self, of_bodies: &DMatrix<f64>, state: &State, widths: &[f64]) -> DMatrix<f64> {
        let mut rows = of_bodies * &self.of_bodies;
        for &(i, column, j) in &self.of_joints {
            rows[(j, i)] = joint_columns_within(state.v[j], state.a[j], widths[j])[column];
        }
        rows
    }

    /// Returns the efforts of the file's numbers, N·m or N.
    pub fn efforts(&self, state: &State) -> DVector<f64> {
        self.efforts_within(state, &vec![SIGN_WIDTH; self.widths.len()])
    }

    /// Returns the same with the sign of Coulomb friction smoothed, as [`Information::slopes`] differentiates it.
    pub fn smooth_efforts(&self, state: &State) -> DVector<f64> {
        self.efforts_within(state, &self.widths)
    }

    fn efforts_within(&self, state: &State, widths: &[f64]) -> DVector<f64> {
        let mut efforts = self.bodies_at(state) * &self.file;
        for (j, joint) in self.model.joints.iter().enumerate() {
            let columns = joint_columns_within(state.v[j], state.a[j], widths[j]);
            let own = columns.iter().zip(&joint.file).map(|(x, k)| x * k);
            efforts[j] += own.sum::<f64>();
        }
        efforts
    }

    /// Returns Σ yᵀ y over the weighted rows of the states, divided by their count, with the prior.
    fn square(&self, states: &[State], weights: &[f64], widths: &[f64]) -> DMatrix<f64> {
        let n = self.model.joints.len();
        let mut all = DMatrix::zeros(n * states.len(), self.len());
        for (s, state) in states.iter().enumerate() {
            let mut rows = self.rows(&self.bodies_at(state), state, widths);
            for (mut row, weight) in rows.row_iter_mut().zip(weights) {
                row *= *weight;
            }
            all.rows_mut(n * s, n).copy_from(&rows);
        }
        let square = all.tr_mul(&all) / states.len() as f64;
        match &self.prior {
            Some(prior) => square + prior,
            None => square,
        }
    }

    /// Returns what a search raises: log det of AᵀA with scaled columns, and a share of the logarithms of its diagonal;
    /// `None` where it is singular.
    pub fn value(&self, states: &[State]) -> Option<f64> {
        let square = self.square(states, &self.weights, &self.widths);
        let sizes: f64 = square.diagonal().iter().map(|x| x.ln()).sum();
        Some(log_det(&square)? + SIZE * sizes)
    }

    /// Returns log det of AᵀA with scaled columns, ≤ 0; `None` where it is singular.
    pub fn log_det(&self, states: &[State]) -> Option<f64> {
        log_det(&self.square(states, &self.weights, &self.widths))
    }

    /// Returns the condition number of A with scaled columns, with rows weighted by noise, as `identify` states it, and
    /// without weights.
    pub fn condition(&self, states: &[State]) -> [f64; 2] {
        let n = self.model.joints.len();
        let sharp = vec![SIGN_WIDTH; n];
        let of = |weights: &[f64]| condition(&self.square(states, weights, &sharp));
        [of(&self.weights), of(&vec![1.0; n])]
    }

    /// Returns the slopes of [`Information::value`] by the rows of base parameters, for all states:
    /// 2 w² Y (G⁻¹ − (1 − share)/diag G)/N with G = AᵀA.
    pub fn cotangents(&self, states: &[State]) -> Option<Vec<DMatrix<f64>>> {
        let square = self.square(states, &self.weights, &self.widths);
        let scales: Vec<f64> = square.diagonal().iter().map(|x| 1.0 / x.sqrt()).collect();
        let mut inverse = scaled(&square, &scales).cholesky()?.inverse();
        for (i, x) in scales.iter().enumerate() {
            inverse[(i, i)] -= 1.0 - SIZE;
            inverse.row_mut(i).scale_mut(*x);
            inverse.column_mut(i).scale_mut(*x);
        }
        let of = |state: &State| {
            let rows = self.rows(&self.bodies_at(state), state, &self.widths);
            let mut slopes = rows * &inverse;
            for (mut row, weight) in slopes.row_iter_mut().zip(&self.weights) {
                row *= 2.0 * weight * weight / states.len() as f64;
            }
            slopes
        };
        Some(states.iter().map(of).collect())
    }

    /// Returns the slopes by position, velocity and acceleration of each joint of what has these slopes by rows and efforts: ⟨C, ∂Y⟩ for each of q, v, a. Rows are
    /// of second order in velocities and of first in accelerations, so that differences are exact there.
    pub fn slopes(&self, state: &State, by: &Cotangent) -> Vec<[f64; 3]> {
        let n = self.model.joints.len();
        // Slopes by the rows of bodies.
        let all = &by.rows * self.of_bodies.transpose() + &by.efforts * self.file.transpose();
        let at = |of: &dyn Fn(&mut State)| {
            let mut other = state.clone();
            of(&mut other);
            all.dot(&self.bodies_at(&other))
        };
        let here = all.dot(&self.bodies_at(state));
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
                add(column, j, by.efforts[j] * number);
            }
        }
    }

    /// Returns AᵀA of given rows of base parameters, n for each time, weighted.
    pub fn square_of(&self, rows: impl Iterator<Item = RowDVector<f64>>) -> DMatrix<f64> {
        let mut square = DMatrix::zeros(self.len(), self.len());
        for (i, row) in rows.enumerate() {
            let weight = self.weights[i % self.weights.len()].powi(2);
            square.ger(weight, &row.transpose(), &row.transpose(), 1.0);
        }
        square
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
    let sum: f64 = (0..l.nrows()).map(|i| l[(i, i)].ln()).sum();
    (2.0 * sum).is_finite().then_some(2.0 * sum)
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

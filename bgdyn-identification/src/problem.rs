//! Least squares of a motion, and bodies that can exist nearest to it.

use nalgebra::{DMatrix, DVector};

use crate::base::Base;
use crate::bodies::{BodyProblem, Cone};
use crate::deviations::{deviations, is_seen, meat};
use crate::fault::LogFault;
use crate::fit::{Fit, fit, residuals};
use crate::judge::judge;
use crate::log::Quality;
use crate::model::{Model, PARAMETER_NAMES, Parameters, Unknown};
use crate::options::Options;
use crate::prepare::Samples;
use crate::pseudo_inertia::{made_definite, smallest_eigenvalue};
use crate::result::{BaseParameter, Identification, Identified, Judgement};
use crate::sticking::sticking;

/// Least squares of a motion.
pub(crate) struct Problem {
    samples: Samples,
    base: Base,
    /// All numbers of the file.
    file: DVector<f64>,
    /// Indices of the free ones among all.
    free: Vec<usize>,
    columns: DMatrix<f64>,
    /// Efforts less those of what is not identified.
    tau: Vec<f64>,
    fit: Fit,
}

/// The problem of bodies.
struct Posed {
    solver: BodyProblem,
    /// The bodies of the file, made definite.
    start: DVector<f64>,
    /// Links whose numbers in the file no body can have.
    impossible: Vec<usize>,
    /// Unknowns without effect in this motion.
    left_out: Vec<Unknown>,
    /// The free unknowns that it has, as indices into those of the base.
    used: Vec<usize>,
}

impl Problem {
    pub(crate) fn new(model: &Model<'_>, samples: Samples, base: Base, options: &Options) -> Self {
        let all = model.unknowns();
        let file = DVector::from_iterator(all.len(), all.iter().map(|u| model.file(*u)));
        let free: Vec<usize> = (0..all.len()).filter(|i| model.is_free(all[*i])).collect();
        let mut fixed = file.clone();
        free.iter().for_each(|i| fixed[*i] = 0.0);
        let known = &samples.rows * fixed;
        let tau: Vec<f64> = samples
            .tau
            .iter()
            .zip(known.iter())
            .map(|(t, k)| t - k)
            .collect();
        let kept: Vec<usize> = base.kept.iter().map(|k| free[*k]).collect();
        let columns = samples.rows.select_columns(&kept);
        let of_file = &base.map * DVector::from_iterator(free.len(), free.iter().map(|i| file[*i]));
        let fit = fit(&samples, &columns, &tau, &of_file, options.skip_below);
        Problem {
            samples,
            base,
            file,
            free,
            columns,
            tau,
            fit,
        }
    }

    pub(crate) fn solve(
        &self,
        model: &Model<'_>,
        options: &Options,
    ) -> Result<Identification, Vec<LogFault>> {
        let meat = meat(&self.samples, &self.columns, &self.tau, &self.fit);
        let base = self.base_parameters(model, &meat);
        if base.iter().all(|p| !p.seen) {
            let message = format!(
                "none of {} base parameters is seen: each deviation exceeds 30 % of its number",
                base.len()
            );
            let help = "record a motion that moves all joints at once, fast enough for their inertia to be felt";
            return Err(vec![
                LogFault::whole("nothing-excited", message).with_help(help),
            ]);
        }
        let Posed {
            solver,
            start,
            impossible,
            left_out,
            used,
        } = self.body_problem(model, options);
        let bodies = solver.solve(start);
        let cov = bodies
            .hessian
            .clone()
            .try_inverse()
            .unwrap_or_else(|| DMatrix::zeros(used.len(), used.len()));
        // K of the scaled columns carries the meat to the unknowns.
        let scaled = self.scaled_map(&used);
        let outer = scaled.tr_mul(&(&meat * &scaled)) + &bodies.of_file;
        let robust = &cov * outer * &cov;
        let numbers = self.numbers(
            model,
            &used,
            &bodies.values,
            (&cov, &robust),
            &bodies.of_file,
        );
        let link = |l: usize| {
            let own = |k: usize| {
                let found = numbers.iter().find(|n| n.unknown == Unknown::Link(l, k));
                found.map_or(model.links[l].file[k], |n| n.value)
            };
            smallest_eigenvalue(&Parameters::from_fn(|k, _| own(k)))
        };
        Ok(Identification {
            rows: self.tau.len(),
            condition: self.fit.condition,
            sigma: self.fit.sigma.clone(),
            base,
            map: self.base.clone(),
            eigenvalues: (0..model.links.len()).map(link).collect(),
            covariance: larger(cov, &robust),
            numbers,
            sticking: sticking(&self.samples, &self.residual(), options.skip_below),
            left_out,
            impossible,
            steps: bodies.steps,
            quality: Quality {
                rows: 0,
                rate: 0.0,
                jitter: 0.0,
                lost: 0,
                joints: vec![],
            },
            spikes: vec![],
            cut: 0.0,
            judgement: Judgement {
                samples: self.samples.clone(),
                last_third: false,
                predicted: Default::default(),
                left: Default::default(),
            },
        })
    }

    /// Returns what least squares leave of each effort.
    fn residual(&self) -> Vec<f64> {
        residuals(&self.columns, &self.tau, &self.fit.values)
    }

    fn base_parameters(&self, model: &Model<'_>, meat: &DMatrix<f64>) -> Vec<BaseParameter> {
        let deviations = deviations(&self.fit, meat);
        let own = DVector::from_iterator(self.free.len(), self.free.iter().map(|i| self.file[*i]));
        let file = &self.base.map * own;
        let kinds: Vec<&str> = self
            .base
            .kept
            .iter()
            .map(|k| kind(self.base.free[*k]))
            .collect();
        let largest = |of: &str| {
            let own = kinds
                .iter()
                .zip(self.fit.values.iter())
                .filter(|(kind, _)| **kind == of);
            own.fold(0.0_f64, |m, (_, v)| m.max(v.abs()))
        };
        let names = self.base.names(model);
        let all = names.into_iter().enumerate();
        all.map(|(i, name)| {
            let (value, deviation) = (self.fit.values[i], deviations[i]);
            let seen = is_seen(value, deviation, largest(kinds[i]));
            BaseParameter {
                name,
                file: file[i],
                value,
                deviation,
                seen,
            }
        })
        .collect()
    }

    /// Returns K of the scaled columns for some of the free unknowns.
    fn scaled_map(&self, used: &[usize]) -> DMatrix<f64> {
        let mut map = self.base.map.select_columns(used);
        for (mut row, scale) in map.row_iter_mut().zip(&self.fit.scales) {
            row *= *scale;
        }
        map
    }

    /// Returns the problem of bodies.
    fn body_problem(&self, model: &Model<'_>, options: &Options) -> Posed {
        let of_all = &self.fit.r * self.scaled_map(&(0..self.free.len()).collect::<Vec<_>>());
        let shown = |i: usize| of_all.column(i).norm() > 1e-9;
        let is_link = |i: usize| matches!(self.base.free[i], Unknown::Link(..));
        let used: Vec<usize> = (0..self.free.len())
            .filter(|i| is_link(*i) || shown(*i))
            .collect();
        let left_out: Vec<Unknown> = (0..self.free.len())
            .filter(|i| !used.contains(i))
            .map(|i| self.base.free[i])
            .collect();
        let mut y = self.fit.y.clone();
        for unknown in &left_out {
            let i = self
                .base
                .free
                .iter()
                .position(|f| f == unknown)
                .expect("a free one");
            y -= of_all.column(i) * model.file(*unknown);
        }
        let (mut cones, mut positive, mut impossible) = (Vec::new(), Vec::new(), Vec::new());
        let mut start = DVector::zeros(used.len());
        for (at, i) in used.iter().enumerate() {
            match self.base.free[*i] {
                Unknown::Link(l, 0) => {
                    let (file, changed) = made_definite(&model.links[l].file);
                    if changed {
                        impossible.push(l);
                    }
                    start.fixed_rows_mut::<10>(at).copy_from(&file);
                    cones.extend(Cone::new(at, &file));
                }
                Unknown::Link(..) => {}
                Unknown::Joint(3, j) => start[at] = model.joints[j].file[3],
                Unknown::Joint(c, j) => {
                    start[at] = model.joints[j].file[c].max(0.01);
                    positive.push(at);
                }
            }
        }
        let rows = of_all.select_columns(&used);
        let solver = BodyProblem {
            rows,
            y,
            cones,
            positive,
            prior: options.prior.max(1e-9),
        };
        Posed {
            solver,
            start,
            impossible,
            left_out,
            used,
        }
    }

    fn numbers(
        &self,
        model: &Model<'_>,
        used: &[usize],
        values: &DVector<f64>,
        (cov, robust): (&DMatrix<f64>, &DMatrix<f64>),
        of_file: &DMatrix<f64>,
    ) -> Vec<Identified> {
        let all = used.iter().enumerate();
        all.map(|(at, i)| {
            let unknown = self.base.free[*i];
            let variance = cov[(at, at)].max(robust[(at, at)]);
            let from_log = match unknown {
                Unknown::Joint(..) => 1.0,
                Unknown::Link(_, k) => {
                    let block = of_file.fixed_view::<10, 10>(at - k, at - k);
                    let prior = block
                        .into_owned()
                        .try_inverse()
                        .map_or(f64::INFINITY, |inverse| inverse[(k, k)]);
                    (1.0 - variance / prior).clamp(0.0, 1.0)
                }
            };
            let (file, value) = (model.file(unknown), values[at]);
            Identified {
                unknown,
                file,
                value,
                deviation: variance.sqrt(),
                from_log,
            }
        })
        .collect()
    }

    pub(crate) fn judge(
        &self,
        model: &Model<'_>,
        found: &Identification,
        samples: Samples,
        last_third: bool,
    ) -> Judgement {
        let all = model.unknowns();
        let kept: Vec<usize> = self.base.kept.iter().map(|k| self.free[*k]).collect();
        let mut fixed = self.file.clone();
        self.free.iter().for_each(|i| fixed[*i] = 0.0);
        let mut of_bodies = self.file.clone();
        for number in &found.numbers {
            let at = all
                .iter()
                .position(|u| *u == number.unknown)
                .expect("an unknown");
            of_bodies[at] = number.value;
        }
        let of_base = &samples.rows * fixed + samples.rows.select_columns(&kept) * &self.fit.values;
        let efforts = [
            &samples.rows * &self.file,
            of_base,
            &samples.rows * of_bodies,
        ];
        let predicted = efforts.map(|e| e.as_slice().to_vec());
        let left = predicted.each_ref().map(|p| judge(&samples, p));
        Judgement {
            samples,
            last_third,
            predicted,
            left,
        }
    }
}

/// Returns the kind of a number: only numbers of a kind are compared.
fn kind(unknown: Unknown) -> &'static str {
    match unknown {
        Unknown::Link(_, 0) => "mass",
        Unknown::Link(_, 1..=3) => "moment",
        Unknown::Link(_, k) if PARAMETER_NAMES[k].starts_with('I') => "tensor",
        Unknown::Link(..) => "other",
        Unknown::Joint(c, _) => crate::model::JOINT_COLUMNS[c],
    }
}

/// Returns the covariance whose diagonal has the larger of both variances.
fn larger(mut cov: DMatrix<f64>, robust: &DMatrix<f64>) -> DMatrix<f64> {
    let factors: Vec<f64> = (0..cov.nrows())
        .map(|i| (robust[(i, i)] / cov[(i, i)]).max(1.0).sqrt())
        .map(|f| if f.is_finite() { f } else { 1.0 })
        .collect();
    for i in 0..cov.nrows() {
        for k in 0..cov.ncols() {
            cov[(i, k)] *= factors[i] * factors[k];
        }
    }
    cov
}

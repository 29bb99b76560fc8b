//! Bodies that can exist, nearest to those of the file where the log says nothing:
//!
//! minimise |R K θ − y|² + λ Σ_l |C_l Σ_l(θ) C_lᵀ − 1|² subject to C_l Σ_l C_lᵀ ⪰ ε 1, friction and rotors ≥ 0,
//!
//! with the pseudo-inertia Σ_l of link l and the inverse Cholesky factor C_l of that of the file: the distance is what
//! both geometric distances are to second order, and does not depend on units or frames. Solved by a barrier method:
//! − μ (Σ log det(C Σ Cᵀ − ε 1) + Σ log s) is added and μ divided by ten, with Newton steps between (Boyd and
//! Vandenberghe, Convex Optimization, 11.3). The function is convex.

use nalgebra::{DMatrix, DVector, Matrix4, SMatrix};

use crate::model::{BODY_PARAMETERS, Parameters};
use crate::pseudo_inertia::{pseudo_inertia, unit_inertias};

/// ε: the smallest eigenvalue, relative to the file's body.
const SMALLEST: f64 = 1e-3;
/// The first and the last μ.
const BARRIER: [f64; 2] = [1e2, 1e-7];
/// Newton steps for one μ.
const STEPS: usize = 40;

/// A link among the unknowns: the index of its first parameter, and C N_k Cᵀ for each parameter.
#[derive(Clone, Debug)]
pub struct Cone {
    first: usize,
    units: [Matrix4<f64>; BODY_PARAMETERS],
}

impl Cone {
    /// Returns the cone of a link with these parameters in the file; `None` if that body cannot exist.
    pub fn new(first: usize, file: &Parameters) -> Option<Self> {
        let c = pseudo_inertia(file).cholesky()?.l().try_inverse()?;
        let units = unit_inertias().map(|unit| c * unit * c.transpose());
        Some(Cone { first, units })
    }

    /// Returns C Σ Cᵀ.
    fn relative(&self, x: &DVector<f64>) -> Matrix4<f64> {
        let terms = self.units.iter().enumerate();
        terms.fold(Matrix4::zeros(), |sum, (k, unit)| {
            sum + unit * x[self.first + k]
        })
    }

    /// Returns the Hessian ½ ∂²|C Σ Cᵀ − 1|² of the distance, and half the negative gradient at zero.
    fn distance(&self) -> (SMatrix<f64, 10, 10>, Parameters) {
        let hessian = SMatrix::from_fn(|i, k| self.units[i].dot(&self.units[k]));
        let pull = Parameters::from_fn(|i, _| self.units[i].trace());
        (hessian, pull)
    }
}

/// The problem: a triangle of least squares, links, unknowns that are not negative.
#[derive(Clone, Debug)]
pub struct BodyProblem {
    /// R K.
    pub rows: DMatrix<f64>,
    /// Qᵀ y.
    pub y: DVector<f64>,
    /// The links.
    pub cones: Vec<Cone>,
    /// Unknowns that are not negative.
    pub positive: Vec<usize>,
    /// λ.
    pub prior: f64,
}

/// The solution.
#[derive(Clone, Debug)]
pub struct Bodies {
    /// The unknowns.
    pub values: DVector<f64>,
    /// Half the Hessian of the objective: the inverse of the covariance.
    pub hessian: DMatrix<f64>,
    /// The part of it that the file has.
    pub of_file: DMatrix<f64>,
    /// Newton steps.
    pub steps: usize,
}

impl BodyProblem {
    /// Solves from a start inside of all cones.
    pub fn solve(&self, start: DVector<f64>) -> Bodies {
        let (of_file, pull) = self.prior_terms();
        let hessian = self.rows.tr_mul(&self.rows) + &of_file;
        let linear = self.rows.tr_mul(&self.y) + pull;
        let value = |x: &DVector<f64>| x.dot(&(&hessian * x)) - 2.0 * linear.dot(x);
        let (mut x, mut steps, mut mu) = (start, 0, BARRIER[0]);
        while mu > BARRIER[1] {
            for _ in 0..STEPS {
                let (mut g, mut h) = (2.0 * (&hessian * &x - &linear), 2.0 * &hessian);
                self.add_barrier(&x, mu, &mut g, &mut h);
                let Some(direction) = newton(&h, &g) else {
                    break;
                };
                let decrement = -g.dot(&direction);
                steps += 1;
                if decrement < 1e-9 * mu {
                    break;
                }
                let now = value(&x) + mu * self.barrier(&x);
                let mut length = 1.0;
                let next = loop {
                    let next = &x + length * &direction;
                    let then = value(&next) + mu * self.barrier(&next);
                    if then <= now - 0.25 * length * decrement || length < 1e-10 {
                        break next;
                    }
                    length *= 0.5;
                };
                if length < 1e-10 {
                    break;
                }
                x = next;
                if decrement < 1e-6 * mu {
                    break;
                }
            }
            mu /= 10.0;
        }
        Bodies {
            values: x,
            hessian,
            of_file,
            steps,
        }
    }

    fn prior_terms(&self) -> (DMatrix<f64>, DVector<f64>) {
        let n = self.rows.ncols();
        let (mut hessian, mut pull) = (DMatrix::zeros(n, n), DVector::zeros(n));
        for cone in &self.cones {
            let (own, towards) = cone.distance();
            let f = cone.first;
            hessian
                .fixed_view_mut::<10, 10>(f, f)
                .copy_from(&(self.prior * own));
            pull.fixed_rows_mut::<10>(f)
                .copy_from(&(self.prior * towards));
        }
        (hessian, pull)
    }

    /// Returns the barrier; infinite outside.
    fn barrier(&self, x: &DVector<f64>) -> f64 {
        let mut sum = 0.0;
        for cone in &self.cones {
            let inside = cone.relative(x) - Matrix4::identity() * SMALLEST;
            match inside.cholesky() {
                Some(factor) => sum -= 2.0 * factor.l().diagonal().map(f64::ln).sum(),
                None => return f64::INFINITY,
            }
        }
        for &i in &self.positive {
            match x[i] > 0.0 {
                true => sum -= x[i].ln(),
                false => return f64::INFINITY,
            }
        }
        sum
    }

    /// Adds gradient and Hessian of μ times the barrier: of −log det P, −tr(P⁻¹N_i) and tr(P⁻¹N_i P⁻¹N_k).
    fn add_barrier(&self, x: &DVector<f64>, mu: f64, g: &mut DVector<f64>, h: &mut DMatrix<f64>) {
        for cone in &self.cones {
            let inside = cone.relative(x) - Matrix4::identity() * SMALLEST;
            let Some(inverse) = inside.try_inverse() else {
                continue;
            };
            let turned = cone.units.map(|unit| inverse * unit);
            for i in 0..BODY_PARAMETERS {
                g[cone.first + i] -= mu * turned[i].trace();
                for k in 0..BODY_PARAMETERS {
                    let both = turned[i].dot(&turned[k].transpose());
                    h[(cone.first + i, cone.first + k)] += mu * both;
                }
            }
        }
        for &i in &self.positive {
            g[i] -= mu / x[i];
            h[(i, i)] += mu / (x[i] * x[i]);
        }
    }
}

/// Returns −H⁻¹ g, of the Hessian with its diagonal scaled to 1.
fn newton(h: &DMatrix<f64>, g: &DVector<f64>) -> Option<DVector<f64>> {
    let scale = h.diagonal().map(|x| 1.0 / x.max(1e-300).sqrt());
    let scaled = DMatrix::from_fn(h.nrows(), h.ncols(), |i, k| h[(i, k)] * scale[i] * scale[k]);
    let right = -g.component_mul(&scale);
    let solved = match scaled.clone().cholesky() {
        Some(factor) => factor.solve(&right),
        None => scaled.lu().solve(&right)?,
    };
    Some(solved.component_mul(&scale))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pseudo_inertia::{from_centre, smallest_eigenvalue};
    use nalgebra::{Matrix3, Vector3};

    fn file() -> Parameters {
        let tensor = Matrix3::from_diagonal(&Vector3::new(0.03, 0.04, 0.05));
        from_centre(2.0, &Vector3::new(0.1, 0.0, 0.05), &tensor)
    }

    fn problem(row: [f64; 10], y: f64, prior: f64) -> Bodies {
        let cone = Cone::new(0, &file()).expect("a body");
        let (rows, y) = (
            DMatrix::from_row_slice(1, 10, &row),
            DVector::from_element(1, y),
        );
        let problem = BodyProblem {
            rows,
            y,
            cones: vec![cone],
            positive: vec![],
            prior,
        };
        problem.solve(DVector::from_column_slice(file().as_slice()))
    }

    #[test]
    fn without_a_log_the_body_is_that_of_the_file() {
        let found = problem([0.0; 10], 0.0, 1.0).values;
        let file = DVector::from_column_slice(file().as_slice());
        assert!((found - file).amax() < 1e-6);
    }

    #[test]
    fn what_the_log_says_is_kept_and_impossible_bodies_are_not() {
        // The log says: the mass is 3 kg.
        let mut row = [0.0; 10];
        row[0] = 1e4;
        let found = problem(row, 3e4, 1.0).values;
        assert!((found[0] - 3.0).abs() < 1e-4, "{found}");
        // The log says: Izz is larger than Ixx + Iyy can be with this little prior; the result is a body still.
        let mut row = [0.0; 10];
        (row[4], row[6], row[9]) = (-1e3, -1e3, 1e3);
        let found = problem(row, 0.2e3, 1e-3).values;
        assert!(smallest_eigenvalue(&Parameters::from_column_slice(found.as_slice())) > 0.0);
    }
}

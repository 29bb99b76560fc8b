//! Solves forward dynamics at one state in double-double, with the norms that bound rounding errors.

use std::cell::OnceCell;

use bgdyn_runtime::{Dd, Scalar};

use super::rounding_error::in_double_double;
use crate::expr::Inputs;

/// A pivot smaller than this fraction of its diagonal entry is a rounding error of double-double.
const SINGULAR: f64 = 1e-28;

/// Number of steps of the power iteration, which converges to the norm from below: with 8, to within a
/// factor of 1.2 if eigenvalues are close, to all digits otherwise.
const STEPS: usize = 8;

/// M and h of a state, in double-double.
pub(super) struct MassAndBias {
    /// M
    pub mass: Vec<Vec<Dd>>,
    /// h: the efforts at q̈ = 0.
    pub bias: Vec<Dd>,
}

impl MassAndBias {
    /// Takes the lower triangle of M, row by row, followed by h.
    pub fn new(values: &[Dd], n: usize) -> Self {
        let (triangle, bias) = values.split_at(values.len() - n);
        let at = |i: usize, j: usize| triangle[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
        MassAndBias {
            mass: (0..n).map(|i| (0..n).map(|j| at(i, j)).collect()).collect(),
            bias: bias.to_vec(),
        }
    }

    /// Returns M a + h.
    fn efforts(&self, a: &[f64]) -> Vec<f64> {
        let a: Vec<Dd> = a.iter().map(|&a| Dd::from_f64(a)).collect();
        let efforts = product(&self.mass, &a);
        let efforts = efforts.iter().zip(&self.bias).map(|(&x, &h)| x + h);
        efforts.map(Dd::to_f64).collect()
    }

    /// Returns the efforts minus h, which accelerate the mechanism.
    fn drive(&self, efforts: &[Dd]) -> Vec<Dd> {
        let drive = efforts.iter().zip(&self.bias);
        drive.map(|(&u, &h)| u - h).collect()
    }
}

/// The effects of rounding each argument by half an eps of itself: the sums over all arguments.
#[derive(Default)]
pub(super) struct Rounding {
    /// Changes of each joint's effort at the exact accelerations.
    pub efforts: Vec<f64>,
    /// Change of ‖q̈‖.
    pub accelerations: f64,
}

/// A state and its exact solution.
pub(super) struct ReferenceSolution {
    /// The state.
    pub inputs: Inputs<f64>,
    /// M
    pub mass: Vec<Vec<Dd>>,
    /// h: the efforts at q̈ = 0.
    pub bias: Vec<f64>,
    /// q̈ under the efforts of the state.
    pub exact: Vec<Dd>,
    /// The effects of rounding the arguments, computed on demand.
    rounding: OnceCell<Rounding>,
    /// Whether the efforts were computed from the state's accelerations, and rounded.
    pub round_trip: bool,
    /// ‖M‖
    pub most: f64,
    /// ‖M⁻¹‖
    pub inverse: f64,
}

impl ReferenceSolution {
    /// Solves a state; `terms` computes M and h at any arguments. For a `round_trip` the efforts of the
    /// state are computed from its accelerations and rounded. `None` if M is singular.
    pub fn new(
        mut inputs: Inputs<f64>,
        terms: impl Fn(&Inputs<Dd>) -> MassAndBias,
        round_trip: bool,
    ) -> Option<Self> {
        let here = terms(&in_double_double(&inputs));
        if round_trip {
            inputs.u = here.efforts(&inputs.a);
        }
        let factor = CholeskyFactor::new(here.mass.clone())?;
        let exact = factor.solve(here.drive(&in_double_double(&inputs).u));
        let rough: Vec<Vec<f64>> = rows(&here.mass, Dd::to_f64);
        let rough_factor = factor.rounded();
        let n = exact.len();
        Some(ReferenceSolution {
            rounding: OnceCell::new(),
            bias: here.bias.iter().map(|h| h.to_f64()).collect(),
            most: spectral_norm(n, |x| product(&rough, &x)),
            inverse: spectral_norm(n, |x| rough_factor.solve(x)),
            inputs,
            mass: here.mass,
            exact,
            round_trip,
        })
    }

    /// Returns the effects of rounding the arguments; `terms` as for [`ReferenceSolution::new`]. They are
    /// computed at the first call, with two evaluations of M and h per joint.
    pub fn rounding(&self, terms: impl Fn(&Inputs<Dd>) -> MassAndBias) -> &Rounding {
        self.rounding.get_or_init(|| self.rounded(terms))
    }

    fn rounded(&self, terms: impl Fn(&Inputs<Dd>) -> MassAndBias) -> Rounding {
        let here = in_double_double(&self.inputs);
        let n = self.exact.len();
        let half = Dd::from_f64(f64::EPSILON / 2.0);
        let mut sum = Rounding {
            efforts: vec![0.0; n],
            accelerations: 0.0,
        };
        let positions = (0..here.q.len()).map(|p| (p, false));
        for (joint, velocity) in positions.chain((0..n).map(|j| (j, true))) {
            let mut inputs = here.clone();
            let of = if velocity {
                &mut inputs.v
            } else {
                &mut inputs.q
            };
            if of[joint] == Dd::ZERO {
                continue;
            }
            of[joint] *= Dd::ONE + half;
            let there = terms(&inputs);
            if let Some(factor) = CholeskyFactor::new(there.mass.clone()) {
                let found = factor.solve(there.drive(&here.u));
                let by = found.iter().zip(&self.exact);
                sum.accelerations += norm(by.map(|(&x, &y)| (x - y).to_f64()));
            }
            let met = product(&there.mass, &self.exact);
            let met = met.iter().zip(&there.bias).map(|(&x, &h)| x + h);
            for (i, (met, &u)) in met.zip(&here.u).enumerate() {
                sum.efforts[i] += (met - u).to_f64().abs();
            }
        }
        if let Some(factor) = CholeskyFactor::new(self.mass.clone()) {
            for joint in 0..n {
                let mut efforts = vec![Dd::ZERO; n];
                efforts[joint] = here.u[joint] * half;
                let by = factor.solve(efforts);
                sum.accelerations += norm(by.iter().map(|x| x.to_f64()));
            }
        }
        sum
    }
}

fn rows<T: Copy, U>(m: &[Vec<T>], f: impl Fn(T) -> U + Copy) -> Vec<Vec<U>> {
    m.iter()
        .map(|row| row.iter().map(|&x| f(x)).collect())
        .collect()
}

/// The numerical factors of M = Lᵀ D L, from the last coordinate to the first.
struct CholeskyFactor<T> {
    /// L below its unit diagonal, D⁻¹ on the diagonal.
    l: Vec<Vec<T>>,
}

impl CholeskyFactor<Dd> {
    /// Factors M; `None` if a pivot is lost.
    fn new(mut m: Vec<Vec<Dd>>) -> Option<Self> {
        let n = m.len();
        let diagonal: Vec<f64> = (0..n).map(|k| m[k][k].to_f64()).collect();
        for k in (0..n).rev() {
            let pivot = m[k][k].to_f64();
            if !pivot.is_finite() || pivot <= SINGULAR * diagonal[k] {
                return None;
            }
            m[k][k] = Dd::ONE / m[k][k];
            let row = m[k].clone();
            for i in (0..k).filter(|&i| row[i] != Dd::ZERO) {
                let l = row[i] * row[k];
                for j in 0..=i {
                    m[i][j] -= l * row[j];
                }
                m[k][i] = l;
            }
        }
        Some(CholeskyFactor { l: m })
    }

    fn rounded(&self) -> CholeskyFactor<f64> {
        CholeskyFactor {
            l: rows(&self.l, Dd::to_f64),
        }
    }
}

impl<T: Scalar> CholeskyFactor<T> {
    /// Solves M x = f: Lᵀ y = f, then L x = D⁻¹ y.
    fn solve(&self, mut x: Vec<T>) -> Vec<T> {
        let n = x.len();
        for k in (0..n).rev() {
            for i in 0..k {
                x[i] = x[i] - self.l[k][i] * x[k];
            }
        }
        for k in 0..n {
            x[k] = x[k] * self.l[k][k];
            for i in 0..k {
                x[k] = x[k] - self.l[k][i] * x[i];
            }
        }
        x
    }
}

/// Returns m x.
pub(super) fn product<T: Scalar>(m: &[Vec<T>], x: &[T]) -> Vec<T> {
    let row = |row: &Vec<T>| {
        let terms = row.iter().zip(x).map(|(&m, &x)| m * x);
        terms.fold(T::from_f64(0.0), |sum, term| sum + term)
    };
    m.iter().map(row).collect()
}

/// Returns √(x·x), without intermediate overflow.
pub(super) fn norm(x: impl Iterator<Item = f64> + Clone) -> f64 {
    let most = x.clone().fold(0.0, |most: f64, x| most.max(x.abs()));
    if most == 0.0 || !most.is_finite() {
        return most;
    }
    most * x.map(|x| (x / most) * (x / most)).sum::<f64>().sqrt()
}

/// Returns the largest eigenvalue of a positive definite matrix, by power iteration.
fn spectral_norm(n: usize, product: impl Fn(Vec<f64>) -> Vec<f64>) -> f64 {
    // A start vector that is orthogonal to no eigenvector of a symmetric mechanism.
    let mut x: Vec<f64> = (0..n).map(|i| 1.0 + 0.37 * (i as f64).sin()).collect();
    let mut largest = 0.0;
    for _ in 0..STEPS {
        let size = norm(x.iter().copied());
        x.iter_mut().for_each(|x| *x /= size);
        x = product(x);
        largest = norm(x.iter().copied());
    }
    largest
}

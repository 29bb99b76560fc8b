//! The law of forward dynamics, for one mechanism in one state: it is the inverse of inverse dynamics.

use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;
use nalgebra::{DMatrix, DVector};

use super::laws::Case;
use super::{State, full};

impl Case {
    /// Checks that forward dynamics is the inverse of inverse dynamics; a singular mass matrix is refused,
    /// and never gives huge numbers. Returns the error of the regular case in units of the bar.
    pub fn forward(&self) -> Option<f64> {
        let n = self.state.q.len();
        let efforts: Vec<f64> = self.literal.value(Method::InverseDynamics, &self.state);
        let bias: Vec<f64> = self.literal.value(Method::Bias, &self.state);
        let rows: Vec<Vec<f64>> = full(&self.literal.value(Method::MassMatrix, &self.state), n);
        let mass = DMatrix::from_fn(n, n, |i, j| rows[i][j]);
        let moments = mass.symmetric_eigenvalues();
        let (least, most) = (moments.min(), moments.max());
        let state = State {
            tau: efforts,
            ..self.state.clone()
        };
        let pivot = least_pivot(self.literal.mass(&self.state));
        let mut worst = 0.0_f64;
        let a = DVector::from_row_slice(&self.state.a);
        // The literal M does not fold enough to detect every singular one, and an elimination of M may miss
        // consecutive massless links; they are not generated in such cases. Articulated bodies miss none.
        let literal = self.literal.function(Method::ForwardDynamics);
        let ways = self.ways(Method::ForwardDynamics).chain([literal]);
        let ways = ways.map(|f| (f, articulated(f)));
        for (function, sure) in ways.chain([(&self.chosen, true)]) {
            let (found, refused) = function.evaluate(state.inputs::<f64>());
            let place = self.place(&format!("forward dynamics, {}", function.formulation));
            let finite = found.iter().all(|x| x.is_finite());
            assert!(finite || refused.is_some(), "{}: {found:?}", place());
            if pivot < 1e-25 {
                // Either singular at this q, at any precision; or regular with a small pivot, for axes
                // that are almost parallel: then there is a solution, without huge numbers. Without
                // snapping, axes may differ by 1e-15; their pivot of 1e-30 is below the digits of the
                // literal M.
                let regular = pivot > 0.0 || self.draft.exact;
                let solved = regular && self.solves(&state, &found);
                assert!(
                    refused.is_some() || !sure || solved,
                    "{}: {found:?}",
                    place()
                );
                continue;
            }
            if least <= 1e-13 * most {
                continue; // regular, but beyond the digits of `f64`: may be refused or solved
            }
            assert_eq!(refused, None, "{}: eigenvalues {moments}", place());
            // ‖FD(ID(a)) − a‖ ≤ 8 n eps ‖M⁻¹‖ (‖M‖‖a‖ + ‖h‖); if terms of h cancel, the bound uses their
            // size.
            let h = DVector::from_row_slice(&bias);
            let size = 8.0 * n as f64 * (most * a.norm() + h.norm()) + self.effort;
            let bar = f64::EPSILON * size / least;
            let off = (DVector::from_vec(found) - &a).norm();
            assert!(off <= bar, "{}: off by {off:e}, bar {bar:e}", place());
            worst = worst.max(off / bar.max(f64::MIN_POSITIVE));
            // In double-double it is the inverse of the literal sum, with efforts in full precision.
            let mut inputs = state.inputs::<Dd>();
            inputs.u = self.literal.value(Method::InverseDynamics, &self.state);
            let (found, _) = function.evaluate(inputs);
            let off = found.iter().zip(&self.state.a);
            let off = off.map(|(&x, &a)| (x - Dd::from_f64(a)).to_f64());
            let off = DVector::from_iterator(n, off).norm();
            let bar = self.exact() * size / least;
            assert!(off <= bar, "{}: off by {off:e}, bar {bar:e}", place());
        }
        (least > 1e-13 * most).then_some(worst)
    }

    /// Returns whether accelerations give the efforts of a state, within the effect of rounding.
    fn solves(&self, state: &State, accelerations: &[f64]) -> bool {
        let with = |a: &[f64]| State {
            a: a.to_vec(),
            ..state.clone()
        };
        let efforts =
            |a: &[f64]| -> Vec<Dd> { self.literal.value(Method::InverseDynamics, &with(a)) };
        let (led_to, still) = (efforts(accelerations), vec![0.0; accelerations.len()]);
        let mass = self.literal.mass::<Dd>(state);
        let bias = efforts(&still);
        let n = accelerations.len() as f64;
        (0..accelerations.len()).all(|i| {
            let moved = mass[i].iter().zip(accelerations);
            let size: f64 = moved.map(|(m, a)| (m.to_f64() * a).abs()).sum();
            let size = size + bias[i].to_f64().abs() + self.effort;
            let off = (led_to[i] - Dd::from_f64(state.tau[i])).to_f64().abs();
            off <= 8.0 * n * f64::EPSILON * size
        })
    }
}

/// Returns whether a function of forward dynamics computes the pivots body by body.
fn articulated(function: &Function) -> bool {
    function.formulation.starts_with("articulated")
}

/// Returns the least pivot of M = LᵀDL in double-double, with the diagonal entry it was computed from; 0
/// if it has no correct digit in double-double either.
fn least_pivot(mut mass: Vec<Vec<Dd>>) -> f64 {
    let diagonal: Vec<Dd> = (0..mass.len()).map(|k| mass[k][k]).collect();
    let mut least = f64::INFINITY;
    for k in (0..mass.len()).rev() {
        let pivot = mass[k][k];
        let share = (pivot / diagonal[k]).to_f64();
        if share.is_nan() || share < 1e-29 {
            return 0.0;
        }
        least = least.min(share);
        for i in 0..k {
            for j in 0..k {
                mass[i][j] = mass[i][j] - mass[k][i] / pivot * mass[k][j];
            }
        }
    }
    least
}

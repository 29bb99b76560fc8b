//! The integrator DOP853 by Hairer and Wanner, after Dormand and Prince (1989).

mod coefficients;

use bgdyn_runtime::{Scalar, StateVector};
use coefficients::{DENSE, FIFTH, MORE, STAGES, THIRD, WEIGHTS};

use crate::dense::Dense;
use crate::failure::Reason;
use crate::integrator::{Integrator, IntegratorInfo, Start, Step};
use crate::ode::Ode;
use crate::real::{Of, Real, largest};
use crate::tableau::{all, combined, fill};

/// DOP853: order 8 with estimates of orders 5 and 3, dense output of order 7 (Hairer, Nørsett,
/// Wanner, Solving Ordinary Differential Equations I, 1993, II.5, II.6 and II.10).
///
/// For smooth, nonstiff scenes at tolerances of 1e-7 or smaller. The printed coefficients have 28 to 30
/// digits; in double-double an error of some 1e-30 per second remains.
#[derive(Clone, Copy, Debug, Default)]
pub struct Dop853;

/// Rates at the twelve stages and at the end.
type Rates<Y> = [Y; 13];

impl<Y: StateVector> Integrator<Y> for Dop853
where
    Of<Y>: Real,
{
    type Stages = Rates<Y>;

    fn info(&self) -> IntegratorInfo {
        IntegratorInfo {
            name: "dop853",
            order: 8,
            estimate: Some(8),
            looks: 8,
            reads_jacobian: false,
        }
    }

    fn step<O: Ode<State = Y>>(
        &self,
        ode: &O,
        from: &Start<'_, Y, Rates<Y>>,
        h: Of<Y>,
    ) -> Result<Step<Y, Rates<Y>>, Reason<O::Error>> {
        let known = from.before.map(|step| &step.stages[12]);
        let stages: Rates<Y> = all(ode, from, known, h, &STAGES)?;
        Ok(Step {
            h,
            change: combined(&WEIGHTS, &stages).times(h),
            stages,
        })
    }

    /// Returns h e₅²/√(e₅² + 0.01 e₃²), which is proportional to the eighth power of the step.
    fn error(&self, step: &Step<Y, Rates<Y>>, scale: &Y) -> Option<Of<Y>> {
        let [zero, one, small] = [0.0, 1.0, 0.01].map(Of::<Y>::from_f64);
        let fifth = combined(&FIFTH, &step.stages);
        let third = combined(&WEIGHTS, &step.stages).plus(-one, &combined(&THIRD, &step.stages));
        let [fifth, third] = [fifth, third].map(|error| largest(&error, scale));
        let both = (fifth * fifth + small * third * third).sqrt();
        Some(if both == zero {
            zero
        } else {
            step.h.abs() * fifth * (fifth / both)
        })
    }

    fn dense<O: Ode<State = Y>>(
        &self,
        ode: &O,
        from: &Start<'_, Y, Rates<Y>>,
        step: &Step<Y, Rates<Y>>,
    ) -> Result<Dense<Y>, Reason<O::Error>> {
        let k = &step.stages;
        let mut rates: [Y; 16] = core::array::from_fn(|i| k[i.min(12)].clone());
        fill(ode, (from.t, from.y), step.h, &MORE, &mut rates)?;
        let mut terms = Dense::cubic(step.h, &step.change, &k[0], &k[12]);
        for (term, weights) in terms[3..].iter_mut().zip(&DENSE) {
            *term = Some(combined(weights, &rates).times(step.h));
        }
        Ok(Dense::new(from.t, step.h, from.y, terms))
    }
}

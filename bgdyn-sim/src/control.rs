//! Step control: chooses the longest steps that the tolerance permits.

use bgdyn_runtime::{Scalar, StateVector};

use crate::ode::{Ode, ScalarOf};
use crate::real::{Of, Real, largest};

/// The permitted error of a step: `absolute` + `relative`·|y|, component by component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance<T> {
    /// Absolute error, in the component's unit.
    pub absolute: T,
    /// Error relative to the component's size.
    pub relative: T,
}

impl<T: Real> Tolerance<T> {
    /// Returns the permitted error of a step between two states, by component.
    pub(crate) fn scale<Y: StateVector<Scalar = T>>(&self, from: &Y, to: &Y) -> Y {
        let mut scale = from.clone();
        for (s, y) in scale.entries_mut().iter_mut().zip(to.entries()) {
            *s = self.absolute + self.relative * s.abs().max(y.abs());
        }
        scale
    }
}

/// A proportional-integral controller of the step size (Gustafsson 1991; Hairer, Wanner II, IV.2): the
/// next step is h·0.9·e^−α·e₋₁^β with the errors e of this step and e₋₁ of the last accepted one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Controller {
    /// 1/q for an error proportional to h^q.
    power: f64,
    /// Error of the last accepted step.
    last: f64,
    /// Whether the previous step was refused.
    refused: bool,
}

/// The smallest and the largest ratio of consecutive steps.
const RATIOS: (f64, f64) = (0.2, 6.0);
/// Errors below this value count as this value, so that one small error does not make the next step too
/// long.
const LEAST_ERROR: f64 = 1e-4;

impl Controller {
    /// Returns a controller for an error proportional to this power of the step.
    pub(crate) fn new(estimate: u32) -> Self {
        Controller {
            power: 1.0 / f64::from(estimate),
            last: LEAST_ERROR,
            refused: false,
        }
    }

    /// Discards the history of steps, because the equation has changed.
    pub(crate) fn restart(&mut self) {
        *self = Controller {
            last: LEAST_ERROR,
            ..*self
        };
    }

    /// Returns the error of the last accepted step.
    pub(crate) fn last(&self) -> f64 {
        self.last
    }

    /// Returns whether a step with this error, in units of the tolerance, is accepted, and the ratio of
    /// the next step to this one.
    pub(crate) fn judge(&mut self, error: f64) -> (bool, f64) {
        let beta = 0.2 * self.power;
        let alpha = self.power - 0.75 * beta;
        let power = |x: f64, p: f64| Scalar::exp(p * Scalar::ln(x));
        if error <= 1.0 {
            let error = error.max(LEAST_ERROR);
            let ratio = 0.9 * power(error, -alpha) * power(self.last, beta);
            let most = if self.refused { 1.0 } else { RATIOS.1 };
            (self.last, self.refused) = (error, false);
            (true, ratio.clamp(RATIOS.0, most))
        } else {
            self.refused = true;
            // An error that is not finite gives no ratio.
            let ratio = if error.is_finite() {
                0.9 * power(error, -alpha)
            } else {
                RATIOS.0
            };
            (false, ratio.clamp(RATIOS.0, 0.9))
        }
    }

    /// Returns the ratio of the next step after a step that failed without an error estimate.
    pub(crate) fn failed(&mut self) -> f64 {
        self.judge(f64::INFINITY).1
    }
}

/// Returns the first step, from the sizes of the state, its rates and their change (Hairer, Nørsett,
/// Wanner I, II.4).
///
/// # Errors
/// If the rates do not exist.
pub(crate) fn first_step<O: Ode>(
    ode: &O,
    (t, y): (ScalarOf<O>, &O::State),
    tolerance: &Tolerance<ScalarOf<O>>,
    order: u32,
    most: ScalarOf<O>,
) -> Result<ScalarOf<O>, O::Error>
where
    ScalarOf<O>: Real,
{
    let one = Of::<O::State>::from_f64(1.0);
    let scale = tolerance.scale(y, y);
    let size = |x: &O::State| largest(x, &scale).to_f64();
    let rates = ode.rates(t, y)?;
    let (d0, d1) = (size(y), size(&rates));
    let guess = if d0 < 1e-5 || d1 < 1e-5 {
        1e-6
    } else {
        0.01 * d0 / d1
    };
    let guess = guess.min(most.to_f64().abs());
    let h = Of::<O::State>::from_f64(guess);
    let there = ode.rates(t + h, &y.plus(h, &rates))?;
    let d2 = size(&there.plus(-one, &rates)) / guess;
    let steepest = d1.max(d2);
    let long = if steepest <= 1e-15 {
        (guess * 1e-3).max(1e-6)
    } else {
        Scalar::exp(Scalar::ln(0.01 / steepest) / f64::from(order + 1))
    };
    Ok(Of::<O::State>::from_f64(long.min(100.0 * guess)))
}

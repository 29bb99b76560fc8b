//! Dense output: interpolation of the states within a step.

use bgdyn_runtime::{Scalar, StateVector};

use crate::real::Of;

/// The largest number of terms of a polynomial: those of degree 7.
const TERMS: usize = 7;

/// The states within a step from t to t + h, as a polynomial in θ = (time − t)/h:
///
/// y + θ (r₁ + (1 − θ) (r₂ + θ (r₃ + (1 − θ) (r₄ + …))))
///
/// It is y at θ = 0 and y + r₁ at θ = 1 (Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations
/// I, II.6).
#[derive(Clone, Debug)]
pub struct Dense<Y: StateVector> {
    t: Of<Y>,
    h: Of<Y>,
    y: Y,
    terms: [Option<Y>; TERMS],
}

impl<Y: StateVector> Dense<Y> {
    /// Returns the polynomial over the step of length `h` from `y` at time `t` with these terms; terms
    /// after the first `None` are ignored.
    pub fn new(t: Of<Y>, h: Of<Y>, y: &Y, terms: [Option<Y>; TERMS]) -> Self {
        let y = y.clone();
        Dense { t, h, y, terms }
    }

    /// Returns the terms of Hermite's cubic: a step by `change` with these rates at its ends.
    pub fn cubic(h: Of<Y>, change: &Y, first: &Y, last: &Y) -> [Option<Y>; TERMS] {
        let one = Of::<Y>::from_f64(1.0);
        let second = first.times(h).plus(-one, change);
        let third = change.plus(-h, last).plus(-one, &second);
        let change = Some(change.clone());
        [change, Some(second), Some(third), None, None, None, None]
    }

    /// Returns the start time of the step.
    pub fn start(&self) -> Of<Y> {
        self.t
    }

    /// Returns the length of the step.
    pub fn length(&self) -> Of<Y> {
        self.h
    }

    /// Returns the state at t + θh, for θ from 0 to 1.
    pub fn at(&self, theta: Of<Y>) -> Y {
        let rest = Of::<Y>::from_f64(1.0) - theta;
        let mut sum: Option<Y> = None;
        for (i, term) in self.terms.iter().enumerate().rev() {
            let Some(term) = term else { continue };
            // The nested bracket after each term is multiplied by 1 − θ and θ in turn.
            let factor = if i % 2 == 0 { rest } else { theta };
            sum = Some(match sum {
                Some(inner) => term.plus(factor, &inner),
                None => term.clone(),
            });
        }
        sum.map_or_else(|| self.y.clone(), |sum| self.y.plus(theta, &sum))
    }

    /// Returns the state at a time within the step.
    pub fn at_time(&self, t: Of<Y>) -> Y {
        self.at((t - self.t) / self.h)
    }
}

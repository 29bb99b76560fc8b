//! Dual numbers: a value and its exact rate along a direction; of dual numbers, the second derivative along two.

use std::ops::{Add, Div, Mul, Neg, Sub};

use bgdyn_runtime::{Dd, Look, Scalar};
use nalgebra::SVector;

use crate::expr::Inputs;

/// A number x + ε dx with ε² = 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Dual<T = Dd> {
    value: T,
    rate: T,
}

/// A direction of motion: rates of positions, velocities, first-order states and time.
pub(super) struct Direction {
    pub q: Vec<Dd>,
    pub v: Vec<Dd>,
    pub x: Vec<Dd>,
    pub t: Dd,
}

/// Returns the state with its rates along the direction. Accelerations, inputs, modes and parameters have
/// zero rates.
pub(super) fn along(at: &Inputs<Dd>, direction: &Direction) -> Inputs<Dual> {
    Inputs {
        q: with_rates(&at.q, &direction.q),
        v: with_rates(&at.v, &direction.v),
        x: with_rates(&at.x, &direction.x),
        t: at.t.map(|t| Dual::new(t, direction.t)),
        a: constants(&at.a),
        u: constants(&at.u),
        modes: constants(&at.modes),
        parameters: constants(&at.parameters),
        passed: vec![],
    }
}

/// Combines values and their rates.
pub(super) fn with_rates<T: Copy>(values: &[T], rates: &[T]) -> Vec<Dual<T>> {
    assert_eq!(values.len(), rates.len());
    let pairs = values.iter().zip(rates);
    pairs.map(|(&x, &dx)| Dual::new(x, dx)).collect()
}

/// Returns the values of results.
pub(super) fn values<T: Copy>(results: &[Dual<T>]) -> Vec<T> {
    results.iter().map(|x| x.value).collect()
}

/// Returns the rates of results.
pub(super) fn rates<T: Copy>(results: &[Dual<T>]) -> Vec<T> {
    results.iter().map(|x| x.rate).collect()
}

/// Returns numbers with zero rates.
pub(super) fn constants<T: Scalar>(values: &[T]) -> Vec<Dual<T>> {
    let zero = T::from_f64(0.0);
    values.iter().map(|&x| Dual::new(x, zero)).collect()
}

impl<T> Dual<T> {
    fn new(value: T, rate: T) -> Self {
        Dual { value, rate }
    }
}

impl<T: Scalar> Add for Dual<T> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Dual::new(self.value + other.value, self.rate + other.rate)
    }
}

impl<T: Scalar> Sub for Dual<T> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Dual::new(self.value - other.value, self.rate - other.rate)
    }
}

impl<T: Scalar> Mul for Dual<T> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let rate = self.rate * other.value + self.value * other.rate;
        Dual::new(self.value * other.value, rate)
    }
}

impl<T: Scalar> Div for Dual<T> {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Dual::new(value, (self.rate - value * other.rate) / other.value)
    }
}

impl<T: Scalar> Neg for Dual<T> {
    type Output = Self;

    fn neg(self) -> Self {
        Dual::new(-self.value, -self.rate)
    }
}

/// At a kink of a function, the rate is that of the branch of the value.
impl<S: Scalar<Mask = bool, Refused = Option<usize>>> Scalar for Dual<S> {
    type Mask = bool;
    type Refused = Option<usize>;
    type Singular<const N: usize> = ();

    fn from_f64(x: f64) -> Self {
        Dual::new(S::from_f64(x), S::from_f64(0.0))
    }

    fn from_parts(hi: f64, lo: f64) -> Self {
        Dual::new(S::from_parts(hi, lo), S::from_f64(0.0))
    }

    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }

    fn sqrt(self) -> Self {
        let root = Scalar::sqrt(self.value);
        Dual::new(root, self.rate / (root + root))
    }

    fn sin_cos(self) -> (Self, Self) {
        Self::sin_cos_sum(&[self], (0.0, 0.0))
    }

    fn sin_cos_sum(angles: &[Self], offset: (f64, f64)) -> (Self, Self) {
        let rate = angles.iter().fold(S::from_f64(0.0), |sum, a| sum + a.rate);
        let (sine, cosine) = S::sin_cos_sum(&values(angles), offset);
        let sine_and_rate = Dual::new(sine, cosine * rate);
        (sine_and_rate, Dual::new(cosine, -sine * rate))
    }

    fn exp(self) -> Self {
        let value = Scalar::exp(self.value);
        Dual::new(value, value * self.rate)
    }

    fn ln(self) -> Self {
        Dual::new(Scalar::ln(self.value), self.rate / self.value)
    }

    fn tanh(self) -> Self {
        let value = Scalar::tanh(self.value);
        Dual::new(value, (S::from_f64(1.0) - value * value) * self.rate)
    }

    fn abs(self) -> Self {
        if self.value.less(S::from_f64(0.0)) {
            -self
        } else {
            self
        }
    }

    fn min(self, other: Self) -> Self {
        if other.value.less(self.value) {
            other
        } else {
            self
        }
    }

    fn max(self, other: Self) -> Self {
        if self.value.less(other.value) {
            other
        } else {
            self
        }
    }

    fn sign(self) -> Self {
        Dual::new(Scalar::sign(self.value), S::from_f64(0.0))
    }

    fn less(self, other: Self) -> bool {
        self.value.less(other.value)
    }

    fn select(mask: bool, a: Self, b: Self) -> Self {
        if mask { a } else { b }
    }

    fn none_refused() -> Option<usize> {
        None
    }

    fn checked_pivot(self, magnitude: Self, joint: usize, refused: &mut Option<usize>) -> Self {
        let value = Scalar::checked_pivot(self.value, magnitude.value, joint, refused);
        Dual::new(value, self.rate)
    }

    fn succeeded<const N: usize>(_: &SVector<Self, N>, refused: Option<usize>) -> bool {
        refused.is_none()
    }

    fn failed<const N: usize>(
        _: SVector<Self, N>,
        _: Option<usize>,
        _: &'static [&'static str],
        _: impl FnOnce(&mut Look<'_, Self>),
    ) -> Option<()> {
        Some(())
    }
}

//! An `f64` that counts its operations.

use std::cell::Cell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use bgdyn::nalgebra::SVector;
use bgdyn::runtime::Look;
use bgdyn::runtime::Operations;
use bgdyn::{Scalar, Singular};

thread_local! {
    static COUNT: Cell<Operations> = Cell::default();
}

fn note(f: impl FnOnce(&mut Operations)) {
    let mut count = COUNT.get();
    f(&mut count);
    COUNT.set(count);
}

/// An f64 that counts its operations. Negation and constants are free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Counted(pub(crate) f64);

impl Add for Counted {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        note(|c| c.add += 1);
        Counted(self.0 + b.0)
    }
}

#[allow(clippy::suspicious_arithmetic_impl, reason = "it counts")]
impl Sub for Counted {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        note(|c| c.add += 1);
        Counted(self.0 - b.0)
    }
}

#[allow(clippy::suspicious_arithmetic_impl, reason = "it counts")]
impl Mul for Counted {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        note(|c| c.mul += 1);
        Counted(self.0 * b.0)
    }
}

#[allow(clippy::suspicious_arithmetic_impl, reason = "it counts")]
impl Div for Counted {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        note(|c| c.div += 1);
        Counted(self.0 / b.0)
    }
}

impl Neg for Counted {
    type Output = Self;
    fn neg(self) -> Self {
        Counted(-self.0)
    }
}

fn other(x: f64) -> Counted {
    note(|c| c.other += 1);
    Counted(x)
}

fn pair((s, c): (f64, f64)) -> (Counted, Counted) {
    note(|c| c.sincos += 1);
    (Counted(s), Counted(c))
}

impl Scalar for Counted {
    type Mask = bool;
    type Refused = Option<usize>;
    type Singular<const N: usize> = Singular;

    fn from_f64(x: f64) -> Self {
        Counted(x)
    }
    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }
    fn sqrt(self) -> Self {
        note(|c| c.sqrt += 1);
        Counted(self.0.sqrt())
    }
    fn sin_cos(self) -> (Self, Self) {
        pair(self.0.sin_cos())
    }
    fn sin_cos_sum(angles: &[Self], offset: (f64, f64)) -> (Self, Self) {
        let angles: Vec<f64> = angles.iter().map(|a| a.0).collect();
        pair(<f64 as Scalar>::sin_cos_sum(&angles, offset))
    }
    fn exp(self) -> Self {
        other(self.0.exp())
    }
    fn ln(self) -> Self {
        other(self.0.ln())
    }
    fn tanh(self) -> Self {
        other(self.0.tanh())
    }
    fn abs(self) -> Self {
        other(self.0.abs())
    }
    fn min(self, b: Self) -> Self {
        other(Scalar::min(self.0, b.0))
    }
    fn max(self, b: Self) -> Self {
        other(Scalar::max(self.0, b.0))
    }
    fn sign(self) -> Self {
        other(Scalar::sign(self.0))
    }
    fn less(self, b: Self) -> bool {
        note(|c| c.other += 1);
        self.0 < b.0
    }
    fn select(mask: bool, a: Self, b: Self) -> Self {
        note(|c| c.other += 1);
        if mask { a } else { b }
    }
    fn none_refused() -> Option<usize> {
        None
    }
    fn checked_pivot(self, m: Self, joint: usize, refused: &mut Option<usize>) -> Self {
        other(self.0.checked_pivot(m.0, joint, refused))
    }
    fn succeeded<const N: usize>(a: &SVector<Self, N>, refused: Option<usize>) -> bool {
        f64::succeeded(&a.map(|x| x.0), refused)
    }
    fn failed<const N: usize>(
        a: SVector<Self, N>,
        refused: Option<usize>,
        names: &'static [&'static str],
        _: impl FnOnce(&mut Look<'_, Self>),
    ) -> Option<Singular> {
        f64::failed(a.map(|x| x.0), refused, names, |_| ())
    }
}

/// Returns the operations that `f` executes.
pub(crate) fn executed<R>(f: impl FnOnce() -> R) -> Operations {
    COUNT.set(Operations::default());
    let _ = std::hint::black_box(f());
    COUNT.get()
}

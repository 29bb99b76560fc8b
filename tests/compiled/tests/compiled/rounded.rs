//! Double-doubles with constants rounded to `f64`, as in the emitted code: in this scalar evaluator and
//! compiled code must agree to double-double's rounding error.

use std::ops::{Add, Div, Mul, Neg, Sub};

use bgdyn::nalgebra::SVector;
use bgdyn::runtime::Dd;
use bgdyn::runtime::Look;
use bgdyn::{Scalar, Singular};

/// A double-double whose constants have one word.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rounded(pub(crate) Dd);

macro_rules! operators {
    ($($trait:ident $method:ident;)*) => {$(
        impl $trait for Rounded {
            type Output = Self;
            fn $method(self, b: Self) -> Self {
                Rounded(self.0.$method(b.0))
            }
        }
    )*};
}

operators! {
    Add add;
    Sub sub;
    Mul mul;
    Div div;
}

impl Neg for Rounded {
    type Output = Self;
    fn neg(self) -> Self {
        Rounded(-self.0)
    }
}

impl Scalar for Rounded {
    type Mask = bool;
    type Refused = Option<usize>;
    type Singular<const N: usize> = Singular;

    // `from_parts` is the default of the trait: it drops the low word.
    fn from_f64(x: f64) -> Self {
        Rounded(Dd::from_f64(x))
    }
    fn mul_add(self, b: Self, c: Self) -> Self {
        Rounded(self.0.mul_add(b.0, c.0))
    }
    fn sqrt(self) -> Self {
        Rounded(self.0.sqrt())
    }
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.0.sin_cos();
        (Rounded(s), Rounded(c))
    }
    fn sin_cos_sum(angles: &[Self], offset: (f64, f64)) -> (Self, Self) {
        let angles: Vec<Dd> = angles.iter().map(|a| a.0).collect();
        let (s, c) = Dd::sin_cos_sum(&angles, offset);
        (Rounded(s), Rounded(c))
    }
    fn exp(self) -> Self {
        Rounded(self.0.exp())
    }
    fn ln(self) -> Self {
        Rounded(self.0.ln())
    }
    fn tanh(self) -> Self {
        Rounded(self.0.tanh())
    }
    fn abs(self) -> Self {
        Rounded(self.0.abs())
    }
    fn min(self, b: Self) -> Self {
        Rounded(self.0.min(b.0))
    }
    fn max(self, b: Self) -> Self {
        Rounded(self.0.max(b.0))
    }
    fn sign(self) -> Self {
        Rounded(self.0.sign())
    }
    fn less(self, b: Self) -> bool {
        self.0.less(b.0)
    }
    fn select(mask: bool, a: Self, b: Self) -> Self {
        if mask { a } else { b }
    }
    fn none_refused() -> Option<usize> {
        None
    }
    fn checked_pivot(self, m: Self, joint: usize, refused: &mut Option<usize>) -> Self {
        Rounded(self.0.checked_pivot(m.0, joint, refused))
    }
    fn succeeded<const N: usize>(a: &SVector<Self, N>, refused: Option<usize>) -> bool {
        Dd::succeeded(&a.map(|x| x.0), refused)
    }
    fn failed<const N: usize>(
        a: SVector<Self, N>,
        refused: Option<usize>,
        names: &'static [&'static str],
        _: impl FnOnce(&mut Look<'_, Self>),
    ) -> Option<Singular> {
        Dd::failed(a.map(|x| x.0), refused, names, |_| ())
    }
}

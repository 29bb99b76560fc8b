//! The type of double-double numbers: its two words, its order, its special values.

use core::cmp::Ordering;

/// A number of about 32 decimal digits: the unevaluated sum `hi + lo` of two `f64`, where `hi` is the
/// `f64` nearest to the sum (Dekker 1971).
///
/// Addition, multiplication, division and the square root have relative errors of a few 2⁻¹⁰⁶ if the
/// result is 0 or larger than 2⁻⁹⁶⁸. Below that, the low word underflows, and the error is about one
/// smallest `f64`. An infinity or a NaN never becomes a finite number.
///
/// Text is read by [`FromStr`](core::str::FromStr) and written by [`Display`](core::fmt::Display)
/// in decimal:
///
/// ```
/// use bgdyn_runtime::Dd;
///
/// let tenth: Dd = "0.1".parse()?;
/// assert_eq!(tenth.hi(), 0.1);
/// assert!((tenth + tenth + tenth - "0.3".parse()?).abs() < Dd::from_f64(1e-32));
/// assert_eq!(tenth.to_string(), "0.1");
/// # Ok::<(), bgdyn_runtime::ParseDdError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dd {
    /// The nearest `f64`.
    pub(super) hi: f64,
    /// The remainder, at most half a unit in the last place of `hi`; 0 where `hi` is not finite.
    pub(super) lo: f64,
}

impl Dd {
    /// Zero.
    pub const ZERO: Self = Self { hi: 0.0, lo: 0.0 };
    /// One.
    pub const ONE: Self = Self { hi: 1.0, lo: 0.0 };
    /// Not a number.
    pub const NAN: Self = Self {
        hi: f64::NAN,
        lo: 0.0,
    };
    /// Infinity.
    pub const INFINITY: Self = Self {
        hi: f64::INFINITY,
        lo: 0.0,
    };
    /// 2⁻¹⁰⁴, a bound with a margin on the relative rounding error of one operation.
    /// [`Scalar::checked_pivot`](crate::Scalar::checked_pivot) compares pivots with it.
    pub const EPSILON: Self = Self {
        hi: f64::EPSILON * f64::EPSILON,
        lo: 0.0,
    };

    /// Returns `x`, exactly.
    pub const fn from_f64(x: f64) -> Self {
        Self { hi: x, lo: 0.0 }
    }

    /// Returns the high word: the `f64` nearest to the number.
    pub const fn hi(self) -> f64 {
        self.hi
    }

    /// Returns the low word: the number minus [`Dd::hi`].
    pub const fn lo(self) -> f64 {
        self.lo
    }

    /// Returns the nearest `f64`.
    pub const fn to_f64(self) -> f64 {
        self.hi
    }

    /// Returns whether the number is neither infinite nor NaN.
    pub const fn is_finite(self) -> bool {
        self.hi.is_finite()
    }

    /// Returns whether the value is NaN.
    pub const fn is_nan(self) -> bool {
        self.hi.is_nan()
    }

    /// Returns the absolute value.
    pub const fn abs(self) -> Self {
        if self.hi.is_sign_negative() {
            Self {
                hi: -self.hi,
                lo: -self.lo,
            }
        } else {
            self
        }
    }

    /// Returns the smaller number; NaN where either is NaN.
    pub fn min(self, other: Self) -> Self {
        if self < other || self.is_nan() {
            self
        } else {
            other
        }
    }

    /// Returns the larger number; NaN where either is NaN.
    pub fn max(self, other: Self) -> Self {
        if self > other || self.is_nan() {
            self
        } else {
            other
        }
    }
}

impl From<f64> for Dd {
    fn from(x: f64) -> Self {
        Self::from_f64(x)
    }
}

impl PartialOrd for Dd {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match self.hi.partial_cmp(&other.hi) {
            Some(Ordering::Equal) => self.lo.partial_cmp(&other.lo),
            order => order,
        }
    }
}

//! Prints numbers rounded to significant decimal digits.

use core::fmt::{self, Write};
use core::ops::Range;

use super::text::Buffer;

/// Displays a number rounded to significant digits, with an exponent if it is very large or very small.
///
/// ```
/// use bgdyn_runtime::Digits;
/// assert_eq!(Digits::new(2.0 / 3.0, 3).to_string(), "0.667");
/// assert_eq!(Digits::new(1.5e-7, 3).to_string(), "1.5e-7");
/// assert_eq!(Digits::new(1.5e-7, 3).with_zeros().to_string(), "1.50e-7");
/// ```
///
/// Width and precision of the formatter are ignored.
#[derive(Clone, Debug, PartialEq)]
pub struct Digits {
    value: f64,
    /// Number of significant digits; `None`: the fewest digits that parse to the same number.
    count: Option<usize>,
    plain: Range<i32>,
    zeros: bool,
}

/// The largest number of digits that an `f64` needs.
const MAX_DIGITS: usize = 17;
/// Numbers below this power of ten may be written without an exponent.
const LONGEST: i32 = 30;

impl Digits {
    /// Displays the number with `count` significant digits, 1 to 17, without trailing zeros after the
    /// decimal point, and without an exponent from 0.0001 up to 999999.
    pub const fn new(value: f64, count: usize) -> Self {
        let count = match count {
            0 => 1,
            MAX_DIGITS.. => MAX_DIGITS,
            count => count,
        };
        Digits {
            value,
            count: Some(count),
            plain: -4..6,
            zeros: false,
        }
    }

    /// Displays the number with the fewest digits that parse to the same `f64`.
    pub const fn shortest(value: f64) -> Self {
        Digits {
            count: None,
            ..Digits::new(value, 1)
        }
    }

    /// Writes no exponent if the number's power of ten is in this range (at most 10³⁰).
    #[must_use]
    pub const fn plain(self, powers: Range<i32>) -> Self {
        Digits {
            plain: powers,
            ..self
        }
    }

    /// Writes all digits, including trailing zeros.
    #[must_use]
    pub const fn with_zeros(self) -> Self {
        Digits {
            zeros: true,
            ..self
        }
    }
}

impl fmt::Display for Digits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let x = self.value;
        if x == 0.0 || !x.is_finite() {
            // Drops the sign of a zero.
            return write!(f, "{}", if x == 0.0 { 0.0 } else { x });
        }
        // Both texts fit: 17 digits, or 30 places.
        let mut text = Buffer::EMPTY;
        match self.count {
            Some(count) => write!(text, "{x:.*e}", count - 1)?,
            None => write!(text, "{x:e}")?,
        }
        // The exponent of the rounded number can be one larger than that of the number.
        let (mantissa, exponent) = text.as_str().split_once('e').ok_or(fmt::Error)?;
        let power: i32 = exponent.parse().map_err(|_| fmt::Error)?;
        if !self.plain.contains(&power) || power.abs() > LONGEST {
            return write!(f, "{}e{exponent}", self.trimmed(mantissa));
        }
        let mut text = Buffer::EMPTY;
        match self.count {
            Some(count) => {
                let places = count as i32 - 1 - power;
                write!(text, "{x:.*}", usize::try_from(places).unwrap_or(0))?;
            }
            None => write!(text, "{x}")?,
        }
        f.write_str(self.trimmed(text.as_str()))
    }
}

impl Digits {
    fn trimmed<'a>(&self, text: &'a str) -> &'a str {
        match text.contains('.') && !self.zeros {
            true => text.trim_end_matches('0').trim_end_matches('.'),
            false => text,
        }
    }
}

//! Parses and prints double-doubles as decimals.
//!
//! `core` parses and prints `f64` correctly rounded, to any number of digits. This file only adds and
//! subtracts strings of digits: text − hi gives lo, and hi + lo gives the text.

use core::fmt::{self, Write};
use core::str::FromStr;

use super::number::Dd;

/// Number of significant digits that are parsed, and that are taken of each word.
const DIGITS: usize = 100;
/// Number of significant digits that are printed.
const WRITTEN: usize = 32;

/// The reason why a text is not a [`Dd`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParseDdError {
    /// Not a decimal number.
    Invalid,
    /// A decimal number too large for an `f64`.
    Overflow,
}

impl fmt::Display for ParseDdError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Invalid => "not a decimal number",
            Self::Overflow => "number too large",
        })
    }
}

impl core::error::Error for ParseDdError {}

/// A text buffer on the stack; a write that does not fit is a formatting error.
pub(super) struct Buffer {
    bytes: [u8; DIGITS + 32],
    len: usize,
}

impl Buffer {
    pub(super) const EMPTY: Self = Self {
        bytes: [0; DIGITS + 32],
        len: 0,
    };

    pub(super) fn as_str(&self) -> &str {
        self.bytes
            .get(..self.len)
            .and_then(|text| str::from_utf8(text).ok())
            .unwrap_or("")
    }
}

impl Write for Buffer {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let end = self.len + text.len();
        self.bytes
            .get_mut(self.len..end)
            .ok_or(fmt::Error)?
            .copy_from_slice(text.as_bytes());
        self.len = end;
        Ok(())
    }
}

/// A decimal number: the digit at index `i` has the weight 10^(`top` − `i`).
struct Decimal {
    digits: [i32; DIGITS + 4],
    top: i64,
}

impl Decimal {
    /// Returns zero, with room for numbers smaller than 10^`top`·10.
    fn zero(top: i64) -> Self {
        Self {
            digits: [0; DIGITS + 4],
            top,
        }
    }

    /// Adds `sign` times the unsigned decimal number `text`; digits below the last place are dropped.
    fn add(&mut self, text: &str, sign: i32) {
        let mut place = self.top.saturating_sub(leading_place(text));
        for digit in significant_digits(text) {
            if let Some(slot) = usize::try_from(place)
                .ok()
                .and_then(|i| self.digits.get_mut(i))
            {
                *slot += sign * digit;
            }
            place = place.saturating_add(1);
        }
    }

    /// Brings every digit to 0..=9 and removes the sign. Returns whether the number was negative.
    fn normalise(&mut self) -> bool {
        let negative = self.carry();
        if negative {
            self.digits = self.digits.map(|digit| -digit);
            self.digits[0] += 10;
            self.carry();
        }
        negative
    }

    /// Carries into higher digits. Returns whether the number is negative; then its digits are those of
    /// the number plus ten units of the first place.
    fn carry(&mut self) -> bool {
        let mut carry = 0;
        for digit in self.digits.iter_mut().rev() {
            let total = *digit + carry;
            *digit = total.rem_euclid(10);
            carry = total.div_euclid(10);
        }
        carry < 0
    }

    /// Rounds the normalised number to `count` significant digits (half up).
    fn round(&mut self, count: usize) {
        let first = self
            .digits
            .iter()
            .position(|&digit| digit != 0)
            .unwrap_or(0);
        if let Some(half) = self.digits.get_mut(first + count) {
            *half += 5;
            self.carry();
        }
        // After a carry into a new first digit, one more digit is left: a zero, which is not printed.
        if let Some(rest) = self.digits.get_mut(first + count..) {
            rest.fill(0);
        }
    }
}

/// Splits an unsigned decimal number into mantissa and exponent.
fn mantissa_and_exponent(text: &str) -> (&str, i64) {
    let Some((mantissa, exponent)) = text.split_once(['e', 'E']) else {
        return (text, 0);
    };
    let huge = if exponent.starts_with('-') {
        i64::MIN
    } else {
        i64::MAX
    };
    (mantissa, exponent.parse().unwrap_or(huge))
}

/// Returns the digits of an unsigned decimal number from the first nonzero one on.
fn significant_digits(text: &str) -> impl Iterator<Item = i32> {
    let (mantissa, _) = mantissa_and_exponent(text);
    mantissa
        .bytes()
        .filter(u8::is_ascii_digit)
        .map(|byte| i32::from(byte - b'0'))
        .skip_while(|&digit| digit == 0)
}

/// Returns the power of ten of the first nonzero digit of an unsigned decimal number.
fn leading_place(text: &str) -> i64 {
    let (mantissa, exponent) = mantissa_and_exponent(text);
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let zeros = |digits: &str| digits.bytes().take_while(|&byte| byte == b'0').count();
    let whole_zeros = zeros(whole);
    let place = if whole_zeros < whole.len() {
        (whole.len() - whole_zeros) as i64 - 1
    } else {
        -1 - zeros(fraction) as i64
    };
    exponent.saturating_add(place)
}

/// Returns |`x`| in decimal, to [`DIGITS`] digits.
fn digits_of(x: f64) -> Buffer {
    let mut text = Buffer::EMPTY;
    // The text fits: a digit, a point, 99 digits and an exponent of at most five characters.
    let _ = write!(text, "{:.*e}", DIGITS - 1, x.abs());
    text
}

/// Parses decimal text: an optional sign, digits with or without a point, an optional exponent.
///
/// `hi` is the `f64` of the text, and `hi + lo` is within a relative error of 2⁻¹⁰⁷ of the number (of its
/// first 100 digits) unless `lo` underflows. Infinities and NaN are errors.
impl FromStr for Dd {
    type Err = ParseDdError;

    fn from_str(text: &str) -> Result<Self, ParseDdError> {
        let numeric = |byte: u8| byte.is_ascii_digit() || b"+-.eE".contains(&byte);
        if !text.bytes().all(numeric) {
            return Err(ParseDdError::Invalid);
        }
        let hi: f64 = text.parse().map_err(|_| ParseDdError::Invalid)?;
        if !hi.is_finite() {
            return Err(ParseDdError::Overflow);
        }
        if hi == 0.0 {
            return Ok(Self::from_f64(hi));
        }
        let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
        let hi_text = digits_of(hi);
        let top = leading_place(unsigned).max(leading_place(hi_text.as_str()));
        let mut rest = Decimal::zero(top);
        rest.add(unsigned, 1);
        rest.add(hi_text.as_str(), -1);
        let negative = rest.normalise() != (hi < 0.0);

        let mut lo_text = Buffer::EMPTY;
        // The text fits: 104 digits, a sign and an exponent of at most five characters.
        let _ = lo_text.write_str(if negative { "-" } else { "" });
        for digit in rest.digits {
            let _ = write!(lo_text, "{digit}");
        }
        let last = top.saturating_sub(rest.digits.len() as i64 - 1);
        let _ = write!(lo_text, "e{last}");
        let lo = lo_text.as_str().parse().unwrap_or(0.0);
        Ok(Self::new(hi, lo))
    }
}

/// Prints up to 32 significant digits, without trailing zeros, and an exponent (`1.5e-30`) if the number
/// is 10²¹ or more, or less than 10⁻⁵. Width and precision are ignored.
impl fmt::Display for Dd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.is_finite() || self.hi == 0.0 {
            return write!(f, "{}", self.hi);
        }
        let hi = digits_of(self.hi);
        let mut sum = Decimal::zero(leading_place(hi.as_str()).saturating_add(1));
        sum.add(hi.as_str(), 1);
        let same = self.hi.is_sign_negative() == self.lo.is_sign_negative();
        sum.add(digits_of(self.lo).as_str(), if same { 1 } else { -1 });
        sum.normalise();
        sum.round(WRITTEN);

        let first = sum.digits.iter().position(|&digit| digit != 0).unwrap_or(0);
        let end = sum
            .digits
            .iter()
            .rposition(|&digit| digit != 0)
            .map_or(1, |last| last + 1);
        let place = sum.top - first as i64;
        if self.hi < 0.0 {
            f.write_str("-")?;
        }
        let digit = |i: usize| sum.digits.get(i).copied().unwrap_or(0);
        let plain = (-5..=20).contains(&place);
        // The digits before the point.
        let whole = if plain {
            usize::try_from(place + 1).unwrap_or(0)
        } else {
            1
        };
        if whole == 0 {
            f.write_str("0")?;
        }
        for i in first..first + whole {
            write!(f, "{}", digit(i))?;
        }
        if end > first + whole {
            f.write_str(".")?;
        }
        if plain {
            for _ in place..-1 {
                f.write_str("0")?;
            }
        }
        for i in first + whole..end {
            write!(f, "{}", digit(i))?;
        }
        if plain { Ok(()) } else { write!(f, "e{place}") }
    }
}

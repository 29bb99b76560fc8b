//! Decimal numbers with their original text.

use bgdyn_runtime::{Dd, Digits};

/// A number: its decimal text, fit for YAML, and its value.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Num {
    pub(super) text: String,
    pub(super) value: f64,
}

/// Number of digits that the parser of mechanisms reads; longer texts are replaced by the shortest with
/// the same f64.
const MAX_DIGITS: usize = 32;

/// Integers of more digits are written with a decimal point.
const MAX_INTEGER: usize = 18;

/// The unit after the digits of an angle in degrees.
const DEGREES: &str = " deg";

impl Num {
    /// Returns zero.
    pub(super) fn zero() -> Self {
        Num {
            text: "0".into(),
            value: 0.0,
        }
    }

    /// Returns N zeros.
    pub(super) fn zeros<const N: usize>() -> [Self; N] {
        [(); N].map(|()| Num::zero())
    }

    /// Returns the number with the opposite sign; 0 has none.
    pub(super) fn negated(&self) -> Self {
        let text = match self.text.strip_prefix('-') {
            _ if self.is_zero() => "0".into(),
            Some(size) => size.to_owned(),
            None => format!("-{}", self.text),
        };
        let value = if self.is_zero() { 0.0 } else { -self.value };
        Num { text, value }
    }

    /// Returns a computed value, in the shortest form that parses to the same value.
    pub(super) fn computed(value: f64) -> Self {
        let text = Digits::shortest(value).plain(-5..17).to_string();
        Num { text, value }
    }

    /// Parses a decimal. `inf` and overflow give an infinite value; a text that is no number gives `None`.
    pub(super) fn parse(text: &str) -> Option<Self> {
        let text = text.trim();
        let (negative, size) = match text.strip_prefix('-') {
            Some(rest) => (true, rest),
            None => (false, text.strip_prefix('+').unwrap_or(text)),
        };
        let value: f64 = text.parse().ok().filter(|value: &f64| !value.is_nan())?;
        if value.is_infinite() || value == 0.0 {
            return Some(Num::computed(value));
        }
        let (mantissa, exponent) = match size.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, Some(exponent)),
            None => (size, None),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let whole = whole.trim_start_matches('0');
        let significant = match whole {
            "" => fraction.trim_start_matches('0').len(),
            _ => whole.len() + fraction.len(),
        };
        if significant > MAX_DIGITS {
            return Some(Num::computed(value));
        }
        let mut text = String::from(if negative { "-" } else { "" });
        text.push_str(if whole.is_empty() { "0" } else { whole });
        if !fraction.is_empty() {
            text.push('.');
            text.push_str(fraction);
        }
        if let Some(exponent) = exponent {
            text.push('e');
            text.push_str(exponent);
        } else if fraction.is_empty() && whole.len() > MAX_INTEGER {
            // YAML parsers require integers to fit a machine word.
            text.push_str(".0");
        }
        Some(Num { text, value })
    }

    /// Returns an angle given in degrees, with the unit: `90 deg`.
    pub(super) fn degrees(text: &str) -> Option<Self> {
        let degrees = Num::parse(text).filter(|degrees| degrees.value.is_finite())?;
        if degrees.is_zero() {
            return Some(degrees);
        }
        let mut angle = Num {
            text: format!("{}{DEGREES}", degrees.text),
            value: 0.0,
        };
        angle.value = angle.exact().to_f64();
        Some(angle)
    }

    /// Returns the value in double-double: the exact decimal, degrees converted to rad.
    pub(super) fn exact(&self) -> Dd {
        let read = |text: &str| text.parse::<Dd>().ok().filter(|x| x.is_finite());
        match self.text.strip_suffix(DEGREES) {
            Some(degrees) => read(degrees).map(|x| x * Dd::PI / Dd::from_f64(180.0)),
            None => read(&self.text),
        }
        .unwrap_or(Dd::from_f64(self.value))
    }

    /// Returns whether the number is 0.
    pub(super) fn is_zero(&self) -> bool {
        self.value == 0.0
    }
}

/// Returns whether all of them are 0.
pub(super) fn all_zero(numbers: &[Num]) -> bool {
    numbers.iter().all(Num::is_zero)
}

#[cfg(test)]
mod tests {
    use super::Num;

    #[test]
    fn the_text_stays_as_it_was() {
        for (given, kept) in [
            ("0.0", "0"),
            ("-0.0", "0"),
            ("1.0", "1.0"),
            ("+1.5", "1.5"),
            (".5", "0.5"),
            ("-.5e3", "-0.5e3"),
            ("5.", "5"),
            ("007.10", "7.10"),
            ("4E-05", "4e-05"),
            ("1.57079632679", "1.57079632679"),
            (
                "3.1415926535897932384626433832795",
                "3.1415926535897932384626433832795",
            ),
            ("0.012499999999999997", "0.012499999999999997"),
            (
                "0.1000000000000000055511151231257827021181583404541015625",
                "0.1",
            ),
            ("1e-999", "0"),
            (" 12\t", "12"),
            (
                "-63713450892424100000000000000000",
                "-63713450892424100000000000000000.0",
            ),
        ] {
            let number = Num::parse(given).unwrap();
            assert_eq!(number.text, kept);
            assert_eq!(number.value, given.trim().parse::<f64>().unwrap());
            assert_eq!(number.value, kept.parse::<f64>().unwrap());
        }
        assert_eq!(Num::parse("-inf").unwrap().value, f64::NEG_INFINITY);
        assert_eq!(Num::parse("1e999").unwrap().value, f64::INFINITY);
        for wrong in [
            "", "nan", "0,5", "1 2", "${x}", "--1", "0x10", ".", "e5", "1_000",
        ] {
            assert_eq!(Num::parse(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn computed_values_read_back() {
        for value in [1.0 / 3.0, 1e-300, -2.5e20, 123456.75, 5e-324, f64::MAX] {
            assert_eq!(Num::computed(value).text.parse::<f64>().unwrap(), value);
        }
    }
}

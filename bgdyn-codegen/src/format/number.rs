//! Parses a number and its unit.
//!
//! A number is a decimal with up to 32 digits or a quotient of two such; the unit is one of the expected
//! dimension.

use bgdyn_runtime::Dd;

use super::yaml::YamlKind;
use super::{Located, Number};
use crate::fault::{Fault, Location, wording};
use crate::unit::{Dimension, Unit, UnitFactor};

/// Permitted sizes of nonzero numbers: with others, products could overflow.
const SIZES: std::ops::RangeInclusive<f64> = 1e-100..=1e100;

/// Parses the number at `location`, a scalar of the given kind.
pub(super) fn number(
    kind: YamlKind,
    text: &str,
    location: &Location,
    fit: &[Dimension],
) -> Result<Number, Fault> {
    if non_finite(text) {
        return Err(wording::non_finite(location, text));
    }
    let (mantissa, exponent, rest) =
        decimal(text).ok_or_else(|| wording::not_a_number(location, text, fit))?;
    let (divisor, rest) = divisor(rest);
    if kind == YamlKind::Number && !rest.is_empty() {
        return Err(wording::not_decimal(location, text));
    }
    let unit = match rest {
        "" => None,
        unit => Some(fitting(unit, text, location, fit)?),
    };
    let value =
        value(mantissa, exponent, unit).ok_or_else(|| wording::out_of_range(location, text))?;
    let value = match divisor {
        None => value,
        Some(divisor) if divisor == Dd::ZERO => {
            return Err(wording::division_by_zero(location, text));
        }
        Some(divisor) => {
            let quotient = value / divisor;
            let size = quotient.to_f64().abs();
            if size != 0.0 && !SIZES.contains(&size) {
                return Err(wording::out_of_range(location, text));
            }
            quotient
        }
    };
    if unit.is_none() && divisor.is_none() && kind != YamlKind::Number {
        return Err(wording::number_as_text(
            location,
            text,
            kind == YamlKind::Text { quoted: true },
        ));
    }
    Ok(Number {
        value,
        unit,
        text: text.to_owned(),
        parameter: None,
    })
}

/// Parses a number outside of any file, such as `30 deg` or `0.5` on a command line.
///
/// # Errors
/// As for a number in a file: no number, an unknown unit, or a unit of another dimension.
pub fn quantity(text: &str, fit: &[Dimension]) -> Result<Number, Fault> {
    let bare = decimal(text).is_some_and(|(_, _, rest)| rest.is_empty());
    let kind = match bare {
        true => YamlKind::Number,
        false => YamlKind::Text { quoted: false },
    };
    number(kind, text.trim(), &Location::file(), fit)
}

/// Returns a fault if the dimension of a number's unit is not one of `fit`.
pub(crate) fn check_unit(number: &Located<Number>, fit: &[Dimension]) -> Option<Fault> {
    let unit = number.value.unit?;
    let fits = fit.contains(&unit.dimension);
    (!fits).then(|| wording::unit_misfit(&number.location, &number.value.text, unit, fit))
}

fn non_finite(text: &str) -> bool {
    let bare = text
        .trim()
        .trim_start_matches(['+', '-'])
        .trim_start_matches('.')
        .to_lowercase();
    let word = bare.split_whitespace().next().unwrap_or("");
    ["inf", "nan", "infinity"].contains(&word)
}

/// Splits `-1.5e3 mm` into `-1.5`, 3 and `mm`.
fn decimal(text: &str) -> Option<(&str, i32, &str)> {
    let text = text.trim();
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
    let digits = |s: &str| s.len() - s.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    let whole = digits(unsigned);
    let fraction = unsigned[whole..].strip_prefix('.').map(digits);
    if whole + fraction.unwrap_or(0) == 0 {
        return None;
    }
    let end = text.len() - unsigned.len() + whole + fraction.map_or(0, |f| f + 1);
    let (mantissa, rest) = text.split_at(end);
    let (exponent, rest) = power(rest);
    let spaced =
        rest.is_empty() || !rest.starts_with(|c: char| "_.,".contains(c) || c.is_ascii_digit());
    spaced.then_some((mantissa, exponent, rest.trim_start()))
}

/// Splits `/50 mm` into 50 and `mm`; a text that begins with no divisor is not split.
fn divisor(text: &str) -> (Option<Dd>, &str) {
    let quotient = text.strip_prefix('/').and_then(|after| decimal(after));
    let Some((mantissa, exponent, rest)) = quotient else {
        return (None, text);
    };
    match value(mantissa, exponent, None) {
        Some(divisor) => (Some(divisor), rest),
        None => (None, text),
    }
}

/// Splits `e-3 mm` into −3 and ` mm`; a text that begins with no power of ten is not split.
fn power(text: &str) -> (i32, &str) {
    let Some(after) = text.strip_prefix(['e', 'E']) else {
        return (0, text);
    };
    let unsigned = after.strip_prefix(['+', '-']).unwrap_or(after);
    let rest = unsigned.trim_start_matches(|c: char| c.is_ascii_digit());
    let end = after.len() - rest.len();
    match after[..end].trim_start_matches('+').parse::<i32>() {
        Ok(exponent) => (exponent, rest),
        Err(_) if unsigned.len() == rest.len() => (0, text),
        // More digits than an i32 holds: out of range in both directions.
        Err(_) => (
            if after.starts_with('-') {
                -1_000_000
            } else {
                1_000_000
            },
            rest,
        ),
    }
}

fn fitting(
    unit: &str,
    text: &str,
    location: &Location,
    fit: &[Dimension],
) -> Result<&'static Unit, Fault> {
    let found = Unit::find(unit).ok_or_else(|| wording::unknown_unit(location, text, unit, fit))?;
    let fits = fit.contains(&found.dimension);
    if fits {
        Ok(found)
    } else {
        Err(wording::unit_misfit(location, text, found, fit))
    }
}

fn value(mantissa: &str, exponent: i32, unit: Option<&'static Unit>) -> Option<Dd> {
    let zero = mantissa
        .bytes()
        .all(|b| matches!(b, b'0' | b'.' | b'+' | b'-'));
    if zero {
        return Some(Dd::ZERO);
    }
    // Powers of ten are added to the decimal's exponent: 300 mm is read as 300e-3, not divided by 1000.
    let exponent = exponent.saturating_add(unit.map_or(0, |u| u.exponent));
    let decimal = format!("{}e{exponent}", mantissa.trim_start_matches('+'));
    let size = decimal.parse::<f64>().ok()?.abs();
    if !SIZES.contains(&size) {
        return None;
    }
    let number: Dd = decimal.parse().ok()?;
    // The quotient first: 90/180 is exact, so that 90 deg is exactly the double-double of π/2.
    let number = match unit.map(|u| u.factor) {
        Some(UnitFactor::Degree) => number / Dd::from_f64(180.0) * Dd::PI,
        Some(UnitFactor::PerTurn) => number / (Dd::from_f64(2.0) * Dd::PI),
        Some(UnitFactor::One) | None => number,
    };
    number.to_f64().is_finite().then_some(number)
}

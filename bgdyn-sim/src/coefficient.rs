//! Coefficients of integrators in two words, exact enough for double-double.
//!
//! They are written as in the literature, as quotients of integers or as decimals, and converted at
//! compile time.

use bgdyn_runtime::Scalar;

/// A number as the unevaluated sum of two `f64`, the first one being nearest to the number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Words(f64, f64);

/// Zero.
pub(crate) const ZERO: Words = Words(0.0, 0.0);

impl Words {
    /// Returns the nearest value of a scalar type.
    pub(crate) fn to<T: Scalar>(self) -> T {
        T::from_parts(self.0, self.1)
    }

    /// Returns whether the number is 0.
    pub(crate) const fn is_zero(self) -> bool {
        self.0 == 0.0
    }
}

/// Returns `n`/`d` for two integers below 2⁵³, with a relative error of 2⁻¹⁰⁵.
pub(crate) const fn ratio(n: f64, d: f64) -> Words {
    quotient(Words(n, 0.0), Words(d, 0.0))
}

/// Parses the decimal number `text`: an optional sign, digits with at most one point, no exponent, at most
/// 36 digits. The relative error is 2⁻¹⁰⁴.
pub(crate) const fn decimal(text: &str) -> Words {
    let text = text.as_bytes();
    let negative = text[0] == b'-';
    let (mut digits, mut scale, mut point) = (0_u128, 1_u128, false);
    let mut i = negative as usize;
    while i < text.len() {
        if text[i] == b'.' {
            assert!(!point, "two points in a number");
            point = true;
        } else {
            assert!(text[i].is_ascii_digit(), "no digit of a number");
            digits = digits * 10 + (text[i] - b'0') as u128;
            if point {
                scale *= 10;
            }
        }
        i += 1;
    }
    let Words(hi, lo) = quotient(whole(digits), whole(scale));
    if negative {
        Words(-hi, -lo)
    } else {
        Words(hi, lo)
    }
}

/// Converts an integer, to 106 bits.
const fn whole(n: u128) -> Words {
    let hi = n as f64;
    let back = hi as u128;
    let lo = if back > n {
        -((back - n) as f64)
    } else {
        (n - back) as f64
    };
    Words(hi, lo)
}

/// Divides by long division, one word at a time.
const fn quotient(n: Words, d: Words) -> Words {
    let q = n.0 / d.0;
    let rest = minus_product(n, q, d);
    let q2 = rest.0 / d.0;
    let rest = minus_product(rest, q2, d);
    let first = fast_sum(q, q2);
    fast_sum(first.0, first.1 + rest.0 / d.0)
}

/// Returns n − q·d.
const fn minus_product(n: Words, q: f64, d: Words) -> Words {
    let p = q * d.0;
    let (q1, q2) = halves(q);
    let (d1, d2) = halves(d.0);
    let error = ((q1 * d1 - p) + q1 * d2 + q2 * d1) + q2 * d2;
    // n and p have the same leading digits, so their difference is exact.
    let difference = n.0 - p;
    let back = difference - n.0;
    let lost = (n.0 - (difference - back)) - (p + back);
    fast_sum(difference, lost + (n.1 - error - q * d.1))
}

/// Returns a + b exactly, for |a| ≥ |b| or a = 0 (Dekker 1971).
const fn fast_sum(a: f64, b: f64) -> Words {
    let sum = a + b;
    Words(sum, b - (sum - a))
}

/// Returns the upper 26 bits of `a` and the rest (Veltkamp).
const fn halves(a: f64) -> (f64, f64) {
    let t = 134_217_729.0 * a;
    let high = t - (t - a);
    (high, a - high)
}

#[cfg(test)]
mod tests {
    use bgdyn_runtime::Dd;

    use super::{Words, decimal, ratio};

    #[test]
    fn words_are_the_numbers_written() {
        for text in [
            "0.1",
            "-8.84549479328286085344864962717",
            "0.333333333333333333333333333333",
            "-374.54675472269020279518312152",
            "0.000108347328697249322858509316994",
        ] {
            let read: Dd = text.parse().expect("a number");
            let off = decimal(text).to::<Dd>() - read;
            assert!(off.abs() <= Dd::EPSILON * read.abs(), "{text}: {off}");
        }
        let wanted = Dd::from_f64(87_487_479_700.0) / Dd::from_f64(32_700_410_799.0);
        let off = ratio(87_487_479_700.0, 32_700_410_799.0).to::<Dd>() - wanted;
        assert!(off.abs() <= Dd::EPSILON * wanted, "{off}");
        assert_eq!(ratio(-3.0, 4.0), Words(-0.75, 0.0));
    }
}

//! Prints sums and products, for plain text and LaTeX.

use bgdyn_runtime::{Dd, Digits};

use super::form::{Atom, ClosedForm, Factor, Sum, Term};
use super::polynomial::Angle;

/// A notation: plain text or LaTeX.
pub(super) trait Notation {
    /// Separator of factors.
    const TIMES: &'static str;
    /// Minus sign, without spaces.
    const MINUS: &'static str;
    /// Sign before a rounded value.
    const ABOUT: &'static str;
    /// Separator of a value and its unit.
    const GAP: &'static str;

    /// Number of significant digits of values.
    fn digits(&self) -> usize;

    /// Prints a unit from its parts with their powers.
    fn unit(&self, parts: &[(&str, i32)]) -> String;

    /// Prints a positive number.
    fn number(&self, x: Dd) -> String;

    /// Prints a power of an atom that is no sine or cosine.
    fn symbol(&self, atom: &Atom, power: u32) -> String;

    /// Prints a power of a sine or cosine, of an angle printed by [`angle`].
    fn wave(&self, sine: bool, angle: &str, single: bool, power: u32) -> String;

    /// Prints a power of parentheses.
    fn parentheses(&self, inside: &str, power: u32) -> String;

    /// Prints a value: `= 1.5 kg`.
    fn value(&self, value: Dd, dimension: [i32; 3]) -> String {
        let sign = if value < Dd::ZERO { Self::MINUS } else { "" };
        let exact = Decimal::new(value.abs(), self.digits()).exact;
        let equals = if exact { "=" } else { Self::ABOUT };
        let number = self.number(value.abs());
        let unit = self.unit(&unit(dimension));
        let gap = if unit.is_empty() { "" } else { Self::GAP };
        format!("{equals} {sign}{number}{gap}{unit}")
    }
}

/// Returns the printed terms of a sum: the first with its minus sign, the others with their sign.
pub(super) fn terms<N: Notation>(n: &N, sum: &Sum) -> Vec<String> {
    let mut written = Vec::new();
    for (i, term) in sum.iter().enumerate() {
        let product = product(n, term);
        written.push(match (i, term.negative) {
            (0, false) => product,
            (0, true) => format!("{}{product}", N::MINUS),
            (_, false) => format!("+ {product}"),
            (_, true) => format!("{} {product}", N::MINUS),
        });
    }
    if written.is_empty() {
        written.push("0".into());
    }
    written
}

/// Prints a sum in one line.
pub(super) fn sum<N: Notation>(n: &N, sum: &Sum) -> String {
    terms(n, sum).join(" ")
}

fn product<N: Notation>(n: &N, term: &Term) -> String {
    let factor = |factor: &Factor| match factor {
        Factor::Number(x) => n.number(*x),
        Factor::Sum(inside) => n.parentheses(&sum(n, inside), 1),
        Factor::Square(inside) => n.parentheses(&sum(n, inside), 2),
        Factor::Power(Atom::Cosine(of), power) => wave(n, false, of, *power),
        Factor::Power(Atom::Sine(of), power) => wave(n, true, of, *power),
        Factor::Power(atom, power) => n.symbol(atom, *power),
    };
    let factors: Vec<String> = term.factors.iter().map(factor).collect();
    if factors.is_empty() {
        return "1".into();
    }
    factors.join(N::TIMES)
}

fn wave<N: Notation>(n: &N, sine: bool, of: &Angle, power: u32) -> String {
    let single = matches!(of[..], [(_, 1)]);
    n.wave(sine, &angle(n, of), single, power)
}

/// Prints Σ n_j q_j.
fn angle<N: Notation>(n: &N, of: &Angle) -> String {
    let term = |&(j, multiple): &(usize, i32)| {
        let size = Dd::from_f64(f64::from(multiple.unsigned_abs()));
        let mut factors = super::definition::number(size);
        factors.push(Factor::Power(Atom::Position(j), 1));
        Term {
            negative: multiple < 0,
            factors,
        }
    };
    sum(n, &of.iter().map(term).collect())
}

/// A number in decimal, rounded to a number of significant digits.
pub(super) struct Decimal {
    /// Digits with a point, without trailing zeros.
    pub digits: String,
    /// The power of ten, if the number would have many zeros without it.
    pub exponent: Option<i32>,
    /// Whether the digits are exact.
    pub exact: bool,
}

impl Decimal {
    /// Rounds a number to 1 to 17 digits.
    pub fn new(x: Dd, digits: usize) -> Self {
        let text = Digits::new(x.hi(), digits).to_string();
        let back: Dd = text.parse().unwrap_or(Dd::NAN);
        let exact = (back - x).hi().abs() <= 1e-29 * x.hi().abs();
        let (digits, exponent) = match text.split_once('e') {
            Some((digits, exponent)) => (digits, exponent.parse().ok()),
            None => (text.as_str(), None),
        };
        Decimal {
            digits: digits.to_owned(),
            exponent,
            exact,
        }
    }
}

/// Returns the unit of a product with these powers of kilogram, metre and second: its parts with their
/// powers.
pub(super) fn unit(dimension: [i32; 3]) -> Vec<(&'static str, i32)> {
    let [kg, m, s] = dimension;
    let force = kg == 1 && s == -2;
    let parts = match force {
        true => [("N", 1), ("m", m - 1), ("s", 0)],
        false => [("kg", kg), ("m", m), ("s", s)],
    };
    parts.into_iter().filter(|&(_, n)| n != 0).collect()
}

/// Returns the dimension of P_j.
pub(super) fn effort(form: &ClosedForm, j: usize) -> [i32; 3] {
    match form.joints[j].1 {
        crate::mechanism::Motion::Rotation => [1, 2, -2],
        _ => [1, 1, -2],
    }
}

//! Common divisors of sums, and the arithmetic of products and numbers with which they are found.

use bgdyn_runtime::Dd;

use super::network::{Var, is_unit};
use crate::expr::index::mix;

/// A divisor: a · b of two factors (or a number and a factor), or a + r b of two products without a common
/// factor.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum DivisorKey {
    Product(FactorOrNumber, FactorOrNumber),
    /// The ids of a, b, r.
    Sum(u32, u32, u32),
}

impl DivisorKey {
    /// Returns its hash.
    pub fn quick_hash(self) -> u64 {
        match self {
            DivisorKey::Product(a, b) => mix(mix(1, a.word()), b.word()),
            DivisorKey::Sum(a, b, r) => {
                let products = u64::from(a) << 32 | u64::from(b);
                mix(mix(2, products), u64::from(r))
            }
        }
    }
}

/// A factor, or the absolute value of a term's number.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum FactorOrNumber {
    Number(u32),
    Factor(Var),
}

impl FactorOrNumber {
    fn word(self) -> u64 {
        match self {
            FactorOrNumber::Number(k) => u64::from(k) << 32,
            FactorOrNumber::Factor(f) => u64::from(f),
        }
    }
}

/// A number as a key, without the last ten bits of a double-double, which are rounding errors.
pub(super) type NumberKey = (u64, i64);

pub(super) fn number_key(x: Dd) -> NumberKey {
    let unit = x.hi().abs() * (1.0 / (1u128 << 96) as f64);
    let low = if unit > 0.0 {
        (x.lo() / unit).round()
    } else {
        0.0
    };
    (x.hi().to_bits(), low as i64)
}

pub(super) fn near(x: Dd, y: Dd) -> bool {
    number_key(x) == number_key(y)
}

/// An occurrence of k (a + r b) · rest in a sum: its two terms, and k.
pub(super) struct Occurrence {
    pub var: Var,
    pub terms: [usize; 2],
    pub k: Dd,
    pub rest: Vec<Var>,
}

/// Returns numbers by which a + r b may be multiplied: so that one of its own factors is 1, or one of its
/// occurrences has the factor 1.
pub(super) fn scales(found: &[Occurrence], r: Dd) -> Vec<Dd> {
    let mut scales = vec![Dd::ONE, Dd::ONE / r];
    for place in found {
        if scales.len() < 8 && !scales.iter().any(|&s| near(s, place.k)) {
            scales.push(place.k);
        }
    }
    scales
}

/// Returns x / y, ± 1 if they are equal.
pub(super) fn quotient_of(x: Dd, y: Dd) -> Dd {
    if is_unit(y) {
        if y == Dd::ONE { x } else { -x }
    } else if near(x, y) {
        Dd::ONE
    } else if near(x, -y) {
        -Dd::ONE
    } else {
        x / y
    }
}

pub(super) fn insert(factors: &mut Vec<Var>, f: Var) {
    let at = factors.partition_point(|&g| g <= f);
    factors.insert(at, f);
}

/// Returns the factors of x and of y without the common ones, and the number of common ones.
pub(super) fn divide(x: &[Var], y: &[Var], a: &mut Vec<Var>, b: &mut Vec<Var>) -> usize {
    a.clear();
    b.clear();
    let (mut i, mut j) = (0, 0);
    while i < x.len() && j < y.len() {
        match x[i].cmp(&y[j]) {
            std::cmp::Ordering::Less => {
                a.push(x[i]);
                i += 1;
            }
            std::cmp::Ordering::Greater => {
                b.push(y[j]);
                j += 1;
            }
            std::cmp::Ordering::Equal => (i, j) = (i + 1, j + 1),
        }
    }
    a.extend(&x[i..]);
    b.extend(&y[j..]);
    x.len() - a.len()
}

/// Returns x / a, if a divides x.
pub(super) fn quotient(x: &[Var], a: &[Var]) -> Option<Vec<Var>> {
    if !divides(a, x) {
        return None;
    }
    let (mut rest, mut missing) = (Vec::with_capacity(x.len() - a.len()), Vec::new());
    divide(x, a, &mut rest, &mut missing);
    Some(rest)
}

/// Returns whether the factors a are among those of x.
fn divides(a: &[Var], x: &[Var]) -> bool {
    let mut of_x = x.iter();
    a.len() <= x.len() && a.iter().all(|f| of_x.by_ref().find(|g| *g >= f) == Some(f))
}

/// Returns whether x = a · b.
pub(super) fn is_product(x: &[Var], a: &[Var], b: &[Var]) -> bool {
    let (mut of_a, mut of_b) = (a, b);
    x.len() == a.len() + b.len()
        && x.iter()
            .all(|f| match (of_a.split_first(), of_b.split_first()) {
                (Some((g, rest)), _) if f == g => {
                    of_a = rest;
                    true
                }
                (_, Some((g, rest))) if f == g => {
                    of_b = rest;
                    true
                }
                _ => false,
            })
}

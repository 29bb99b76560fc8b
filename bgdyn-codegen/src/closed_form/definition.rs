//! Coefficients of equations: sums of products of symbols.

use std::collections::BTreeMap;

use bgdyn_runtime::Dd;

use super::form::{Atom, Factor, NamedSum, Sum, Term};
use super::polynomial::CANCELLED;
use crate::mechanism::NumberSymbol;

/// Longer sums get a name.
const WRITTEN_OUT: usize = 5;

/// The largest number of products of letters for equations that are written out; in longer ones all sums
/// and products of letters get names.
const SHORT: usize = 40;

/// Powers of letters, in increasing order.
pub(super) type Letters = Vec<(usize, u32)>;

/// Σ number · letters
#[derive(Clone, Debug, Default)]
pub(super) struct Definition(BTreeMap<Letters, Dd>);

impl Definition {
    /// Adds a product.
    pub fn add(&mut self, letters: Letters, value: Dd) {
        let met = self.0.entry(letters).or_insert(Dd::ZERO);
        let size = met.hi().abs().max(value.hi().abs());
        *met += value;
        if met.hi().abs() <= CANCELLED * size {
            *met = Dd::ZERO;
        }
        self.0.retain(|_, value| *value != Dd::ZERO);
    }

    /// Returns self + k · other.
    pub fn plus(&self, k: f64, other: &Self) -> Self {
        let mut sum = self.clone();
        for (letters, value) in &other.0 {
            sum.add(letters.clone(), *value * Dd::from_f64(k));
        }
        sum
    }

    /// Returns k · self.
    pub fn scaled(&self, k: Dd) -> Self {
        let scaled = |(letters, value): (&Letters, &Dd)| (letters.clone(), *value * k);
        Definition(self.0.iter().map(scaled).collect())
    }

    /// Returns the number of products.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Returns whether it equals k · other, within rounding.
    pub fn is(&self, k: f64, other: &Self) -> bool {
        let k = Dd::from_f64(k);
        let close = |x: Dd, y: Dd| (x - y).hi().abs() <= CANCELLED * x.hi().abs();
        self.len() == other.len()
            && (self.0.iter().zip(&other.0)).all(|((a, x), (b, y))| a == b && close(*x, k * *y))
    }

    /// Splits it into a number and a sum whose first product has the factor 1.
    pub fn primitive(&self) -> (Dd, Definition) {
        let first = self.0.values().next().copied().unwrap_or(Dd::ONE);
        (first, self.scaled(Dd::ONE / first))
    }

    fn value(&self, letters: &[NumberSymbol]) -> Dd {
        let mut sum = Dd::ZERO;
        for (powers, &number) in &self.0 {
            let all = powers.iter().flat_map(|&(l, n)| (0..n).map(move |_| l));
            sum += all.fold(number, |product, l| product * letters[l].value);
        }
        sum
    }

    fn dimension(&self, letters: &[NumberSymbol]) -> [i32; 3] {
        let first = self.0.keys().next().into_iter().flatten();
        first.fold([0; 3], |sum, &(l, n)| {
            std::array::from_fn(|d| sum[d] + n as i32 * letters[l].dimension[d])
        })
    }
}

/// The sums used so far, and the names of the long ones.
pub(super) struct NamesOfSums<'a> {
    letters: &'a [NumberSymbol],
    /// Whether the equations are short enough to be written in letters.
    short: bool,
    named: Vec<Definition>,
}

impl<'a> NamesOfSums<'a> {
    /// Starts with no names, for equations with this number of products of letters.
    pub fn new(letters: &'a [NumberSymbol], products: usize) -> Self {
        NamesOfSums {
            letters,
            short: products <= SHORT,
            named: Vec::new(),
        }
    }

    /// Returns the definitions of the names.
    pub fn into_constants(self) -> Vec<NamedSum> {
        let named = |definition: &Definition| NamedSum {
            definition: match self.split(definition) {
                (common, rest) if common.is_empty() => rest,
                (factors, rest) => {
                    let factors = join_factors(factors, rest);
                    let negative = false;
                    vec![Term { negative, factors }]
                }
            },
            value: definition.value(self.letters),
            dimension: definition.dimension(self.letters),
        };
        self.named.iter().map(named).collect()
    }

    /// Returns a primitive sum as factors: its name, its letters, or the common letters of its products
    /// and a sum in parentheses.
    pub fn factors(&mut self, primitive: &Definition) -> Vec<Factor> {
        if !self.is_short(primitive) {
            let (mut factors, rest) = self.without_weight(primitive);
            match self.is_short(&rest) {
                true => factors.extend(self.factors(&rest)),
                false => factors.push(Factor::Power(Atom::Constant(self.name(&rest)), 1)),
            }
            return factors;
        }
        let (factors, rest) = self.split(primitive);
        join_factors(factors, rest)
    }

    /// Returns the sum written out, if it is short, as part of a larger sum.
    pub fn written_out(&self, definition: &Definition) -> Option<Sum> {
        let short = self.is_short(definition);
        short.then(|| self.terms(definition, &[]))
    }

    /// Returns whether it is written in letters; a single letter always is.
    fn is_short(&self, definition: &Definition) -> bool {
        let letters = |product: &Letters| product.iter().map(|(_, n)| n).sum::<u32>();
        match self.short {
            true => definition.len() <= WRITTEN_OUT,
            false => definition.len() == 1 && definition.0.keys().map(letters).sum::<u32>() <= 1,
        }
    }

    /// Returns a sum of weights as g and a sum of masses, which may have a name already.
    fn without_weight(&self, definition: &Definition) -> (Vec<Factor>, Definition) {
        let g = self
            .letters
            .iter()
            .rposition(|l| l.symbol == "g" && !l.run_time);
        let Some(g) = g.filter(|&g| definition.0.keys().all(|p| power(p, g) == 1)) else {
            return (vec![], definition.clone());
        };
        let rest = |(product, &value): (&Letters, &Dd)| {
            let others = product.iter().filter(|(l, _)| *l != g);
            (others.copied().collect(), value)
        };
        let rest = Definition(definition.0.iter().map(rest).collect());
        (vec![Factor::Power(Atom::Letter(g), 1)], rest)
    }

    fn name(&mut self, primitive: &Definition) -> usize {
        let known = self.named.iter().position(|d| d.is(1.0, primitive));
        known.unwrap_or_else(|| {
            self.named.push(primitive.clone());
            self.named.len() - 1
        })
    }

    /// Splits the letters common to all products from the rest.
    fn split(&self, definition: &Definition) -> (Vec<Factor>, Sum) {
        let mut products = definition.0.keys();
        let mut common = products.next().cloned().unwrap_or_default();
        for product in products {
            for (letter, n) in &mut common {
                *n = (*n).min(power(product, *letter));
            }
        }
        common.retain(|&(_, n)| n > 0);
        (self.print(&common), self.terms(definition, &common))
    }

    /// Returns the products without their common letters.
    fn terms(&self, definition: &Definition, common: &[(usize, u32)]) -> Sum {
        let term = |(letters, &value): (&Letters, &Dd)| {
            let left = |&(l, n): &(usize, u32)| (l, n - power(common, l));
            let mut left: Letters = letters.iter().map(left).collect();
            left.retain(|&(_, n)| n > 0);
            let mut factors = number(value);
            factors.extend(self.print(&left));
            if factors.is_empty() && definition.len() > 1 {
                factors.push(Factor::Number(Dd::ONE));
            }
            let negative = value < Dd::ZERO;
            Term { negative, factors }
        };
        definition.0.iter().map(term).collect()
    }

    /// Returns letters in the order of textbooks: weight, mass, inertia, lengths.
    fn print(&self, letters: &[(usize, u32)]) -> Vec<Factor> {
        let rank = |l: usize| {
            let order = ["g", "m", "J", "l", "c"];
            order.iter().position(|&s| s == self.letters[l].symbol)
        };
        let mut sorted = letters.to_vec();
        sorted.sort_by_key(|&(l, _)| (rank(l), l));
        let power = |(l, n)| Factor::Power(Atom::Letter(l), n);
        sorted.into_iter().map(power).collect()
    }
}

/// Returns the common letters times the sum of the remaining factors; for a single product only the
/// letters.
fn join_factors(mut common: Vec<Factor>, rest: Sum) -> Vec<Factor> {
    if !matches!(&rest[..], [one] if one.factors.is_empty()) {
        common.push(Factor::Sum(rest));
    }
    common
}

fn power(letters: &[(usize, u32)], letter: usize) -> u32 {
    let found = letters.iter().find(|(l, _)| *l == letter);
    found.map_or(0, |&(_, n)| n)
}

/// Returns |x| as a factor; empty for 1.
pub(super) fn number(x: Dd) -> Vec<Factor> {
    let size = x.abs();
    if (size - Dd::ONE).hi().abs() <= CANCELLED {
        vec![]
    } else {
        vec![Factor::Number(size)]
    }
}

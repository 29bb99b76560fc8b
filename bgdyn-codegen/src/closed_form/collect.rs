//! Collects the terms of polynomials into equations in textbook form.

use std::collections::BTreeMap;

use bgdyn_runtime::Dd;

use super::definition::{Definition, NamesOfSums, number};
use super::form::{Atom, Factor, Sum, Term};
use super::polynomial::{CANCELLED, Polynomial, Symbol};
use super::tidy::{Entry, tidy};
use crate::mechanism::NumberSymbol;

/// The product q̈_k, q̇_k q̇_l or 1 that a coefficient multiplies.
type VelocityProduct = Vec<(Atom, u32)>;

/// The coefficient of an acceleration or of a product of velocities.
struct TermCoefficient {
    motion: VelocityProduct,
    entries: Vec<Entry>,
}

/// The coefficients of an effort.
pub(super) struct Collected {
    accelerations: Vec<TermCoefficient>,
    velocities: Vec<TermCoefficient>,
    rest: Vec<TermCoefficient>,
}

impl Collected {
    /// Collects the terms of an effort by the product that they multiply.
    pub fn new(effort: &Polynomial, letters: &[NumberSymbol]) -> Self {
        let mut motions: BTreeMap<Vec<(Symbol, u32)>, BTreeMap<_, Entry>> = BTreeMap::new();
        let largest = effort.terms().map(|(_, value)| value.hi().abs());
        let largest = largest.fold(0.0, f64::max);
        for (monomial, value) in effort.terms() {
            if value.hi().abs() <= CANCELLED * largest {
                continue;
            }
            let (mut motion, mut powers, mut product) = (vec![], vec![], vec![]);
            for &(symbol, n) in &monomial.powers {
                match symbol {
                    Symbol::Velocity(_) | Symbol::Acceleration(_) => motion.push((symbol, n)),
                    Symbol::Letter(l) if !letters[l].run_time => product.push((l, n)),
                    _ => powers.push((symbol, n)),
                }
            }
            let shape = (powers.clone(), monomial.waves.clone());
            let entries = motions.entry(motion).or_default();
            let entry = entries.entry(shape);
            let entry = entry.or_insert_with(|| Entry::new(powers, monomial));
            entry.add(product, value);
        }
        let mut collected = Collected {
            accelerations: vec![],
            velocities: vec![],
            rest: vec![],
        };
        for (motion, entries) in motions {
            let list = match motion.last() {
                None => &mut collected.rest,
                Some((Symbol::Velocity(_), _)) => &mut collected.velocities,
                Some(_) => &mut collected.accelerations,
            };
            list.push(TermCoefficient {
                motion: motion.into_iter().map(atom).collect(),
                entries: tidy(entries.into_values().collect()),
            });
        }
        collected
    }

    /// Returns the number of terms.
    pub fn len(&self) -> usize {
        let lists = [&self.accelerations, &self.velocities, &self.rest];
        let all = lists.into_iter().flatten();
        all.map(|coefficient| coefficient.entries.len()).sum()
    }

    /// Returns the number of products of letters in all terms.
    pub fn products(&self) -> usize {
        let lists = [&self.accelerations, &self.velocities, &self.rest];
        let entries = lists.into_iter().flatten().flat_map(|c| &c.entries);
        entries.map(|entry| entry.definition.len()).sum()
    }

    /// Returns the effort in printed form.
    pub fn print(&self, names: &mut NamesOfSums<'_>) -> Sum {
        let mut sum = Sum::new();
        for coefficient in &self.accelerations {
            sum.extend(inertial(coefficient, names));
        }
        for product in shared(&self.velocities) {
            sum.push(product.print(names));
        }
        for entry in self.rest.iter().flat_map(|c| &c.entries) {
            sum.push(printed(entry, names, vec![]));
        }
        sum
    }
}

fn atom((symbol, n): (Symbol, u32)) -> (Atom, u32) {
    let atom = match symbol {
        Symbol::Letter(l) => Atom::Letter(l),
        Symbol::Position(j) => Atom::Position(j),
        Symbol::Velocity(j) => Atom::Velocity(j),
        Symbol::Acceleration(j) => Atom::Acceleration(j),
    };
    (atom, n)
}

fn powers(of: &[(Atom, u32)]) -> Vec<Factor> {
    let power = |(atom, n): &(Atom, u32)| Factor::Power(atom.clone(), *n);
    of.iter().map(power).collect()
}

/// Returns one product: number, letters, sines, velocity product.
fn printed(entry: &Entry, names: &mut NamesOfSums<'_>, motion: Vec<Factor>) -> Term {
    let (scale, primitive) = entry.definition.primitive();
    let mut factors = number(scale);
    factors.extend(names.factors(&primitive));
    factors.extend(powers(&entry.shape()));
    factors.extend(motion);
    Term {
        negative: scale < Dd::ZERO,
        factors,
    }
}

/// Returns M_jk q̈_k, with the entry of the mass matrix in parentheses if it is a sum.
fn inertial(coefficient: &TermCoefficient, names: &mut NamesOfSums<'_>) -> Option<Term> {
    let motion = powers(&coefficient.motion);
    if let [one] = &coefficient.entries[..] {
        return Some(printed(one, names, motion));
    }
    let mut sum = Sum::new();
    for entry in &coefficient.entries {
        match names.written_out(&entry.definition) {
            Some(terms) if entry.shape().is_empty() => sum.extend(terms),
            _ => sum.push(printed(entry, names, vec![])),
        }
    }
    if sum.is_empty() {
        return None;
    }
    // A minus sign of the first term is moved in front of the parentheses.
    let negative = sum[0].negative;
    sum.iter_mut().for_each(|term| term.negative ^= negative);
    let mut factors = vec![Factor::Sum(sum)];
    factors.extend(motion);
    Some(Term { negative, factors })
}

/// Products of velocities with the same letters and sines in their coefficients.
struct Shared<'a> {
    entry: &'a Entry,
    primitive: Definition,
    shape: Vec<(Atom, u32)>,
    /// The number in front of each product.
    products: Vec<(Dd, &'a VelocityProduct)>,
}

/// Groups the velocity terms by their letters and sines.
fn shared(velocities: &[TermCoefficient]) -> Vec<Shared<'_>> {
    let mut all: Vec<Shared<'_>> = Vec::new();
    for coefficient in velocities {
        for entry in &coefficient.entries {
            let (scale, primitive) = entry.definition.primitive();
            let shape = entry.shape();
            let product = (scale, &coefficient.motion);
            let same = |s: &&mut Shared<'_>| {
                s.shape == shape && s.primitive.is(1.0, &primitive) && s.commensurable(scale)
            };
            match all.iter_mut().find(same) {
                Some(found) => found.products.push(product),
                None => all.push(Shared {
                    entry,
                    primitive,
                    shape,
                    products: vec![product],
                }),
            }
        }
    }
    all
}

impl Shared<'_> {
    /// Returns whether a number is a small integer multiple of those in front of the products, or they of
    /// it.
    fn commensurable(&self, scale: Dd) -> bool {
        let whole = |x: f64| (1..=4).any(|n| (x - f64::from(n)).abs() < 1e-12);
        let ratio = |&(k, _): &(Dd, &VelocityProduct)| (scale / k).hi().abs();
        let ratios: Vec<f64> = self.products.iter().map(ratio).collect();
        ratios.iter().all(|&r| whole(r) || whole(1.0 / r))
    }

    fn print(&self, names: &mut NamesOfSums<'_>) -> Term {
        if let [(_, motion)] = &self.products[..] {
            return printed(self.entry, names, powers(motion));
        }
        let sizes = self.products.iter().map(|(k, _)| k.abs());
        let least = sizes.fold(Dd::INFINITY, Dd::min);
        let (negative, last) = match self.square(least) {
            Some((negative, sum)) => (negative, vec![Factor::Square(sum)]),
            None => {
                let negative = self.products[0].0 < Dd::ZERO;
                let common = self.common_rate();
                let sum = Factor::Sum(self.sum(least, negative, common));
                let rate = common.map(|rate| Factor::Power(rate.clone(), 1));
                (negative, rate.into_iter().chain([sum]).collect())
            }
        };
        let mut factors = number(least);
        factors.extend(names.factors(&self.primitive));
        factors.extend(powers(&self.shape));
        factors.extend(last);
        Term { negative, factors }
    }

    /// Returns the velocity that all products have as a factor, if none is a square.
    fn common_rate(&self) -> Option<&Atom> {
        let mixed = |(_, motion): &(Dd, &VelocityProduct)| motion.len() == 2;
        let (_, first) = self.products.iter().all(mixed).then(|| &self.products[0])?;
        let shared = |rate: &Atom| {
            let has = |(_, motion): &(Dd, &VelocityProduct)| motion.iter().any(|(a, _)| a == rate);
            self.products.iter().all(has)
        };
        first.iter().map(|(rate, _)| rate).find(|rate| shared(rate))
    }

    /// Returns the products divided by the least number in front of one of them and by their common
    /// velocity.
    fn sum(&self, least: Dd, negative: bool, common: Option<&Atom>) -> Sum {
        let product = |(k, motion): &(Dd, &VelocityProduct)| {
            let mut factors = number(*k / least);
            let left = motion.iter().filter(|(rate, _)| Some(rate) != common);
            factors.extend(powers(&left.cloned().collect::<VelocityProduct>()));
            Term {
                negative: (*k < Dd::ZERO) != negative,
                factors,
            }
        };
        self.products.iter().map(product).collect()
    }

    /// Returns ±(q̇_i ± q̇_j …)², if the products have this form: its sign and the sum.
    fn square(&self, least: Dd) -> Option<(bool, Sum)> {
        let whole = |k: Dd, n: f64| (k.abs() / least - Dd::from_f64(n)).hi().abs() < 1e-12;
        let (mut squares, mut others) = (Vec::new(), Vec::new());
        for &(k, motion) in &self.products {
            match &motion[..] {
                [(rate, 2)] if whole(k, 1.0) => squares.push((rate, k < Dd::ZERO)),
                [(a, 1), (b, 1)] if whole(k, 2.0) => others.push((a, b, k < Dd::ZERO)),
                _ => return None,
            }
        }
        let &(first, sign) = squares.first()?;
        let n = squares.len();
        if squares.iter().any(|s| s.1 != sign) || others.len() != n * (n - 1) / 2 {
            return None;
        }
        // The sign of each velocity is that of its product with the first one.
        let turned = |rate: &Atom| {
            let with = others.iter().find(|(a, b, _)| *a == first && *b == rate);
            with.is_some_and(|&(_, _, negative)| negative != sign)
        };
        let fits = |&(a, b, negative): &(&Atom, &Atom, bool)| {
            (turned(a) != turned(b)) == (negative != sign)
        };
        let term = |&(rate, _): &(&Atom, bool)| Term {
            negative: turned(rate),
            factors: vec![Factor::Power(rate.clone(), 1)],
        };
        let sum = squares.iter().map(term).collect();
        others.iter().all(fits).then_some((sign, sum))
    }
}

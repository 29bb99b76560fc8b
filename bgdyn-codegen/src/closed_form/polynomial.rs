//! Polynomials in symbols, coordinates, velocities, accelerations, sines and cosines.
//!
//! Normal form: for the angles about parallel axes, a *group*, a term has at most one sine or cosine, of a
//! sum of integer multiples of them. Products within a group become sums by 2 cos A cos B = cos (A − B) +
//! cos (A + B) and similar formulas, so that sin² + cos² = 1 and all other identities are satisfied
//! automatically: two polynomials are equal exactly if their terms are.

use std::collections::BTreeMap;

use bgdyn_runtime::Dd;

/// A sum smaller than this fraction (2⁻⁹⁰) of its largest term is a rounding error, and is dropped.
pub(super) const CANCELLED: f64 = 1.0 / (1u128 << 90) as f64;

/// The base of a power.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Symbol {
    /// A letter, by its index in the list of [`super::ClosedForm`].
    Letter(usize),
    /// q_j of a prismatic joint.
    Position(usize),
    /// q̇_j
    Velocity(usize),
    /// q̈_j
    Acceleration(usize),
}

/// Σ n_j q_j: the coordinates in increasing order, with their nonzero multiples.
pub type Angle = Vec<(usize, i32)>;

/// A sine or cosine.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Wave {
    /// The group of its angles.
    pub group: usize,
    /// Whether it is a sine.
    pub sine: bool,
    /// The angle; its first multiple is positive.
    pub angle: Angle,
}

/// A product of powers and waves, at most one wave per group, each in increasing order.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Monomial {
    /// Nonzero powers.
    pub powers: Vec<(Symbol, u32)>,
    /// Sines and cosines.
    pub waves: Vec<Wave>,
}

/// The number in front of a term.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coefficient {
    pub value: Dd,
    /// The largest number that was added to it, which its rounding error is relative to.
    size: f64,
}

/// A sum of terms.
#[derive(Clone, Debug, Default)]
pub(super) struct Polynomial {
    terms: BTreeMap<Monomial, Coefficient>,
}

impl Polynomial {
    /// Returns a number times a monomial.
    pub fn term(value: Dd, monomial: Monomial) -> Self {
        let mut polynomial = Polynomial::default();
        let size = value.hi().abs();
        polynomial.add(monomial, Coefficient { value, size });
        polynomial.without_zeros()
    }

    /// Returns a number.
    pub fn number(value: Dd) -> Self {
        Polynomial::term(value, Monomial::default())
    }

    /// Returns a symbol.
    pub fn symbol(symbol: Symbol) -> Self {
        let powers = vec![(symbol, 1)];
        Polynomial::term(
            Dd::ONE,
            Monomial {
                powers,
                waves: vec![],
            },
        )
    }

    /// Returns sin or cos of an angle of one group, which is not zero.
    pub fn wave(group: usize, sine: bool, angle: &[(usize, i32)]) -> Self {
        let (negative, angle) = signed(angle.to_vec());
        let value = if sine && negative { -Dd::ONE } else { Dd::ONE };
        let waves = vec![Wave { group, sine, angle }];
        Polynomial::term(
            value,
            Monomial {
                powers: vec![],
                waves,
            },
        )
    }

    /// Returns the number of terms.
    pub fn len(&self) -> usize {
        self.terms.len()
    }

    /// Returns its terms, in order.
    pub fn terms(&self) -> impl Iterator<Item = (&Monomial, Dd)> {
        self.terms.iter().map(|(m, c)| (m, c.value))
    }

    /// Returns self + other, or self − other.
    pub fn plus(&self, other: &Self, negative: bool) -> Self {
        let mut sum = self.clone();
        for (monomial, c) in &other.terms {
            let value = if negative { -c.value } else { c.value };
            let size = c.size;
            sum.add(monomial.clone(), Coefficient { value, size });
        }
        sum.without_zeros()
    }

    /// Returns self · other.
    pub fn times(&self, other: &Self) -> Self {
        let mut product = Polynomial::default();
        for (a, x) in &self.terms {
            for (b, y) in &other.terms {
                let (value, size) = (x.value * y.value, x.size * y.size);
                for (monomial, part) in multiplied(a, b) {
                    let value = value * Dd::from_f64(part);
                    let size = size * part.abs();
                    product.add(monomial, Coefficient { value, size });
                }
            }
        }
        product.without_zeros()
    }

    fn add(&mut self, monomial: Monomial, c: Coefficient) {
        let met = self.terms.entry(monomial).or_insert(Coefficient {
            value: Dd::ZERO,
            size: 0.0,
        });
        met.value += c.value;
        met.size = met.size.max(c.size);
    }

    /// Removes the terms that cancelled.
    fn without_zeros(mut self) -> Self {
        let remains = |c: &Coefficient| c.value.hi().abs() > CANCELLED * c.size;
        self.terms.retain(|_, c| remains(c));
        self
    }
}

/// Returns the angle with a positive first multiple, and whether its sign was changed.
pub(super) fn signed(mut angle: Angle) -> (bool, Angle) {
    let negative = angle.first().is_some_and(|&(_, n)| n < 0);
    if negative {
        angle.iter_mut().for_each(|(_, n)| *n = -*n);
    }
    (negative, angle)
}

/// Returns a + k b.
pub(super) fn combined(a: &[(usize, i32)], b: &[(usize, i32)], k: i32) -> Angle {
    let mut sum: BTreeMap<usize, i32> = a.iter().copied().collect();
    for &(j, n) in b {
        *sum.entry(j).or_default() += k * n;
    }
    sum.into_iter().filter(|&(_, n)| n != 0).collect()
}

/// Returns the product of two monomials: several monomials with factors if waves of a group are
/// multiplied.
fn multiplied(a: &Monomial, b: &Monomial) -> Vec<(Monomial, f64)> {
    let mut powers: BTreeMap<Symbol, u32> = a.powers.iter().copied().collect();
    for &(symbol, n) in &b.powers {
        *powers.entry(symbol).or_default() += n;
    }
    let powers: Vec<(Symbol, u32)> = powers.into_iter().collect();
    let mut products = vec![(a.waves.clone(), 1.0)];
    for wave in &b.waves {
        products = products
            .into_iter()
            .flat_map(|(waves, factor)| with_wave(waves, wave, factor))
            .collect();
    }
    let monomial = |(mut waves, factor): (Vec<Wave>, f64)| {
        waves.sort();
        let powers = powers.clone();
        (Monomial { powers, waves }, factor)
    };
    products.into_iter().map(monomial).collect()
}

/// Multiplies a product of waves of different groups by one more wave.
fn with_wave(mut waves: Vec<Wave>, wave: &Wave, factor: f64) -> Vec<(Vec<Wave>, f64)> {
    let Some(at) = waves.iter().position(|w| w.group == wave.group) else {
        waves.push(wave.clone());
        return vec![(waves, factor)];
    };
    let met = waves.remove(at);
    // sin A sin B = ½ [cos (A − B) − cos (A + B)], sin A cos B = ½ [sin (A + B) + sin (A − B)], …
    let sine = met.sine != wave.sine;
    let of_sum = if met.sine && wave.sine { -0.5 } else { 0.5 };
    let of_difference = if !met.sine && wave.sine { -0.5 } else { 0.5 };
    let mut products = Vec::with_capacity(2);
    for (k, part) in [(1, of_sum), (-1, of_difference)] {
        let (negative, angle) = signed(combined(&met.angle, &wave.angle, k));
        if angle.is_empty() && sine {
            continue;
        }
        let sign = if negative && sine { -1.0 } else { 1.0 };
        let mut product = waves.clone();
        if !angle.is_empty() {
            let group = wave.group;
            product.push(Wave { group, sine, angle });
        }
        products.push((product, factor * part * sign));
    }
    products
}

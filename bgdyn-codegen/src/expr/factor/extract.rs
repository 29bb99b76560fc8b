//! Greedy extraction of common products and common two-term sums from the sums of a network.

use bgdyn_runtime::Dd;

use super::divisor::{
    DivisorKey, FactorOrNumber, Occurrence, divide, insert, is_product, near, quotient,
    quotient_of, scales,
};
use super::divisors::Divisors;
use super::network::{Network, NetworkTerm, Var, is_unit, product_cost};

/// Largest distance of two terms of a sum that are extracted together; the run time grows with it.
const WINDOW: usize = 32;

/// The greedy search.
pub(super) struct Extraction<'a, 'g> {
    network: &'a mut Network<'g>,
    divisors: Divisors,
    /// Two products, as reusable memory.
    scratch: (Vec<Var>, Vec<Var>),
    /// The factors of a term, as reusable memory.
    literals: Vec<FactorOrNumber>,
}

impl<'a, 'g> Extraction<'a, 'g> {
    /// Finds all divisors of the network's sums.
    pub fn new(network: &'a mut Network<'g>) -> Self {
        let mut extraction = Extraction {
            network,
            divisors: Divisors::default(),
            scratch: Default::default(),
            literals: Vec::new(),
        };
        for i in 0..extraction.network.sums.len() {
            if extraction.network.needed[i] {
                let terms = extraction.terms(i as Var).len();
                for t in 0..terms {
                    extraction.register(i as Var, t);
                }
            }
        }
        extraction
    }

    /// Extracts the divisor with the largest saving until none saves an operation.
    pub fn run(&mut self) {
        while let Some((id, key, bound)) = self.divisors.pop() {
            let saved = match key {
                DivisorKey::Product(a, b) => self.try_product(id, a, b, bound),
                DivisorKey::Sum(a, b, r) => self.try_sum(id, a, b, r, bound),
            };
            self.divisors.put_back(id, saved);
        }
    }

    fn terms(&self, var: Var) -> &[NetworkTerm] {
        self.network.sums[var as usize].as_deref().unwrap_or(&[])
    }

    /// Records the pairs of factors in a term, and its pairs with the terms shortly before it.
    fn register(&mut self, var: Var, t: usize) {
        self.register_products(var, t);
        for other in t.saturating_sub(WINDOW)..t {
            self.register_pair(var, other, t);
        }
    }

    fn register_products(&mut self, var: Var, t: usize) {
        let term = &self.terms(var)[t];
        let k = term.k;
        if term.cost() == 0 {
            return;
        }
        let mut literals = std::mem::take(&mut self.literals);
        literals.clear();
        if !is_unit(k) {
            literals.push(FactorOrNumber::Number(self.divisors.number_id(k.abs())));
        }
        let factors = self.terms(var)[t].factors.iter();
        literals.extend(factors.map(|&f| FactorOrNumber::Factor(f)));
        // Equal factors follow each other: a pair is noted where it is first.
        let repeated = |i: usize| i > 0 && literals[i] == literals[i - 1];
        for j in 1..literals.len() {
            for i in (0..j).filter(|&i| !repeated(i) && (i + 1 == j || !repeated(j))) {
                let key = DivisorKey::Product(literals[i], literals[j]);
                self.divisors.note(key, var, 1, -1);
            }
        }
        self.literals = literals;
    }

    fn register_pair(&mut self, var: Var, s: usize, t: usize) {
        let (mut a, mut b) = std::mem::take(&mut self.scratch);
        let (x, y) = (&self.terms(var)[s], &self.terms(var)[t]);
        let (mut k, mut l) = (x.k, y.k);
        let before = x.cost() + y.cost() + 1;
        let common = divide(&x.factors, &y.factors, &mut a, &mut b);
        if b < a {
            std::mem::swap(&mut a, &mut b);
            (k, l) = (l, k);
        }
        let saved = before as isize - product_cost(Dd::ONE, common + 1) as isize;
        let least = 1 + product_cost(Dd::ONE, a.len()) + product_cost(Dd::ONE, b.len());
        let r = self.divisors.number_id(quotient_of(l, k));
        let key = DivisorKey::Sum(
            self.divisors.product_id(&a),
            self.divisors.product_id(&b),
            r,
        );
        self.divisors.note(key, var, saved, -(least as isize));
        self.scratch = (a, b);
    }

    /// Returns a new variable for the sum of `terms`.
    fn define(&mut self, terms: Vec<NetworkTerm>) -> Var {
        let var = self.network.sums.len() as Var;
        let n = terms.len();
        self.network.sums.push(Some(terms));
        for t in 0..n {
            self.register(var, t);
        }
        var
    }

    /// Extracts a · b if that saves `bound`; otherwise returns the actual saving.
    fn try_product(
        &mut self,
        id: usize,
        a: FactorOrNumber,
        b: FactorOrNumber,
        bound: isize,
    ) -> isize {
        let mut found: Vec<(Var, usize)> = Vec::new();
        for var in self.divisors.occurrences(id) {
            let terms = self.terms(var);
            let holding = (0..terms.len()).filter(|&t| self.holds(&terms[t], a, b));
            found.extend(holding.map(|t| (var, t)));
        }
        let saved = found.len() as isize - 1;
        if saved < bound || saved <= 0 {
            return saved;
        }
        let whole = |&&(var, t): &&(Var, usize)| {
            let terms = self.terms(var);
            let rest = self.without(&terms[t], a, b);
            terms.len() == 1 && rest.is_some_and(|r| r.factors.is_empty() && r.k == Dd::ONE)
        };
        let known = found.iter().find(whole).copied();
        let product = match known {
            Some((var, _)) => var,
            None => {
                let term = match (a, b) {
                    (FactorOrNumber::Number(k), FactorOrNumber::Factor(f)) => NetworkTerm {
                        k: self.divisors.number(k),
                        factors: vec![f],
                    },
                    (FactorOrNumber::Factor(f), FactorOrNumber::Factor(g)) => NetworkTerm {
                        k: Dd::ONE,
                        factors: vec![f, g],
                    },
                    _ => unreachable!("a term has one number"),
                };
                self.define(vec![term])
            }
        };
        self.substitute(
            found,
            |(var, _)| *var,
            |e, &(var, t)| {
                let mut term = e.without(&e.terms(var)[t], a, b).expect("found");
                insert(&mut term.factors, product);
                (var != product).then_some((vec![t], term))
            },
        );
        0
    }

    /// Returns whether a · b divides the term.
    fn holds(&self, term: &NetworkTerm, a: FactorOrNumber, b: FactorOrNumber) -> bool {
        let holds = |literal| match literal {
            FactorOrNumber::Factor(f) => term.factors.binary_search(&f).is_ok(),
            FactorOrNumber::Number(k) => {
                !term.factors.is_empty() && near(term.k.abs(), self.divisors.number(k))
            }
        };
        let twice = || match a {
            FactorOrNumber::Factor(f) => term.factors.iter().filter(|&&g| g == f).count() > 1,
            FactorOrNumber::Number(_) => false,
        };
        holds(b) && holds(a) && (a != b || twice())
    }

    /// Returns the term divided by a · b.
    fn without(
        &self,
        term: &NetworkTerm,
        a: FactorOrNumber,
        b: FactorOrNumber,
    ) -> Option<NetworkTerm> {
        if !self.holds(term, a, b) {
            return None;
        }
        let mut made = term.clone();
        for literal in [a, b] {
            match literal {
                FactorOrNumber::Number(_) if made.k < Dd::ZERO => made.k = -Dd::ONE,
                FactorOrNumber::Number(_) => made.k = Dd::ONE,
                FactorOrNumber::Factor(f) => {
                    let at = made.factors.binary_search(&f).ok()?;
                    made.factors.remove(at);
                }
            }
        }
        Some(made)
    }

    /// Replaces the terms of each occurrence by one term; occurrences in one sum are consecutive.
    fn substitute<F>(
        &mut self,
        found: Vec<F>,
        var_of: impl Fn(&F) -> Var,
        new: impl Fn(&Self, &F) -> Option<(Vec<usize>, NetworkTerm)>,
    ) {
        for candidates in found.chunk_by(|x, y| var_of(x) == var_of(y)) {
            let var = var_of(&candidates[0]);
            let new: Vec<_> = candidates.iter().filter_map(|p| new(self, p)).collect();
            let gone: Vec<usize> = new.iter().flat_map(|(terms, _)| terms.clone()).collect();
            let terms = self.network.sums[var as usize].take().unwrap_or_default();
            let kept = terms.into_iter().enumerate();
            let mut terms: Vec<NetworkTerm> = kept
                .filter(|(t, _)| !gone.contains(t))
                .map(|(_, term)| term)
                .collect();
            let first = terms.len();
            terms.extend(new.into_iter().map(|(_, term)| term));
            let len = terms.len();
            self.network.sums[var as usize] = Some(terms);
            for t in first..len {
                self.register(var, t);
            }
        }
    }

    /// Extracts a + r b if that saves `bound`; otherwise returns the actual saving.
    fn try_sum(&mut self, id: usize, a: u32, b: u32, r: u32, bound: isize) -> isize {
        let (a, b) = (
            self.divisors.product(a).to_vec(),
            self.divisors.product(b).to_vec(),
        );
        let r = self.divisors.number(r);
        let mut found: Vec<Occurrence> = Vec::new();
        for var in self.divisors.occurrences(id) {
            self.find(var, &a, &b, r, &mut found);
        }
        let mut best: (isize, Dd) = (0, Dd::ONE);
        for scale in scales(&found, r) {
            let saved = self.saved(&found, (&a, &b, r), scale);
            if saved > best.0 {
                best = (saved, scale);
            }
        }
        let (saved, scale) = best;
        if saved < bound || saved <= 0 {
            return saved;
        }
        let whole =
            |p: &&Occurrence| p.rest.is_empty() && near(p.k, scale) && self.terms(p.var).len() == 2;
        let sum = match found.iter().find(whole) {
            Some(candidate) => candidate.var,
            None => self.define(vec![
                NetworkTerm {
                    k: scale,
                    factors: a,
                },
                NetworkTerm {
                    k: scale * r,
                    factors: b,
                },
            ]),
        };
        self.substitute(
            found,
            |p| p.var,
            |_, p| {
                let k = quotient_of(p.k, scale);
                let mut factors = p.rest.clone();
                insert(&mut factors, sum);
                (p.var != sum).then_some((p.terms.to_vec(), NetworkTerm { k, factors }))
            },
        );
        0
    }

    /// Adds the occurrences of a + r b in a sum to `found`, no term twice.
    fn find(&self, var: Var, a: &[Var], b: &[Var], r: Dd, found: &mut Vec<Occurrence>) {
        let terms = self.terms(var);
        let mut taken = vec![false; terms.len()];
        for s in 0..terms.len() {
            if taken[s] {
                continue;
            }
            let Some(rest) = quotient(&terms[s].factors, a) else {
                continue;
            };
            let other = (0..terms.len()).find(|&t| {
                t != s
                    && !taken[t]
                    && is_product(&terms[t].factors, &rest, b)
                    && near(terms[t].k / terms[s].k, r)
            });
            if let Some(t) = other {
                (taken[s], taken[t]) = (true, true);
                found.push(Occurrence {
                    var,
                    terms: [s, t],
                    k: terms[s].k,
                    rest,
                });
            }
        }
    }

    /// Returns the saving of extracting scale · (a + r b).
    fn saved(&self, found: &[Occurrence], (a, b, r): (&[Var], &[Var], Dd), scale: Dd) -> isize {
        let cost = 1 + product_cost(scale, a.len()) + product_cost(scale * r, b.len());
        let mut saved = -(cost as isize);
        for candidate in found {
            let terms = self.terms(candidate.var);
            let [s, t] = candidate.terms;
            let after = product_cost(quotient_of(candidate.k, scale), candidate.rest.len() + 1);
            saved += (terms[s].cost() + terms[t].cost() + 1) as isize - after as isize;
        }
        saved
    }
}

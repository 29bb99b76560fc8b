//! Greedy extraction of common products and common two-term sums from the sums of a network.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use bgdyn_runtime::Dd;

use super::divisor::{
    Key, Literal, Place, divide, insert, near, number_key, quotient, quotient_of, scales,
};
use super::network::{Network, Term, Var, is_unit, product_cost};
use crate::expr::index::{Index, mix};

/// How far apart two terms of a sum may stand to be taken out together: time grows with it.
const WINDOW: usize = 32;

/// Something that may be taken out, with the variables whose sums may hold it.
struct Candidate {
    key: Key,
    places: Vec<Var>,
    /// What taking it out saves at the most.
    bound: isize,
}

/// The greedy search.
pub(super) struct Extraction<'a, 'g> {
    network: &'a mut Network<'g>,
    candidates: Vec<Candidate>,
    /// The candidates by their key.
    by_key: Index,
    queue: BinaryHeap<(isize, Reverse<usize>)>,
    cubes: Vec<Vec<Var>>,
    cube_ids: Index,
    numbers: Vec<Dd>,
    number_ids: Index,
    /// Two products, their memory used again and again.
    scratch: (Vec<Var>, Vec<Var>),
}

impl<'a, 'g> Extraction<'a, 'g> {
    /// Finds all that may be taken out of the network's sums.
    pub fn new(network: &'a mut Network<'g>) -> Self {
        let mut extraction = Extraction {
            network,
            candidates: Vec::new(),
            by_key: Index::default(),
            queue: BinaryHeap::new(),
            cubes: Vec::new(),
            cube_ids: Index::default(),
            numbers: Vec::new(),
            number_ids: Index::default(),
            scratch: Default::default(),
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

    /// Takes out what saves most until nothing saves anything.
    pub fn run(&mut self) {
        while let Some((bound, Reverse(id))) = self.queue.pop() {
            if bound != self.candidates[id].bound {
                continue;
            }
            let saved = match self.candidates[id].key {
                Key::Product(a, b) => self.try_product(id, a, b, bound),
                Key::Sum(a, b, r) => self.try_sum(id, a, b, r, bound),
            };
            self.candidates[id].bound = saved;
            if saved > 0 {
                self.queue.push((saved, Reverse(id)));
            }
        }
    }

    fn terms(&self, var: Var) -> &[Term] {
        self.network.sums[var as usize].as_deref().unwrap_or(&[])
    }

    /// Notes the pairs of factors in a term, and its pairs with terms shortly before it.
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
        let mut literals: Vec<Literal> = Vec::with_capacity(term.factors.len() + 1);
        literals.extend(term.factors.iter().map(|&f| Literal::Factor(f)));
        if !is_unit(k) {
            literals.insert(0, Literal::Number(self.number(k.abs())));
        }
        let mut seen: Vec<(Literal, Literal)> = Vec::new();
        for j in 1..literals.len() {
            for i in 0..j {
                let pair = (literals[i], literals[j]);
                if !seen.contains(&pair) {
                    seen.push(pair);
                    self.note(Key::Product(pair.0, pair.1), var, 1, -1);
                }
            }
        }
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
        let r = self.number(quotient_of(l, k));
        let key = Key::Sum(self.cube(&a), self.cube(&b), r);
        self.note(key, var, saved, -(least as isize));
        self.scratch = (a, b);
    }

    fn note(&mut self, key: Key, var: Var, saved: isize, cost: isize) {
        let hash = key.quick_hash();
        let is_it = |id: u32| self.candidates[id as usize].key == key;
        let id = match self.by_key.find(hash, is_it) {
            Some(id) => id as usize,
            None => {
                let id = self.candidates.len();
                self.by_key.insert(hash, id as u32);
                self.candidates.push(Candidate {
                    key,
                    places: Vec::new(),
                    bound: cost,
                });
                id
            }
        };
        let candidate = &mut self.candidates[id];
        if candidate.bound < cost {
            candidate.bound = cost;
        }
        candidate.bound += saved;
        if candidate.places.last() != Some(&var) {
            candidate.places.push(var);
        }
        if candidate.bound > 0 {
            self.queue.push((candidate.bound, Reverse(id)));
        }
    }

    fn number(&mut self, k: Dd) -> u32 {
        let key = number_key(k);
        let hash = mix(mix(0, key.0), key.1 as u64);
        let is_it = |id: u32| number_key(self.numbers[id as usize]) == key;
        if let Some(id) = self.number_ids.find(hash, is_it) {
            return id;
        }
        let id = self.numbers.len() as u32;
        self.numbers.push(k);
        self.number_ids.insert(hash, id);
        id
    }

    fn cube(&mut self, factors: &[Var]) -> u32 {
        let hash = factors.iter().fold(1, |h, &f| mix(h, u64::from(f)));
        let is_it = |id: u32| self.cubes[id as usize] == factors;
        if let Some(id) = self.cube_ids.find(hash, is_it) {
            return id;
        }
        let id = self.cubes.len() as u32;
        self.cubes.push(factors.to_vec());
        self.cube_ids.insert(hash, id);
        id
    }

    /// The variables whose sums may hold the candidate, each once, in order.
    fn places(&mut self, id: usize) -> Vec<Var> {
        let places = &mut self.candidates[id].places;
        places.sort_unstable();
        places.dedup();
        places.clone()
    }

    /// A variable for the sum of `terms`.
    fn define(&mut self, terms: Vec<Term>) -> Var {
        let var = self.network.sums.len() as Var;
        let n = terms.len();
        self.network.sums.push(Some(terms));
        for t in 0..n {
            self.register(var, t);
        }
        var
    }

    /// Takes a · b out where that saves `bound`; else says what it would save.
    fn try_product(&mut self, id: usize, a: Literal, b: Literal, bound: isize) -> isize {
        let mut found: Vec<(Var, usize)> = Vec::new();
        for var in self.places(id) {
            let terms = self.terms(var);
            let holds = |t: &Term| self.without(t, a, b).is_some();
            found.extend(
                (0..terms.len())
                    .filter(|&t| holds(&terms[t]))
                    .map(|t| (var, t)),
            );
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
                    (Literal::Number(k), Literal::Factor(f)) => Term {
                        k: self.numbers[k as usize],
                        factors: vec![f],
                    },
                    (Literal::Factor(f), Literal::Factor(g)) => Term {
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

    /// The term divided by a · b.
    fn without(&self, term: &Term, a: Literal, b: Literal) -> Option<Term> {
        let missing =
            |l| matches!(l, Literal::Factor(f) if term.factors.binary_search(&f).is_err());
        if missing(a) || missing(b) {
            return None;
        }
        let mut made = term.clone();
        for literal in [a, b] {
            match literal {
                Literal::Number(k) => {
                    if made.factors.is_empty() || !near(made.k.abs(), self.numbers[k as usize]) {
                        return None;
                    }
                    made.k = if made.k < Dd::ZERO { -Dd::ONE } else { Dd::ONE };
                }
                Literal::Factor(f) => {
                    let at = made.factors.binary_search(&f).ok()?;
                    made.factors.remove(at);
                }
            }
        }
        Some(made)
    }

    /// Puts one term in place of those of each find; finds in one sum stand together.
    fn substitute<F>(
        &mut self,
        found: Vec<F>,
        var_of: impl Fn(&F) -> Var,
        new: impl Fn(&Self, &F) -> Option<(Vec<usize>, Term)>,
    ) {
        for places in found.chunk_by(|x, y| var_of(x) == var_of(y)) {
            let var = var_of(&places[0]);
            let new: Vec<_> = places.iter().filter_map(|p| new(self, p)).collect();
            let gone: Vec<usize> = new.iter().flat_map(|(terms, _)| terms.clone()).collect();
            let terms = self.network.sums[var as usize].take().unwrap_or_default();
            let kept = terms.into_iter().enumerate();
            let mut terms: Vec<Term> = kept
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

    /// Takes a + r b out where that saves `bound`; else says what it would save.
    fn try_sum(&mut self, id: usize, a: u32, b: u32, r: u32, bound: isize) -> isize {
        let (a, b) = (
            self.cubes[a as usize].clone(),
            self.cubes[b as usize].clone(),
        );
        let r = self.numbers[r as usize];
        let mut found: Vec<Place> = Vec::new();
        for var in self.places(id) {
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
            |p: &&Place| p.rest.is_empty() && near(p.k, scale) && self.terms(p.var).len() == 2;
        let sum = match found.iter().find(whole) {
            Some(place) => place.var,
            None => self.define(vec![
                Term {
                    k: scale,
                    factors: a,
                },
                Term {
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
                (p.var != sum).then_some((p.terms.to_vec(), Term { k, factors }))
            },
        );
        0
    }

    /// Adds the places of a + r b in a sum to `found`, no term twice.
    fn find(&self, var: Var, a: &[Var], b: &[Var], r: Dd, found: &mut Vec<Place>) {
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
                    && terms[t].factors.len() == rest.len() + b.len()
                    && quotient(&terms[t].factors, b).is_some_and(|x| x == rest)
                    && near(terms[t].k / terms[s].k, r)
            });
            if let Some(t) = other {
                (taken[s], taken[t]) = (true, true);
                found.push(Place {
                    var,
                    terms: [s, t],
                    k: terms[s].k,
                    rest,
                });
            }
        }
    }

    /// What it saves to take out scale · (a + r b).
    fn saved(&self, found: &[Place], (a, b, r): (&[Var], &[Var], Dd), scale: Dd) -> isize {
        let cost = 1 + product_cost(scale, a.len()) + product_cost(scale * r, b.len());
        let mut saved = -(cost as isize);
        for place in found {
            let terms = self.terms(place.var);
            let [s, t] = place.terms;
            let after = product_cost(quotient_of(place.k, scale), place.rest.len() + 1);
            saved += (terms[s].cost() + terms[t].cost() + 1) as isize - after as isize;
        }
        saved
    }
}

//! A function as a network of sums of products, Σ kᵢ · Π factors, read from the expression graph.

use bgdyn_runtime::Dd;

use crate::expr::fold::cancelling_sum;
use crate::expr::{Graph, Node, NodeId, Signed, reachable};

/// A value that terms refer to: a node of the graph, or a sum created by the pass, numbered after the last
/// node.
pub(super) type Var = u32;

/// The values that are expanded in the terms that read them, although they have other readers.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Inline {
    /// Nothing.
    Nothing,
    /// A sum or product.
    One(NodeId),
    /// Every product, so that products are regrouped.
    Products,
}

/// k · Π factors, with sorted factors; without factors a number.
#[derive(Clone, Debug)]
pub(super) struct NetworkTerm {
    pub k: Dd,
    pub factors: Vec<Var>,
}

impl NetworkTerm {
    /// Returns the number of multiplications of the term.
    pub fn cost(&self) -> usize {
        product_cost(self.k, self.factors.len())
    }

    /// Multiplies by another term; the factors are not sorted.
    fn multiply(&mut self, other: &NetworkTerm) {
        self.k *= other.k;
        self.factors.extend(&other.factors);
    }
}

/// Returns the number of multiplications of a product of a number and this number of factors.
pub(super) fn product_cost(k: Dd, factors: usize) -> usize {
    match factors {
        0 => 0,
        n => n - 1 + usize::from(!is_unit(k)),
    }
}

pub(super) fn is_unit(k: Dd) -> bool {
    k == Dd::ONE || k == -Dd::ONE
}

/// Merges terms with equal factors; drops terms that cancel.
pub(super) fn merged(mut terms: Vec<NetworkTerm>) -> Vec<NetworkTerm> {
    terms.sort_by(|a, b| a.factors.cmp(&b.factors));
    let mut merged: Vec<NetworkTerm> = Vec::with_capacity(terms.len());
    for term in terms {
        match merged.last_mut() {
            Some(last) if last.factors == term.factors => last.k = cancelling_sum(last.k, term.k),
            _ => merged.push(term),
        }
    }
    merged.retain(|t| t.k != Dd::ZERO);
    merged
}

/// Returns the multiplications and additions of a sum.
fn sum_cost(terms: &[NetworkTerm]) -> usize {
    terms.len().saturating_sub(1) + cost_of_terms(terms)
}

/// Returns the multiplications of the terms.
fn cost_of_terms(terms: &[NetworkTerm]) -> usize {
    terms.iter().map(NetworkTerm::cost).sum()
}

/// Returns the cost of the merged sum whole + k · other of two merged sums.
fn cost_with(whole: &[NetworkTerm], other: &[NetworkTerm], k: Dd) -> usize {
    let (mut terms, mut cost) = (whole.len(), cost_of_terms(whole));
    for t in other {
        let mut sum = t.k * k;
        if let Ok(at) = whole.binary_search_by(|w| w.factors.cmp(&t.factors)) {
            sum = cancelling_sum(whole[at].k, sum);
            terms -= 1;
            cost -= whole[at].cost();
        }
        if sum != Dd::ZERO {
            terms += 1;
            cost += product_cost(sum, t.factors.len());
        }
    }
    terms.saturating_sub(1) + cost
}

/// The sums of a function.
pub(super) struct Network<'a> {
    pub graph: &'a Graph,
    /// Whether the results need a node.
    pub needed: Vec<bool>,
    /// The sum of each variable; `None` if it is no sum or product.
    pub sums: Vec<Option<Vec<NetworkTerm>>>,
    /// Nodes that are not changed: magnitudes of pivots, which bound the subtracted terms, and products
    /// with a quotient, which could overflow in another order.
    kept: Vec<bool>,
    /// The values that are expanded although they have other readers.
    spread: Inline,
    /// The number of terms, other nodes and results that read each variable; never too low.
    uses: Vec<usize>,
}

impl<'a> Network<'a> {
    /// Reads the graph: single uses are expanded if that costs nothing, and equal terms are merged.
    pub fn new(graph: &'a Graph, outputs: &[Signed], spread: Inline) -> Self {
        let needed = reachable(graph, outputs);
        let mut network = Network {
            graph,
            sums: vec![None; graph.len()],
            kept: vec![false; graph.len()],
            uses: vec![0; graph.len()],
            needed,
            spread,
        };
        for i in network.nodes() {
            network.read(i);
        }
        network.count_uses(outputs);
        for i in network.nodes() {
            network.write_out(i);
        }
        network.count_uses(outputs);
        network
    }

    /// Returns the nodes that the results need, operands first.
    fn nodes(&self) -> Vec<Var> {
        let all = 0..self.graph.len() as Var;
        all.filter(|&i| self.needed[i as usize]).collect()
    }

    fn read(&mut self, i: Var) {
        let node = self.graph.node(NodeId(i));
        self.sums[i as usize] = match *node {
            Node::Constant(c) => Some(vec![NetworkTerm {
                k: c.value(),
                factors: Vec::new(),
            }]),
            Node::Add(a, b) => {
                let second = if b.negative { -Dd::ONE } else { Dd::ONE };
                let terms = vec![self.scaled(a.0, Dd::ONE), self.scaled(b.node.0, second)];
                Some(merged(terms))
            }
            Node::Mul(a, b) => {
                let quotient = |id| matches!(self.graph.node(id), Node::Div(..));
                self.kept[i as usize] = quotient(a) || quotient(b);
                let mut product = self.scaled(a.0, Dd::ONE);
                product.multiply(&self.scaled(b.0, Dd::ONE));
                product.factors.sort_unstable();
                Some(vec![product])
            }
            Node::Pivot(_, magnitude, _) => {
                self.kept[magnitude.node.0 as usize] = true;
                None
            }
            _ => None,
        };
    }

    /// Returns k · var, with var replaced if it is a number or a multiple by a number.
    fn scaled(&self, var: Var, k: Dd) -> NetworkTerm {
        let (k, factors) = match self.sums[var as usize].as_deref() {
            Some([only]) if only.factors.len() <= 1 => (k * only.k, only.factors.clone()),
            Some([]) => (Dd::ZERO, Vec::new()),
            _ => (k, vec![var]),
        };
        NetworkTerm { k, factors }
    }

    fn count_uses(&mut self, outputs: &[Signed]) {
        let mut uses = vec![0; self.sums.len()];
        for e in outputs {
            uses[e.node.0 as usize] += 1;
        }
        // Values without readers read nothing; readers come after their operands.
        for i in (0..self.sums.len()).rev() {
            if uses[i] == 0 {
                continue;
            }
            match &self.sums[i] {
                Some(terms) => {
                    for term in terms {
                        for &f in &term.factors {
                            uses[f as usize] += 1;
                        }
                    }
                }
                None => {
                    let node = self.graph.node(NodeId(i as Var));
                    node.for_each_operand(|id| uses[id.0 as usize] += 1);
                }
            }
        }
        self.needed = uses.iter().map(|&n| n > 0).collect();
        self.uses = uses;
    }

    /// Returns whether it is to be expanded: only one term reads it.
    fn read_once(&self, var: Var) -> bool {
        let wanted = self.uses[var as usize] == 1 || self.spread == Inline::One(NodeId(var));
        wanted && !self.kept[var as usize]
    }

    /// Returns whether a product is to be expanded.
    fn opens(&self, var: Var) -> bool {
        let products = self.spread == Inline::Products && !self.kept[var as usize];
        products || self.read_once(var)
    }

    /// Expands products and sums that are read once, and multiples by numbers.
    fn write_out(&mut self, i: Var) {
        let Some(terms) = self.sums[i as usize].take() else {
            return;
        };
        let mut whole: Vec<NetworkTerm> = Vec::new();
        let mut inner: Vec<NetworkTerm> = Vec::new();
        for term in terms {
            let term = self.flat(&term);
            if term.k == Dd::ZERO {
                continue;
            }
            match term.factors[..] {
                [f] if self.read_once(f) && self.sums[f as usize].is_some() => inner.push(term),
                _ => whole.push(term),
            }
        }
        let mut whole = merged(whole);
        for term in inner {
            for f in self.factors_of(term.factors[0]) {
                self.uses[f as usize] += usize::from(self.uses[term.factors[0] as usize] > 1);
            }
            let sum = self.sums[term.factors[0] as usize]
                .as_deref()
                .unwrap_or(&[]);
            let apart = whole.len() + cost_of_terms(&whole) + term.cost() + sum_cost(sum);
            let wanted = self.spread == Inline::One(NodeId(term.factors[0]));
            if wanted || cost_with(&whole, sum, term.k) <= apart {
                whole.extend(sum.iter().map(|t| NetworkTerm {
                    k: t.k * term.k,
                    factors: t.factors.clone(),
                }));
            } else {
                whole.push(term);
            }
            whole = merged(whole);
        }
        let whole = self.cancelled(whole);
        self.sums[i as usize] = Some(whole);
    }

    /// Returns the sum with shared sums expanded in it, if enough of their terms merge with terms of this
    /// one to make it cheaper.
    fn cancelled(&mut self, mut whole: Vec<NetworkTerm>) -> Vec<NetworkTerm> {
        while let Some(cheaper) = (0..whole.len()).find_map(|t| self.opened(&whole, t)) {
            whole = cheaper;
            for &f in whole.iter().flat_map(|t| &t.factors) {
                self.uses[f as usize] += 1;
            }
        }
        whole
    }

    /// Returns the sum with its term t expanded; `None` if that is not cheaper.
    fn opened(&self, whole: &[NetworkTerm], t: usize) -> Option<Vec<NetworkTerm>> {
        let [f] = whole[t].factors[..] else {
            return None;
        };
        let inner = self.sums[f as usize].as_deref()?;
        // It cannot become cheaper unless a term merges with another one.
        let meets = |term: &NetworkTerm| {
            let at = whole.binary_search_by(|other| other.factors.cmp(&term.factors));
            at.is_ok_and(|other| other != t)
        };
        if self.kept[f as usize] || inner.len() < 2 || !inner.iter().any(meets) {
            return None;
        }
        let scaled = inner.iter().map(|term| NetworkTerm {
            k: term.k * whole[t].k,
            factors: term.factors.clone(),
        });
        let others = whole.iter().enumerate().filter(|(other, _)| *other != t);
        let others = others.map(|(_, term)| term.clone());
        let spread = merged(others.chain(scaled).collect());
        (sum_cost(&spread) < sum_cost(whole)).then_some(spread)
    }

    fn factors_of(&self, var: Var) -> Vec<Var> {
        let terms = self.sums[var as usize].as_deref().unwrap_or(&[]);
        let factors = terms.iter().flat_map(|t| &t.factors);
        factors.copied().collect()
    }

    /// Returns the term with products that are read once expanded.
    fn flat(&mut self, term: &NetworkTerm) -> NetworkTerm {
        let mut made = NetworkTerm {
            k: term.k,
            factors: Vec::with_capacity(term.factors.len()),
        };
        for &f in &term.factors {
            match self.sums[f as usize].as_deref() {
                Some([]) => made.k = Dd::ZERO,
                Some([only]) if only.factors.len() <= 1 || self.opens(f) => {
                    for &inner in &only.factors {
                        self.uses[inner as usize] += 1;
                    }
                    // If it was the only reader, its own uses of the operands end.
                    if self.uses[f as usize] == 1 {
                        for &inner in &only.factors {
                            self.uses[inner as usize] -= 1;
                        }
                    }
                    made.multiply(only);
                }
                _ => made.factors.push(f),
            }
        }
        made.factors.sort_unstable();
        made
    }
}

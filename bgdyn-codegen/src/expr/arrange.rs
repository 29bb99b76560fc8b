//! Orders the terms of sums by the time at which they are available, which shortens the critical path.
//!
//! The number of operations does not change.

use super::cost::{latency, reads};
use super::{Graph, Node, NodeId, QuickMap, Signed};

/// Copies `outputs` to a new graph, with the terms of every sum in the order of their availability. Sums
/// that have other readers, or a name, remain terms.
pub fn reassociate(from: &Graph, outputs: &[Signed]) -> (Graph, Vec<Signed>) {
    let mut sums = Sums {
        from,
        reads: reads(from, outputs),
        to: Graph::default(),
        copies: QuickMap::default(),
        ready: Vec::new(),
    };
    let titles = sums.to.adopt_sections(from);
    for id in sums.sums_to_arrange() {
        sums.to.reopen_section(from, id, titles);
        let copy = match from.node(id) {
            Node::Add(..) => sums.sum(id),
            node => sums.copied(node),
        };
        sums.to.copy_name(copy, from, id);
        sums.copies.insert(id, copy);
    }
    let outputs = outputs.iter().map(|&e| sums.at(e)).collect();
    (sums.to, outputs)
}

/// The state of the pass.
struct Sums<'a> {
    from: &'a Graph,
    reads: Vec<u32>,
    to: Graph,
    copies: QuickMap<NodeId, Signed>,
    /// Time at which each node of `to` is available, in multiplications.
    ready: Vec<usize>,
}

impl Sums<'_> {
    /// Returns whether a node is part of the sum that reads it, because nothing else reads it.
    fn is_part(&self, id: NodeId) -> bool {
        let is_sum = matches!(self.from.node(id), Node::Add(..));
        is_sum && self.reads[id.0 as usize] == 1
    }

    /// Returns the needed nodes, without sums that become part of another sum.
    fn sums_to_arrange(&self) -> Vec<NodeId> {
        let needed = |i: usize| self.reads[i] > 0;
        let mut wanted: Vec<bool> = (0..self.from.len()).map(needed).collect();
        for i in (0..self.from.len()).filter(|&i| needed(i)) {
            if let Node::Add(a, b) = &self.from.nodes[i] {
                for part in [*a, b.node].into_iter().filter(|&p| self.is_part(p)) {
                    wanted[part.0 as usize] = false;
                }
            }
        }
        let wanted = wanted.into_iter().enumerate();
        wanted
            .filter_map(|(i, w)| w.then_some(NodeId(i as u32)))
            .collect()
    }

    fn at(&self, e: Signed) -> Signed {
        self.copies[&e.node].flipped(e.negative)
    }

    /// Returns the same operation on the copies.
    fn copied(&mut self, node: &Node) -> Signed {
        let copies = &self.copies;
        let copy = self
            .to
            .rebuilt(node, |e| copies[&e.node].flipped(e.negative));
        self.note(None);
        copy
    }

    /// Records the times of the nodes made since the last call; the time of the last one is `last`, if
    /// given.
    fn note(&mut self, last: Option<usize>) {
        for i in self.ready.len()..self.to.len() {
            let node = &self.to.nodes[i];
            let mut begin = 0;
            node.for_each_operand(|operand| begin = begin.max(self.ready[operand.0 as usize]));
            self.ready.push(begin + latency(node));
        }
        if let (Some(at), Some(ready)) = (last, self.ready.last_mut()) {
            *ready = at;
        }
    }

    /// Returns the sum with its terms in the order of their availability.
    fn sum(&mut self, id: NodeId) -> Signed {
        let mut terms = Vec::new();
        self.terms(Signed::plus(id), &mut terms);
        let mut terms: Vec<(usize, Signed)> = terms
            .into_iter()
            .map(|term| (self.arrival(term), self.at(term)))
            .collect();
        terms.sort_by_key(|(arrival, _)| *arrival);
        let mut terms = terms.into_iter();
        let (mut ready, mut sum) = terms.next().expect("a sum has terms");
        ready = ready.max(self.ready[sum.node.0 as usize]);
        for (arrival, term) in terms {
            let before = self.to.len();
            sum = self.to.add(sum, term);
            ready = ready.max(arrival) + 1;
            self.note((self.to.len() > before).then_some(ready));
        }
        sum
    }

    /// Collects the terms of a sum, including those of its parts.
    fn terms(&self, e: Signed, terms: &mut Vec<Signed>) {
        let Node::Add(a, b) = self.from.node(e.node) else {
            unreachable!("only sums have terms")
        };
        for term in [Signed::plus(*a), *b] {
            let term = term.flipped(e.negative);
            match self.is_part(term.node) {
                true => self.terms(term, terms),
                false => terms.push(term),
            }
        }
    }

    /// Returns the time at which a term can be added: a product without other readers is fused with its
    /// addition.
    fn arrival(&self, term: Signed) -> usize {
        let ready = self.ready[self.at(term).node.0 as usize];
        let is_product = matches!(self.from.node(term.node), Node::Mul(..));
        match is_product && self.reads[term.node.0 as usize] == 1 {
            true => ready.saturating_sub(1),
            false => ready,
        }
    }
}

//! Rebuilds an expression graph from sums of products.

use bgdyn_runtime::Dd;

use super::network::{Network, NetworkTerm, Var};
use crate::expr::{Graph, NodeId, Signed};

/// Returns the graph of the network's sums. Nodes are in the order of the original graph; new sums precede
/// their first user.
pub(super) fn rebuild(network: &Network<'_>, outputs: &[Signed]) -> (Graph, Vec<Signed>) {
    let mut rebuild = Rebuild {
        network,
        made: vec![None; network.sums.len()],
        graph: Graph::default(),
    };
    let titles = rebuild.graph.adopt_sections(network.graph);
    let read = reachable(network, outputs);
    for i in (0..network.graph.len()).filter(|&i| read[i]) {
        let id = NodeId(i as Var);
        rebuild.graph.reopen_section(network.graph, id, titles);
        rebuild.make(i as Var);
    }
    let outputs = outputs.iter().map(|&e| rebuild.at(e)).collect();
    (rebuild.graph, outputs)
}

/// Returns, for each variable, whether the results need it.
fn reachable(network: &Network<'_>, outputs: &[Signed]) -> Vec<bool> {
    let mut read = vec![false; network.sums.len()];
    let mut stack: Vec<Var> = outputs.iter().map(|e| e.node.0).collect();
    while let Some(i) = stack.pop() {
        if !std::mem::replace(&mut read[i as usize], true) {
            for_each_operand(network, i, |operand| stack.push(operand));
        }
    }
    read
}

fn for_each_operand(network: &Network<'_>, i: Var, mut f: impl FnMut(Var)) {
    match &network.sums[i as usize] {
        Some(terms) => terms.iter().flat_map(|t| &t.factors).for_each(|&v| f(v)),
        None => network.graph.node(NodeId(i)).for_each_operand(|id| f(id.0)),
    }
}

struct Rebuild<'a> {
    network: &'a Network<'a>,
    made: Vec<Option<Signed>>,
    graph: Graph,
}

impl Rebuild<'_> {
    fn at(&self, e: Signed) -> Signed {
        let made = self.made[e.node.0 as usize].expect("operands are made first");
        made.flipped(e.negative)
    }

    /// Creates a variable, after the variables that it reads.
    fn make(&mut self, i: Var) {
        let mut stack = vec![i];
        while let Some(&i) = stack.last() {
            let before = stack.len();
            if self.made[i as usize].is_none() {
                for_each_operand(self.network, i, |operand| {
                    if self.made[operand as usize].is_none() {
                        stack.push(operand);
                    }
                });
                if stack.len() > before {
                    // The first operand of the reader is created first.
                    stack[before..].reverse();
                    continue;
                }
                self.step(i);
            }
            stack.pop();
        }
    }

    fn step(&mut self, i: Var) {
        let from = self.network.graph;
        let made = match &self.network.sums[i as usize] {
            Some(terms) => self.sum(terms),
            None => {
                let node = from.node(NodeId(i)).clone();
                let made = &self.made;
                let at = |e: Signed| {
                    let operand = made[e.node.0 as usize].expect("operands are made first");
                    operand.flipped(e.negative)
                };
                self.graph.rebuilt(&node, at)
            }
        };
        if (i as usize) < from.len() {
            self.graph.copy_name(made, from, NodeId(i));
        }
        self.made[i as usize] = Some(made);
    }

    /// Returns the sum of the terms in the order in which their factors are created.
    fn sum(&mut self, terms: &[NetworkTerm]) -> Signed {
        let mut sorted: Vec<(Vec<Signed>, Dd)> = terms
            .iter()
            .map(|t| {
                let plus = |&f: &Var| self.at(Signed::plus(NodeId(f)));
                let mut factors: Vec<Signed> = t.factors.iter().map(plus).collect();
                factors.sort();
                (factors, t.k)
            })
            .collect();
        sorted.sort_by_key(|(factors, _)| {
            let last = factors.last().copied();
            (last.is_none(), last, factors.len())
        });
        // A positive term comes first, so that the code does not begin with a sign.
        let added = |(factors, k): &(Vec<Signed>, Dd)| {
            factors
                .iter()
                .fold(*k > Dd::ZERO, |plus, f| plus ^ f.negative)
        };
        if let Some(first) = sorted.iter().position(added) {
            sorted[..=first].rotate_right(1);
        }
        let mut sum = self.graph.constant(Dd::ZERO);
        for (factors, k) in sorted {
            let mut product: Option<Signed> = None;
            for f in factors {
                product = Some(match product {
                    Some(p) => self.graph.mul(p, f),
                    None => f,
                });
            }
            let k = self.graph.constant(k);
            let product = match product {
                Some(p) => self.graph.mul(k, p),
                None => k,
            };
            sum = self.graph.add(sum, product);
        }
        sum
    }
}

//! Reverse differentiation: computes the derivatives of one number by all leaves in one pass.
//!
//! The adjoint of a node is the derivative of the number by it. From the results to the leaves, each node adds to the
//! adjoints of its operands: with y = f(a), ā ← ā + ȳ ∂f/∂a (Griewank and Walther 2008, section 3.2).

use std::collections::BTreeMap;

use bgdyn_runtime::Dd;

use super::{Graph, Leaf, Node, NodeId, Signed, reachable};

/// Returns the derivatives of Σ `factor` · `result` by the leaves of the results.
pub fn adjoints(g: &mut Graph, results: &[(Signed, Signed)]) -> BTreeMap<Leaf, Signed> {
    let outputs: Vec<Signed> = results.iter().map(|(result, _)| *result).collect();
    let needed = reachable(g, &outputs);
    let mut sweep = AdjointSweep {
        adjoints: vec![None; needed.len()],
    };
    for &(result, factor) in results {
        sweep.add(g, result, factor);
    }
    let mut by_leaf = BTreeMap::new();
    for i in (0..needed.len()).rev() {
        if let Some(adjoint) = sweep.adjoints[i] {
            let id = NodeId::at(i);
            match g.node(id).clone() {
                Node::Leaf(leaf) => {
                    by_leaf.insert(leaf, adjoint);
                }
                node => sweep.step(g, id, &node, adjoint),
            }
        }
    }
    by_leaf
}

/// The adjoints of the nodes that were reached.
struct AdjointSweep {
    adjoints: Vec<Option<Signed>>,
}

impl AdjointSweep {
    /// Adds to the adjoint of an expression.
    fn add(&mut self, g: &mut Graph, to: Signed, more: Signed) {
        let more = more.flipped(to.negative);
        let known = &mut self.adjoints[to.node.index()];
        *known = Some(match *known {
            None => more,
            Some(sum) => g.add(sum, more),
        });
    }

    /// Adds the adjoint of a node, times the slope by each operand, to those of its operands.
    fn step(&mut self, g: &mut Graph, id: NodeId, node: &Node, adjoint: Signed) {
        let this = Signed::plus(id);
        let plus = Signed::plus;
        match *node {
            Node::Constant(_) | Node::Leaf(_) | Node::Less(..) | Node::Sign(_) => {}
            Node::Add(a, b) => {
                self.add(g, plus(a), adjoint);
                self.add(g, b, adjoint);
            }
            Node::Mul(a, b) => self.product(g, (plus(a), plus(b)), adjoint),
            Node::MulAdd(a, b, negative, c) => {
                self.product(g, (plus(a), plus(b)), adjoint.flipped(negative));
                self.add(g, c, adjoint);
            }
            Node::Div(a, b) => {
                // ∂(a/b)/∂a = 1/b, ∂(a/b)/∂b = −(a/b)/b
                let by_a = g.div(adjoint, plus(b));
                let by_b = g.mul(by_a, this).flipped(true);
                self.add(g, plus(a), by_a);
                self.add(g, plus(b), by_b);
            }
            Node::Sqrt(a) => {
                let two = g.constant(Dd::from_f64(2.0));
                let denominator = g.mul(two, this);
                let by_a = g.div(adjoint, denominator);
                self.add(g, a, by_a);
            }
            Node::Angle(ref terms, ..) => {
                for &term in terms {
                    self.add(g, term, adjoint);
                }
            }
            Node::Sin(a) => {
                let cos = g.cos(plus(a));
                let by_a = g.mul(cos, adjoint);
                self.add(g, plus(a), by_a);
            }
            Node::Cos(a) => {
                let sin = g.sin(plus(a));
                let by_a = g.mul(sin, adjoint).flipped(true);
                self.add(g, plus(a), by_a);
            }
            Node::Exp(a) => {
                let by_a = g.mul(this, adjoint);
                self.add(g, a, by_a);
            }
            Node::Ln(a) => {
                let by_a = g.div(adjoint, a);
                self.add(g, a, by_a);
            }
            Node::Tanh(a) => {
                // tanh' = 1 − tanh²
                let (one, square) = (g.constant(Dd::ONE), g.mul(this, this));
                let slope = g.add(one, square.flipped(true));
                let by_a = g.mul(slope, adjoint);
                self.add(g, plus(a), by_a);
            }
            Node::Abs(a) => {
                let sign = g.sign(plus(a));
                let by_a = g.mul(sign, adjoint);
                self.add(g, plus(a), by_a);
            }
            Node::Min(a, b) => {
                let condition = g.less(a, b);
                self.branches(g, condition, (a, b), adjoint);
            }
            Node::Max(a, b) => {
                let condition = g.less(b, a);
                self.branches(g, condition, (a, b), adjoint);
            }
            Node::Select(condition, a, b) => self.branches(g, condition, (a, b), adjoint),
            Node::Pivot(value, ..) => self.add(g, value, adjoint),
        }
    }

    fn product(&mut self, g: &mut Graph, (a, b): (Signed, Signed), adjoint: Signed) {
        let (by_a, by_b) = (g.mul(adjoint, b), g.mul(adjoint, a));
        self.add(g, a, by_a);
        self.add(g, b, by_b);
    }

    /// The adjoint belongs to the branch that is taken.
    fn branches(
        &mut self,
        g: &mut Graph,
        condition: NodeId,
        (a, b): (Signed, Signed),
        adjoint: Signed,
    ) {
        let zero = g.constant(Dd::ZERO);
        let (by_a, by_b) = (
            g.select(condition, adjoint, zero),
            g.select(condition, zero, adjoint),
        );
        self.add(g, a, by_a);
        self.add(g, b, by_b);
    }
}

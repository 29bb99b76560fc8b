//! Forward differentiation: computes the tangent of every node for given tangents of the leaves.
//!
//! With q̇ as the tangent of q the result is a time derivative, with a unit vector a partial derivative.

use bgdyn_runtime::Dd;

use super::{Graph, Leaf, Node, NodeId, Signed};

/// A forward-mode pass over a graph under construction; it stores the computed tangents.
pub struct Tangent<S> {
    seed: S,
    /// The computed tangents, by node.
    made: Vec<Option<Signed>>,
}

impl<S: FnMut(&mut Graph, Leaf) -> Option<Signed>> Tangent<S> {
    /// Returns a pass in which `seed` is the tangent of a leaf, `None` for a constant leaf.
    pub fn new(seed: S) -> Self {
        Tangent {
            seed,
            made: Vec::new(),
        }
    }

    /// Returns the tangent of `e`.
    pub fn of(&mut self, g: &mut Graph, e: Signed) -> Signed {
        // Operands first, with an explicit stack: graphs can be too deep for recursion.
        let mut stack = vec![e.node];
        if self.made.len() < g.len() {
            self.made.resize(g.len(), None);
        }
        while let Some(&id) = stack.last() {
            let before = stack.len();
            if self.made[id.0 as usize].is_none() {
                g.node(id).for_each_operand(|operand| {
                    if self.made[operand.0 as usize].is_none() {
                        stack.push(operand);
                    }
                });
                if stack.len() > before {
                    continue;
                }
                let tangent = self.step(g, id);
                self.made[id.0 as usize] = Some(tangent);
            }
            stack.pop();
        }
        self.d(e)
    }

    fn d(&self, e: Signed) -> Signed {
        let tangent = self.made[e.node.0 as usize].expect("operands are first");
        tangent.flipped(e.negative)
    }

    fn step(&mut self, g: &mut Graph, id: NodeId) -> Signed {
        let this = Signed::plus(id);
        let plus = Signed::plus;
        let zero = g.constant(Dd::ZERO);
        match g.node(id).clone() {
            Node::Constant(_) | Node::Less(..) => zero,
            Node::Leaf(leaf) => (self.seed)(g, leaf).unwrap_or(zero),
            Node::Add(a, b) => {
                let (da, db) = (self.d(plus(a)), self.d(b));
                g.add(da, db)
            }
            Node::Mul(a, b) => self.product(g, plus(a), plus(b)),
            Node::Div(a, b) => {
                // (a/b)' = (a' − (a/b) b') / b
                let (da, db) = (self.d(plus(a)), self.d(plus(b)));
                let back = g.mul(this, db);
                let numerator = g.add(da, back.flipped(true));
                g.div(numerator, plus(b))
            }
            Node::MulAdd(a, b, negative, c) => {
                let product = self.product(g, plus(a), plus(b)).flipped(negative);
                let dc = self.d(c);
                g.add(product, dc)
            }
            Node::Sqrt(a) => {
                // (√a)' = a' / (2 √a)
                let two = g.constant(Dd::from_f64(2.0));
                let (da, denominator) = (self.d(a), g.mul(two, this));
                g.div(da, denominator)
            }
            Node::Angle(terms, ..) => terms.iter().fold(zero, |sum, &t| {
                let dt = self.d(t);
                g.add(sum, dt)
            }),
            Node::Sin(a) => {
                let (cos, da) = (g.cos(plus(a)), self.d(plus(a)));
                g.mul(cos, da)
            }
            Node::Cos(a) => {
                let (sin, da) = (g.sin(plus(a)), self.d(plus(a)));
                g.mul(sin, da).flipped(true)
            }
            Node::Exp(a) => {
                let da = self.d(a);
                g.mul(this, da)
            }
            Node::Ln(a) => {
                let da = self.d(a);
                g.div(da, a)
            }
            Node::Tanh(a) => {
                // tanh' = 1 − tanh²
                let (one, square) = (g.constant(Dd::ONE), g.mul(this, this));
                let slope = g.add(one, square.flipped(true));
                let da = self.d(plus(a));
                g.mul(slope, da)
            }
            Node::Abs(a) => {
                let (sign, da) = (g.sign(plus(a)), self.d(plus(a)));
                g.mul(sign, da)
            }
            Node::Sign(_) => zero,
            Node::Min(a, b) => {
                let condition = g.less(a, b);
                g.select(condition, self.d(a), self.d(b))
            }
            Node::Max(a, b) => {
                let condition = g.less(b, a);
                g.select(condition, self.d(a), self.d(b))
            }
            Node::Select(condition, a, b) => g.select(condition, self.d(a), self.d(b)),
            Node::Pivot(value, ..) => self.d(value),
        }
    }

    fn product(&self, g: &mut Graph, a: Signed, b: Signed) -> Signed {
        let (da, db) = (self.d(a), self.d(b));
        let (left, right) = (g.mul(da, b), g.mul(a, db));
        g.add(left, right)
    }
}

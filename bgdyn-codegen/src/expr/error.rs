//! Running error analysis (Wilkinson 1963): computes a bound for the rounding error of every node.
//!
//! The bound of a node is an expression too.
//!
//! Each operation adds half a unit in the last place of its result to the errors of its operands, to first
//! order. Bounds are in units of eps/2, so that one expression is valid for every scalar. Arguments are
//! exact, and so are numbers of few binary digits. A product, and a sum of terms that cannot cancel, has a
//! small relative error for any size. This distinguishes a small exact number from the result of a
//! cancellation, and needs no operation.

use bgdyn_runtime::Dd;

use super::{Graph, Node, NodeId, QuickMap, Signed};

/// Error of a sine or cosine of an exact angle, in units of eps/2.
const SINE: f64 = 4.0;

/// A bound for the rounding error of a number x, in units of eps/2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// This number times |x|.
    Relative(f64),
    /// The value of an expression.
    Absolute(Signed),
}

/// Known properties of a node.
#[derive(Clone, Copy)]
struct Known {
    bound: Bound,
    /// Whether it is never negative.
    positive: bool,
}

/// A pass over a graph under construction; it stores the computed bounds.
#[derive(Default)]
pub struct ErrorBound {
    made: QuickMap<NodeId, Known>,
}

impl ErrorBound {
    /// Returns the bound for the rounding error of `e`.
    pub fn of(&mut self, g: &mut Graph, e: Signed) -> Bound {
        // Operands first, with an explicit stack: graphs can be too deep for recursion.
        let mut stack = vec![e.node];
        while let Some(&id) = stack.last() {
            let before = stack.len();
            if !self.made.contains_key(&id) {
                g.node(id).for_each_operand(|operand| {
                    if !self.made.contains_key(&operand) {
                        stack.push(operand);
                    }
                });
                if stack.len() > before {
                    continue;
                }
                let known = self.step(g, id);
                self.made.insert(id, known);
            }
            stack.pop();
        }
        self.made[&e.node].bound
    }

    fn step(&self, g: &mut Graph, id: NodeId) -> Known {
        let plus = Signed::plus;
        let known = |bound, positive| Known { bound, positive };
        match g.node(id).clone() {
            Node::Constant(c) => {
                let digits = if exact(c.value()) { 0.0 } else { 1.0 };
                known(Bound::Relative(digits), true)
            }
            Node::Leaf(_) | Node::Angle(..) | Node::Less(..) | Node::Sign(_) => {
                known(Bound::Relative(0.0), false)
            }
            Node::Add(a, b) => self.sum(g, id, plus(a), b),
            Node::Mul(a, b) => self.product(g, id, a, b),
            Node::Div(a, b) => self.quotient(g, id, a, b),
            Node::MulAdd(a, b, negative, c) => {
                // Bounded as a product and a sum.
                let product = g.mul(plus(a), plus(b)).flipped(negative);
                let known = self.product(g, product.node, a, b);
                self.sum_of(g, id, (product, known), (c, self.made[&c.node]))
            }
            Node::Sin(a) | Node::Cos(a) => match self.made[&a].bound {
                Bound::Relative(0.0) => known(Bound::Relative(SINE), false),
                _ => {
                    let own = self.scaled(g, plus(id), SINE);
                    let angle = self.absolute(g, plus(a));
                    known(Bound::Absolute(g.add(own, angle)), false)
                }
            },
            Node::Sqrt(a) => match self.made[&a.node].bound {
                Bound::Relative(k) => known(Bound::Relative(0.5 * k + 1.0), true),
                Bound::Absolute(brought) => {
                    let two = g.constant(Dd::from_f64(2.0));
                    let twice = g.mul(two, plus(id));
                    let brought = g.div(brought, twice);
                    known(self.rounded(g, brought, plus(id)), true)
                }
            },
            Node::Exp(a) => {
                let brought = self.absolute(g, a);
                let brought = g.mul(brought, plus(id));
                known(self.rounded(g, brought, plus(id)), true)
            }
            Node::Ln(a) => {
                let brought = self.absolute(g, a);
                let brought = g.div(brought, a);
                known(self.rounded(g, brought, plus(id)), false)
            }
            Node::Tanh(a) => {
                let brought = self.absolute(g, plus(a));
                known(self.rounded(g, brought, plus(id)), false)
            }
            Node::Abs(a) => known(self.made[&a].bound, true),
            Node::Min(a, b) | Node::Max(a, b) | Node::Select(_, a, b) => {
                let (a, b) = (self.absolute(g, a), self.absolute(g, b));
                known(Bound::Absolute(g.max(a, b)), false)
            }
            Node::Pivot(a, ..) => known(self.made[&a.node].bound, true),
        }
    }

    fn sum(&self, g: &mut Graph, id: NodeId, a: Signed, b: Signed) -> Known {
        let (ka, kb) = (self.made[&a.node], self.made[&b.node]);
        self.sum_of(g, id, (a, ka), (b, kb))
    }

    fn sum_of(&self, g: &mut Graph, id: NodeId, a: (Signed, Known), b: (Signed, Known)) -> Known {
        let ((a, ka), (b, kb)) = (a, b);
        let positive = ka.positive && kb.positive && !a.negative && !b.negative;
        if let (true, Bound::Relative(x), Bound::Relative(y)) = (positive, ka.bound, kb.bound) {
            let bound = Bound::Relative(x.max(y) + 1.0);
            return Known { bound, positive };
        }
        let (a, b) = (
            self.as_expression(g, a, ka.bound),
            self.as_expression(g, b, kb.bound),
        );
        let brought = g.add(a, b);
        let bound = self.rounded(g, brought, Signed::plus(id));
        Known { bound, positive }
    }

    fn product(&self, g: &mut Graph, id: NodeId, a: NodeId, b: NodeId) -> Known {
        let (ka, kb) = (self.made[&a], self.made[&b]);
        let positive = a == b || (ka.positive && kb.positive);
        let (a, b) = (Signed::plus(a), Signed::plus(b));
        // Scaling by a power of two is exact.
        let scaling = g.constant_of(a).is_some_and(power_of_two);
        let bound = match (ka.bound, kb.bound) {
            (Bound::Relative(x), Bound::Relative(y)) => {
                Bound::Relative(x + y + if scaling { 0.0 } else { 1.0 })
            }
            // δ(a b) = |a| (δb + (k + 1) |b|) where a has the relative error k.
            (Bound::Relative(k), Bound::Absolute(brought)) => {
                self.scaled_error(g, (a, k + f64::from(u8::from(!scaling))), (b, brought))
            }
            (Bound::Absolute(brought), Bound::Relative(k)) => {
                self.scaled_error(g, (b, k + 1.0), (a, brought))
            }
            (Bound::Absolute(x), Bound::Absolute(y)) => {
                let (left, right) = (self.size(g, a), self.size(g, b));
                let (left, right) = (g.mul(left, y), g.mul(right, x));
                let brought = g.add(left, right);
                self.rounded(g, brought, Signed::plus(id))
            }
        };
        Known { bound, positive }
    }

    fn scaled_error(&self, g: &mut Graph, a: (Signed, f64), b: (Signed, Signed)) -> Bound {
        let own = self.scaled(g, b.0, a.1);
        let brought = g.add(b.1, own);
        let size = self.size(g, a.0);
        Bound::Absolute(g.mul(size, brought))
    }

    fn quotient(&self, g: &mut Graph, id: NodeId, a: NodeId, b: NodeId) -> Known {
        let (ka, kb) = (self.made[&a], self.made[&b]);
        let positive = ka.positive && kb.positive;
        let bound = match (ka.bound, kb.bound) {
            (Bound::Relative(x), Bound::Relative(y)) => Bound::Relative(x + y + 1.0),
            _ => {
                // (δa + |a/b| δb) / |b|
                let this = Signed::plus(id);
                let (da, db) = (
                    self.absolute(g, Signed::plus(a)),
                    self.absolute(g, Signed::plus(b)),
                );
                let size = if positive { this } else { g.abs(this) };
                let share = g.mul(size, db);
                let brought = g.add(da, share);
                let below = self.size(g, Signed::plus(b));
                let brought = g.div(brought, below);
                let own = if positive { this } else { g.abs(this) };
                Bound::Absolute(g.add(brought, own))
            }
        };
        Known { bound, positive }
    }

    /// Returns the bound as an expression.
    fn absolute(&self, g: &mut Graph, e: Signed) -> Signed {
        self.as_expression(g, e, self.made[&e.node].bound)
    }

    fn as_expression(&self, g: &mut Graph, e: Signed, bound: Bound) -> Signed {
        match bound {
            Bound::Relative(k) => self.scaled(g, e, k),
            Bound::Absolute(bound) => bound,
        }
    }

    /// Returns k |e|.
    fn scaled(&self, g: &mut Graph, e: Signed, k: f64) -> Signed {
        let (k, size) = (g.constant(Dd::from_f64(k)), self.size(g, e));
        g.mul(k, size)
    }

    /// Returns |e|, factor by factor, so that sizes of factors are shared.
    fn size(&self, g: &mut Graph, e: Signed) -> Signed {
        let e = Signed::plus(e.node);
        if self.made.get(&e.node).is_some_and(|known| known.positive) {
            return e;
        }
        match *g.node(e.node) {
            Node::Mul(k, x) if g.constant_of(Signed::plus(k)).is_some() => {
                let size = self.size(g, Signed::plus(x));
                g.mul(Signed::plus(k), size)
            }
            _ => g.abs(e),
        }
    }

    /// Returns the sum of the operands' errors and the rounding of the result.
    fn rounded(&self, g: &mut Graph, brought: Signed, result: Signed) -> Bound {
        let size = self.size(g, result);
        Bound::Absolute(g.add(brought, size))
    }
}

/// Returns whether every binary scalar represents the number exactly: it has few binary digits.
fn exact(x: Dd) -> bool {
    x.lo() == 0.0 && f64::from(x.hi() as f32) == x.hi()
}

fn power_of_two(x: Dd) -> bool {
    x.lo() == 0.0 && x.hi().to_bits() & ((1 << 52) - 1) == 0
}

//! Constructors of nodes, which fold constants and normalise signs; nodes are added only by them.

use bgdyn_runtime::{Dd, Scalar};

use super::{Constant, Graph, Leaf, Node, NodeId, Signed};

/// Sums of constants smaller than this fraction of their terms are cancellations, hence zero.
const CANCELLED: f64 = 1.0 / (1u128 << 98) as f64;

impl Graph {
    /// Returns a number.
    pub fn constant(&mut self, x: Dd) -> Signed {
        let negative = x < Dd::ZERO;
        let node = self.intern(Node::Constant(Constant::new(if negative { -x } else { x })));
        Signed { node, negative }
    }

    /// Returns an argument of the function.
    pub fn leaf(&mut self, leaf: Leaf) -> Signed {
        Signed::plus(self.intern(Node::Leaf(leaf)))
    }

    /// Returns a + b.
    pub fn add(&mut self, a: Signed, b: Signed) -> Signed {
        match (self.constant_of(a), self.constant_of(b)) {
            (Some(x), Some(y)) => return self.constant(cancelling_sum(x, y)),
            (Some(x), None) if x == Dd::ZERO => return b,
            (None, Some(y)) if y == Dd::ZERO => return a,
            (Some(x), None) => return self.add_constant(b, x),
            (None, Some(y)) => return self.add_constant(a, y),
            (None, None) => {}
        }
        // k₁ x + k₂ x = (k₁ + k₂) x
        let ((ka, xa), (kb, xb)) = (self.coefficient(a), self.coefficient(b));
        if xa == xb {
            let k = self.constant(cancelling_sum(ka, kb));
            return self.mul(k, Signed::plus(xa));
        }
        self.intern_sum(a, b)
    }

    /// Returns x + k for a constant k: (y + k₀) + k = y + (k₀ + k).
    pub(super) fn add_constant(&mut self, x: Signed, k: Dd) -> Signed {
        if let Node::Add(p, q) = *self.node(x.node) {
            let (p, q) = (Signed::plus(p).flipped(x.negative), q.flipped(x.negative));
            for (constant, rest) in [(p, q), (q, p)] {
                if let Some(k0) = self.constant_of(constant) {
                    let sum = self.constant(cancelling_sum(k0, k));
                    return self.add(rest, sum);
                }
            }
        }
        let k = self.constant(k);
        self.intern_sum(x, k)
    }

    fn intern_sum(&mut self, a: Signed, b: Signed) -> Signed {
        let (a, b) = if a.node <= b.node { (a, b) } else { (b, a) };
        let node = self.intern(Node::Add(a.node, b.flipped(a.negative)));
        Signed {
            node,
            negative: a.negative,
        }
    }

    /// Splits x = k·y into the constant factor k (1 if there is none) and y.
    fn coefficient(&self, x: Signed) -> (Dd, NodeId) {
        let sign = if x.negative { -Dd::ONE } else { Dd::ONE };
        if let Node::Mul(k, y) = *self.node(x.node)
            && let Some(k) = self.constant_of(Signed::plus(k))
        {
            return (k * sign, y);
        }
        (sign, x.node)
    }

    /// Returns a · b.
    pub fn mul(&mut self, a: Signed, b: Signed) -> Signed {
        let negative = a.negative ^ b.negative;
        let (ka, kb) = (
            self.constant_of(Signed::plus(a.node)),
            self.constant_of(Signed::plus(b.node)),
        );
        let (k, x) = match (ka, kb) {
            (Some(x), Some(y)) => return self.constant(x * y).flipped(negative),
            (Some(k), None) => (k, b.node),
            (None, Some(k)) => (k, a.node),
            (None, None) => {
                let node = self.intern(Node::Mul(a.node.min(b.node), a.node.max(b.node)));
                return Signed { node, negative };
            }
        };
        self.scale(k, x).flipped(negative)
    }

    /// Returns k · x for a constant k.
    pub(super) fn times(&mut self, k: Dd, x: Signed) -> Signed {
        let negative = k < Dd::ZERO;
        let size = if negative { -k } else { k };
        self.scale(size, x.node).flipped(negative ^ x.negative)
    }

    /// Returns k · x for a constant k ≥ 0; the constant is the first operand, and the only constant
    /// factor.
    fn scale(&mut self, k: Dd, x: NodeId) -> Signed {
        if k == Dd::ZERO {
            return self.constant(Dd::ZERO);
        }
        let (k0, x) = self.coefficient(Signed::plus(x));
        let k = k * k0;
        if k == Dd::ONE {
            return Signed::plus(x);
        }
        let k = self.constant(k);
        let node = self.intern(Node::Mul(k.node, x));
        Signed {
            node,
            negative: k.negative,
        }
    }

    /// Returns a / b; division by a constant becomes a product.
    pub fn div(&mut self, a: Signed, b: Signed) -> Signed {
        if let Some(k) = self.constant_of(b)
            && k != Dd::ZERO
        {
            let inverse = self.constant(Dd::ONE / k);
            return self.mul(a, inverse);
        }
        if self.constant_of(a) == Some(Dd::ZERO) {
            return a;
        }
        let node = self.intern(Node::Div(a.node, b.node));
        Signed {
            node,
            negative: a.negative ^ b.negative,
        }
    }

    /// Returns a · b + c as one node, for passes that fuse.
    pub fn mul_add(&mut self, a: Signed, b: Signed, c: Signed) -> Signed {
        let product_negative = a.negative ^ b.negative;
        let (x, y) = (a.node.min(b.node), a.node.max(b.node));
        Signed::plus(self.intern(Node::MulAdd(x, y, product_negative, c)))
    }

    /// Returns the exact sum of angles and a constant, rad; for [`Graph::sin`] and [`Graph::cos`].
    ///
    /// Equal angles of opposite sign cancel; the order of the terms does not matter. The first term is
    /// positive; the returned value carries the sign of the sum.
    pub fn angle(&mut self, terms: &[Signed], offset: Dd) -> Signed {
        let mut sorted: Vec<Signed> = Vec::with_capacity(terms.len());
        for &term in terms {
            match sorted.iter().position(|&t| t == term.flipped(true)) {
                Some(opposite) => {
                    sorted.remove(opposite);
                }
                None => sorted.push(term),
            }
        }
        sorted.sort();
        if sorted.is_empty() {
            return self.constant(offset);
        }
        let flip = sorted[0].negative;
        sorted.iter_mut().for_each(|t| *t = t.flipped(flip));
        let offset = if flip { -offset } else { offset };
        if sorted.len() == 1 && offset == Dd::ZERO {
            return sorted[0].flipped(flip);
        }
        let negative = offset < Dd::ZERO;
        let size = Constant::new(if negative { -offset } else { offset });
        let node = self.intern(Node::Angle(sorted.into(), size, negative));
        Signed {
            node,
            negative: flip,
        }
    }

    /// Returns sin a.
    pub fn sin(&mut self, a: Signed) -> Signed {
        match self.constant_of(a) {
            Some(x) => self.constant(x.sin_cos().0),
            None => Signed {
                node: self.intern(Node::Sin(a.node)),
                negative: a.negative,
            },
        }
    }

    /// Returns cos a.
    pub fn cos(&mut self, a: Signed) -> Signed {
        match self.constant_of(a) {
            Some(x) => self.constant(x.sin_cos().1),
            None => Signed::plus(self.intern(Node::Cos(a.node))),
        }
    }

    /// Returns √a.
    pub fn sqrt(&mut self, a: Signed) -> Signed {
        self.unary(a, Scalar::sqrt, Node::Sqrt)
    }

    /// Returns eᵃ.
    pub fn exp(&mut self, a: Signed) -> Signed {
        self.unary(a, Scalar::exp, Node::Exp)
    }

    /// Returns ln a.
    pub fn ln(&mut self, a: Signed) -> Signed {
        self.unary(a, Scalar::ln, Node::Ln)
    }

    fn unary(&mut self, a: Signed, fold: fn(Dd) -> Dd, node: fn(Signed) -> Node) -> Signed {
        match self.constant_of(a) {
            Some(x) => self.constant(fold(x)),
            None => Signed::plus(self.intern(node(a))),
        }
    }

    /// Returns tanh a.
    pub fn tanh(&mut self, a: Signed) -> Signed {
        self.odd(a, Scalar::tanh, Node::Tanh)
    }

    /// Returns −1, 0 or 1.
    pub fn sign(&mut self, a: Signed) -> Signed {
        self.odd(a, Scalar::sign, Node::Sign)
    }

    fn odd(&mut self, a: Signed, fold: fn(Dd) -> Dd, node: fn(NodeId) -> Node) -> Signed {
        match self.constant_of(a) {
            Some(x) => self.constant(fold(x)),
            None => Signed {
                node: self.intern(node(a.node)),
                negative: a.negative,
            },
        }
    }

    /// Returns |a|.
    pub fn abs(&mut self, a: Signed) -> Signed {
        match self.constant_of(a) {
            Some(x) => self.constant(Scalar::abs(x)),
            None => Signed::plus(self.intern(Node::Abs(a.node))),
        }
    }

    /// Returns the smaller of a and b.
    pub fn min(&mut self, a: Signed, b: Signed) -> Signed {
        match (self.constant_of(a), self.constant_of(b)) {
            (Some(x), Some(y)) => self.constant(Scalar::min(x, y)),
            _ if a == b => a,
            _ => Signed::plus(self.intern(Node::Min(a.min(b), a.max(b)))),
        }
    }

    /// Returns the larger of a and b.
    pub fn max(&mut self, a: Signed, b: Signed) -> Signed {
        match (self.constant_of(a), self.constant_of(b)) {
            (Some(x), Some(y)) => self.constant(Scalar::max(x, y)),
            _ if a == b => a,
            _ => Signed::plus(self.intern(Node::Max(a.min(b), a.max(b)))),
        }
    }

    /// Returns the condition a < b, for [`Graph::select`].
    pub fn less(&mut self, a: Signed, b: Signed) -> NodeId {
        self.intern(Node::Less(a, b))
    }

    /// Returns `a` where the condition is true, else `b`.
    pub fn select(&mut self, condition: NodeId, a: Signed, b: Signed) -> Signed {
        if a == b {
            return a;
        }
        Signed::plus(self.intern(Node::Select(condition, a, b)))
    }

    /// Returns a pivot with its check; see [`Node::Pivot`].
    pub fn pivot(&mut self, value: Signed, magnitude: Signed, joint: usize) -> Signed {
        match (self.constant_of(value), self.constant_of(magnitude)) {
            (Some(x), Some(m)) if x > Dd::ZERO && m == Dd::ZERO => value,
            _ => Signed::plus(self.intern(Node::Pivot(value, magnitude, joint))),
        }
    }
}

/// Returns x + y, or 0 if the sum is a rounding error of double-double.
pub(super) fn cancelling_sum(x: Dd, y: Dd) -> Dd {
    let sum = x + y;
    let terms = x.hi().abs().max(y.hi().abs());
    if sum.hi().abs() <= CANCELLED * terms {
        Dd::ZERO
    } else {
        sum
    }
}

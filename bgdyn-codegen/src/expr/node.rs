//! Nodes of an expression graph: constants, leaves, operations.

use std::hash::{Hash, Hasher};

use bgdyn_runtime::Dd;

use super::index::{QuickHasher, mix};

/// A node of a [`super::Graph`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(pub(crate) u32);

impl NodeId {
    /// Returns the node with this index in its graph.
    pub fn at(index: usize) -> Self {
        NodeId(index as u32)
    }

    /// Returns its index in its graph.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A node with a sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Signed {
    /// The node.
    pub node: NodeId,
    /// Whether its value is taken with the opposite sign.
    pub negative: bool,
}

impl Signed {
    pub(crate) fn plus(node: NodeId) -> Self {
        Signed {
            node,
            negative: false,
        }
    }

    /// Returns the value with its sign flipped if `flip` is true.
    pub(crate) fn flipped(self, flip: bool) -> Self {
        Signed {
            negative: self.negative ^ flip,
            ..self
        }
    }
}

/// A constant as a key: the bits of its two words. Constants of nodes are never negative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Constant {
    hi: u64,
    lo: u64,
}

impl Constant {
    pub(crate) fn new(x: Dd) -> Self {
        // One zero only: −0 and +0 are the same constant.
        let lo = if x.lo() == 0.0 { 0.0 } else { x.lo() };
        let hi = if x.hi() == 0.0 { 0.0 } else { x.hi() };
        Constant {
            hi: f64::to_bits(hi),
            lo: f64::to_bits(lo),
        }
    }

    /// Returns its value.
    pub fn value(self) -> Dd {
        Dd::new(f64::from_bits(self.hi), f64::from_bits(self.lo))
    }
}

/// An argument of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Leaf {
    /// Component of q.
    Position(usize),
    /// Component of v.
    Velocity(usize),
    /// Component of a.
    Acceleration(usize),
    /// First-order state (bristle, fluid volume): component of x.
    State(usize),
    /// Input: joint effort, voltage, valve opening, wrench.
    Input(usize),
    /// Discrete mode (stuck, slipping).
    Mode(usize),
    /// Run-time parameter.
    Parameter(usize),
    /// Time, s.
    Time,
    /// Result `index` of an earlier block of the same function.
    BlockResult {
        /// The block.
        block: usize,
        /// Its output.
        index: usize,
    },
}

/// An operation. Operands precede the node that uses them.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A number, never negative.
    Constant(Constant),
    /// An argument.
    Leaf(Leaf),
    /// a ± b.
    Add(NodeId, Signed),
    /// a · b.
    Mul(NodeId, NodeId),
    /// a / b.
    Div(NodeId, NodeId),
    /// a · b + c with one rounding if the machine has it; `true`: the product's sign is flipped.
    MulAdd(NodeId, NodeId, bool, Signed),
    /// √a.
    Sqrt(Signed),
    /// Σ ±angle + offset, exact in the sine; read by [`Node::Sin`], [`Node::Cos`] only.
    Angle(Box<[Signed]>, Constant, bool),
    /// Sine of an [`Node::Angle`] or of any value.
    Sin(NodeId),
    /// Cosine.
    Cos(NodeId),
    /// eᵃ.
    Exp(Signed),
    /// ln a.
    Ln(Signed),
    /// tanh a.
    Tanh(NodeId),
    /// |a|.
    Abs(NodeId),
    /// The smaller value.
    Min(Signed, Signed),
    /// The larger value.
    Max(Signed, Signed),
    /// −1, 0, 1.
    Sign(NodeId),
    /// a < b: a truth value, read by [`Node::Select`] only.
    Less(Signed, Signed),
    /// The first value where the condition is true, else the second.
    Select(NodeId, Signed, Signed),
    /// A pivot of a factorisation of the mass matrix: the value, the magnitude of the subtracted terms,
    /// and the joint for the error if it is refused.
    Pivot(Signed, Signed, usize),
}

impl Node {
    /// Calls `f` with each operand.
    pub fn for_each_operand(&self, mut f: impl FnMut(NodeId)) {
        match self {
            Node::Constant(_) | Node::Leaf(_) => {}
            Node::Add(a, b) => {
                f(*a);
                f(b.node);
            }
            Node::Mul(a, b) | Node::Div(a, b) => {
                f(*a);
                f(*b);
            }
            Node::MulAdd(a, b, _, c) => {
                f(*a);
                f(*b);
                f(c.node);
            }
            Node::Angle(terms, ..) => terms.iter().for_each(|t| f(t.node)),
            Node::Sqrt(a) | Node::Exp(a) | Node::Ln(a) => f(a.node),
            Node::Sin(a) | Node::Cos(a) | Node::Tanh(a) | Node::Abs(a) | Node::Sign(a) => f(*a),
            Node::Min(a, b) | Node::Max(a, b) | Node::Less(a, b) | Node::Pivot(a, b, _) => {
                f(a.node);
                f(b.node);
            }
            Node::Select(condition, a, b) => {
                f(*condition);
                f(a.node);
                f(b.node);
            }
        }
    }
}

impl Node {
    /// Returns the node with each operand replaced. If the node stores no sign of an operand, the
    /// replacement must have none.
    pub(crate) fn map_operands(self, mut f: impl FnMut(Signed) -> Signed) -> Node {
        let plain = |id: NodeId, f: &mut dyn FnMut(Signed) -> Signed| f(Signed::plus(id)).node;
        match self {
            Node::Constant(_) | Node::Leaf(_) => self,
            Node::Add(a, b) => Node::Add(plain(a, &mut f), f(b)),
            Node::Mul(a, b) => Node::Mul(plain(a, &mut f), plain(b, &mut f)),
            Node::Div(a, b) => Node::Div(plain(a, &mut f), plain(b, &mut f)),
            Node::MulAdd(a, b, negative, c) => {
                Node::MulAdd(plain(a, &mut f), plain(b, &mut f), negative, f(c))
            }
            Node::Sqrt(a) => Node::Sqrt(f(a)),
            Node::Angle(terms, offset, negative) => {
                Node::Angle(terms.iter().map(|&t| f(t)).collect(), offset, negative)
            }
            Node::Sin(a) => Node::Sin(plain(a, &mut f)),
            Node::Cos(a) => Node::Cos(plain(a, &mut f)),
            Node::Exp(a) => Node::Exp(f(a)),
            Node::Ln(a) => Node::Ln(f(a)),
            Node::Tanh(a) => Node::Tanh(plain(a, &mut f)),
            Node::Abs(a) => Node::Abs(plain(a, &mut f)),
            Node::Min(a, b) => Node::Min(f(a), f(b)),
            Node::Max(a, b) => Node::Max(f(a), f(b)),
            Node::Sign(a) => Node::Sign(plain(a, &mut f)),
            Node::Less(a, b) => Node::Less(f(a), f(b)),
            Node::Select(condition, a, b) => Node::Select(plain(condition, &mut f), f(a), f(b)),
            Node::Pivot(value, magnitude, joint) => Node::Pivot(f(value), f(magnitude), joint),
        }
    }

    /// Returns its hash, with a short computation for the most frequent kinds.
    pub(super) fn quick_hash(&self) -> u64 {
        let signed = |e: &Signed| u64::from(e.node.0) << 1 | u64::from(e.negative);
        match self {
            Node::Constant(c) => mix(mix(1, c.hi), c.lo),
            Node::Add(a, b) => mix(mix(2, u64::from(a.0)), signed(b)),
            Node::Mul(a, b) => mix(mix(3, u64::from(a.0)), u64::from(b.0)),
            _ => {
                let mut hasher = QuickHasher::default();
                self.hash(&mut hasher);
                hasher.finish()
            }
        }
    }
}

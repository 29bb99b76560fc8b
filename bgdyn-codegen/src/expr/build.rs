//! Arithmetic operators on expressions, with which formulations are written like their equations.
//!
//! Arithmetic on numbers creates no nodes: a number becomes a node when it is combined with a node.

use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use bgdyn_runtime::Dd;

use super::fold::cancelling_sum;
use super::{Graph, Leaf, Signed};
use crate::math::Vec3;

/// A graph under construction.
#[derive(Clone, Default)]
pub struct Builder {
    graph: RefCell<Graph>,
    /// Whether the graph is not for readers: no names, no titles.
    silent: bool,
}

impl From<Graph> for Builder {
    /// Continues the construction of a graph.
    fn from(graph: Graph) -> Self {
        Builder {
            graph: RefCell::new(graph),
            silent: false,
        }
    }
}

/// An expression of a graph under construction.
#[derive(Clone, Copy)]
pub struct Expr<'g> {
    builder: &'g Builder,
    value: Operand,
}

/// The content of an expression.
#[derive(Clone, Copy, PartialEq)]
enum Operand {
    /// A number, which has no node yet.
    Number(Dd),
    /// A node that is not constant.
    Node(Signed),
}

impl Builder {
    /// Returns an empty graph.
    pub fn new() -> Self {
        Self::default()
    }

    /// Returns an empty graph without names, for counting operations.
    pub fn silent() -> Self {
        Builder {
            silent: true,
            ..Builder::default()
        }
    }

    /// Returns whether it keeps no names.
    pub fn is_silent(&self) -> bool {
        self.silent
    }

    /// Returns the finished graph.
    pub fn into_graph(self) -> Graph {
        self.graph.into_inner()
    }

    fn make(&self, f: impl FnOnce(&mut Graph) -> Signed) -> Expr<'_> {
        let mut graph = self.graph.borrow_mut();
        let expr = f(&mut graph);
        let value = match graph.constant_of(expr) {
            Some(x) => Operand::Number(x),
            None => Operand::Node(expr),
        };
        Expr {
            builder: self,
            value,
        }
    }

    /// Returns an expression of this graph.
    pub fn expr(&self, expr: Signed) -> Expr<'_> {
        self.make(|_| expr)
    }

    /// Applies a pass to the graph under construction.
    pub fn with_graph<R>(&self, f: impl FnOnce(&mut Graph) -> R) -> R {
        f(&mut self.graph.borrow_mut())
    }

    /// Begins a section with this title, for readers of the output.
    pub fn section(&self, title: impl FnOnce() -> String) {
        if !self.silent {
            self.graph.borrow_mut().begin_section(title());
        }
    }

    /// Sets the unit of length of the following sections, m.
    pub fn unit_of_length(&self, unit: Dd) {
        self.graph.borrow_mut().set_unit_of_length(unit);
    }

    /// Returns a number.
    pub fn constant(&self, x: Dd) -> Expr<'_> {
        Expr {
            builder: self,
            value: Operand::Number(x),
        }
    }

    /// Returns zero.
    pub fn zero(&self) -> Expr<'_> {
        self.constant(Dd::ZERO)
    }

    /// Returns a small number such as 1, 2 or ½.
    pub fn number(&self, x: f64) -> Expr<'_> {
        self.constant(Dd::from_f64(x))
    }

    /// Returns a vector of numbers.
    pub fn vector(&self, v: Vec3<Dd>) -> Vec3<Expr<'_>> {
        v.map(|x| self.constant(x))
    }

    /// Returns an argument.
    pub fn leaf(&self, leaf: Leaf) -> Expr<'_> {
        self.make(|g| g.leaf(leaf))
    }

    /// Returns cosine and sine of the exact sum of angles and a constant.
    pub fn cos_sin(&self, angles: &[Expr<'_>], offset: Dd) -> (Expr<'_>, Expr<'_>) {
        let terms: Vec<Signed> = angles.iter().map(|a| a.signed()).collect();
        let angle = self.graph.borrow_mut().angle(&terms, offset);
        (self.make(|g| g.cos(angle)), self.make(|g| g.sin(angle)))
    }
}

impl<'g> Expr<'g> {
    /// Returns the expression in the graph.
    pub fn signed(self) -> Signed {
        match self.value {
            Operand::Number(x) => self.builder.graph.borrow_mut().constant(x),
            Operand::Node(expr) => expr,
        }
    }

    fn number(self, x: Dd) -> Self {
        self.builder.constant(x)
    }

    /// Returns its value if it is a constant.
    pub fn as_constant(self) -> Option<Dd> {
        match self.value {
            Operand::Number(x) => Some(x),
            Operand::Node(_) => None,
        }
    }

    /// Returns whether it is the constant 0.
    pub fn is_zero(self) -> bool {
        self.as_constant() == Some(Dd::ZERO)
    }

    /// Names its node for readers of the output.
    pub fn named(self, name: impl FnOnce() -> String) -> Self {
        if !self.builder.silent {
            let mut graph = self.builder.graph.borrow_mut();
            match self.value {
                Operand::Node(expr) => graph.set_name(expr, name),
                Operand::Number(x) => graph.set_constant_name(x, name, false),
            }
        }
        self
    }

    /// Names a number of the mechanism; a number that several quantities share has no name.
    pub fn named_alone(self, name: impl FnOnce() -> String) -> Self {
        match self.value {
            Operand::Number(x) if !self.builder.silent => {
                let mut graph = self.builder.graph.borrow_mut();
                graph.set_constant_name(x, name, true);
                self
            }
            _ => self.named(name),
        }
    }

    /// Says what a named number of the mechanism is the sum of.
    pub fn containing(self, contents: impl FnOnce() -> String) {
        if let (Operand::Number(x), false) = (self.value, self.builder.silent) {
            let mut graph = self.builder.graph.borrow_mut();
            graph.set_constant_contents(x, contents());
        }
    }

    /// Returns its value as a checked pivot of `joint`; see [`super::Node::Pivot`].
    pub fn pivot(self, magnitude: Self, joint: usize) -> Self {
        let (value, magnitude) = (self.signed(), magnitude.signed());
        self.builder.make(|g| g.pivot(value, magnitude, joint))
    }

    /// Returns its square root.
    pub fn sqrt(self) -> Self {
        let value = self.signed();
        self.builder.make(|g| g.sqrt(value))
    }

    fn of(self, f: impl FnOnce(&mut Graph, Signed) -> Signed) -> Self {
        let value = self.signed();
        self.builder.make(|g| f(g, value))
    }

    fn of_two(self, b: Self, f: impl FnOnce(&mut Graph, Signed, Signed) -> Signed) -> Self {
        let (x, y) = (self.signed(), b.signed());
        self.builder.make(|g| f(g, x, y))
    }

    /// Returns e to its power.
    pub fn exp(self) -> Self {
        self.of(Graph::exp)
    }

    /// Returns its natural logarithm.
    pub fn ln(self) -> Self {
        self.of(Graph::ln)
    }

    /// Returns its hyperbolic tangent.
    pub fn tanh(self) -> Self {
        self.of(Graph::tanh)
    }

    /// Returns its absolute value.
    pub fn abs(self) -> Self {
        self.of(Graph::abs)
    }

    /// Returns its sign: −1, 0 or 1.
    pub fn sign(self) -> Self {
        self.of(Graph::sign)
    }

    /// Returns the smaller value.
    pub fn min(self, b: Self) -> Self {
        self.of_two(b, Graph::min)
    }

    /// Returns the larger value.
    pub fn max(self, b: Self) -> Self {
        self.of_two(b, Graph::max)
    }

    /// Returns `yes` where it is less than `bound`, else `no`.
    pub fn if_less(self, bound: Self, yes: Self, no: Self) -> Self {
        if let (Some(x), Some(y)) = (self.as_constant(), bound.as_constant()) {
            return if x < y { yes } else { no };
        }
        let (x, y, yes, no) = (self.signed(), bound.signed(), yes.signed(), no.signed());
        self.builder.make(|g| {
            let condition = g.less(x, y);
            g.select(condition, yes, no)
        })
    }

    /// Returns k times it.
    fn times(self, k: Dd) -> Self {
        match self.value {
            Operand::Number(x) => self.number(k * x),
            Operand::Node(_) if k == Dd::ZERO => self.number(k),
            Operand::Node(_) if k == Dd::ONE => self,
            Operand::Node(x) => self.builder.make(|g| g.times(k, x)),
        }
    }

    /// Returns it plus k.
    fn and(self, k: Dd) -> Self {
        match self.value {
            Operand::Number(x) => self.number(cancelling_sum(x, k)),
            Operand::Node(_) if k == Dd::ZERO => self,
            Operand::Node(x) => self.builder.make(|g| g.add_constant(x, k)),
        }
    }
}

impl PartialEq for Expr<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl std::fmt::Debug for Expr<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.value {
            Operand::Number(x) => x.fmt(f),
            Operand::Node(expr) => expr.fmt(f),
        }
    }
}

impl Add for Expr<'_> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        match (self.value, b.value) {
            (_, Operand::Number(k)) => self.and(k),
            (Operand::Number(k), _) => b.and(k),
            (Operand::Node(x), Operand::Node(y)) => self.builder.make(|g| g.add(x, y)),
        }
    }
}

impl Sub for Expr<'_> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl Mul for Expr<'_> {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        match (self.value, b.value) {
            (_, Operand::Number(k)) => self.times(k),
            (Operand::Number(k), _) => b.times(k),
            (Operand::Node(x), Operand::Node(y)) => self.builder.make(|g| g.mul(x, y)),
        }
    }
}

impl Div for Expr<'_> {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        match b.value {
            Operand::Number(k) if k != Dd::ZERO => self.times(Dd::ONE / k),
            _ => {
                let (x, y) = (self.signed(), b.signed());
                self.builder.make(|g| g.div(x, y))
            }
        }
    }
}

impl Neg for Expr<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        let value = match self.value {
            Operand::Number(x) => Operand::Number(-x),
            Operand::Node(expr) => Operand::Node(expr.flipped(true)),
        };
        Expr { value, ..self }
    }
}

impl Mul<Dd> for Expr<'_> {
    type Output = Self;
    fn mul(self, k: Dd) -> Self {
        self.times(k)
    }
}

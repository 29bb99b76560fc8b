//! Operators on expressions, so that a formulation reads like its equations.

use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use bgdyn_runtime::Dd;

use super::{Expr, Graph, Leaf};
use crate::math::Vec3;

/// A graph under construction.
#[derive(Default)]
pub struct Builder {
    graph: RefCell<Graph>,
}

impl From<Graph> for Builder {
    /// A graph open for more.
    fn from(graph: Graph) -> Self {
        Builder {
            graph: RefCell::new(graph),
        }
    }
}

/// An expression of a graph under construction.
#[derive(Clone, Copy)]
pub struct Ex<'g> {
    builder: &'g Builder,
    /// The expression.
    pub expr: Expr,
}

impl Builder {
    /// An empty graph.
    pub fn new() -> Self {
        Self::default()
    }

    /// The graph made.
    pub fn into_graph(self) -> Graph {
        self.graph.into_inner()
    }

    fn make(&self, f: impl FnOnce(&mut Graph) -> Expr) -> Ex<'_> {
        Ex {
            builder: self,
            expr: f(&mut self.graph.borrow_mut()),
        }
    }

    /// An expression made in this graph.
    pub fn ex(&self, expr: Expr) -> Ex<'_> {
        Ex {
            builder: self,
            expr,
        }
    }

    /// A pass over the graph under construction.
    pub fn with_graph<R>(&self, f: impl FnOnce(&mut Graph) -> R) -> R {
        f(&mut self.graph.borrow_mut())
    }

    /// What is made from now on belongs under this title, for readers of the output.
    pub fn section(&self, title: impl Into<String>) {
        self.graph.borrow_mut().begin_section(title.into());
    }

    /// A number.
    pub fn constant(&self, x: Dd) -> Ex<'_> {
        self.make(|g| g.constant(x))
    }

    /// Zero.
    pub fn zero(&self) -> Ex<'_> {
        self.constant(Dd::ZERO)
    }

    /// A small number such as 1, 2 or ½.
    pub fn number(&self, x: f64) -> Ex<'_> {
        self.constant(Dd::from_f64(x))
    }

    /// A vector of numbers.
    pub fn vector(&self, v: Vec3<Dd>) -> Vec3<Ex<'_>> {
        v.map(|x| self.constant(x))
    }

    /// An argument.
    pub fn leaf(&self, leaf: Leaf) -> Ex<'_> {
        self.make(|g| g.leaf(leaf))
    }

    /// Cosine and sine of the exact sum of angles and a constant.
    pub fn cos_sin(&self, angles: &[Ex<'_>], offset: Dd) -> (Ex<'_>, Ex<'_>) {
        let terms: Vec<Expr> = angles.iter().map(|a| a.expr).collect();
        let angle = self.graph.borrow_mut().angle(&terms, offset);
        (self.make(|g| g.cos(angle)), self.make(|g| g.sin(angle)))
    }
}

impl<'g> Ex<'g> {
    /// Its value, if it is a constant.
    pub fn as_constant(self) -> Option<Dd> {
        self.builder.graph.borrow().constant_of(self.expr)
    }

    /// Whether it is the constant 0.
    pub fn is_zero(self) -> bool {
        self.as_constant() == Some(Dd::ZERO)
    }

    /// Names its node for readers of the output.
    pub fn named(self, name: impl FnOnce() -> String) -> Self {
        self.builder
            .graph
            .borrow_mut()
            .set_name(self.expr.node, name);
        self
    }

    /// Its value as a checked pivot of `joint`; see [`super::Node::Pivot`].
    pub fn pivot(self, magnitude: Self, joint: usize) -> Self {
        self.builder
            .make(|g| g.pivot(self.expr, magnitude.expr, joint))
    }

    /// Its square root.
    pub fn sqrt(self) -> Self {
        self.builder.make(|g| g.sqrt(self.expr))
    }
}

impl PartialEq for Ex<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.expr == other.expr
    }
}

impl std::fmt::Debug for Ex<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.expr.fmt(f)
    }
}

impl Add for Ex<'_> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        self.builder.make(|g| g.add(self.expr, b.expr))
    }
}

impl Sub for Ex<'_> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl Mul for Ex<'_> {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        self.builder.make(|g| g.mul(self.expr, b.expr))
    }
}

impl Div for Ex<'_> {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        self.builder.make(|g| g.div(self.expr, b.expr))
    }
}

impl Neg for Ex<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        Ex {
            expr: self.expr.flipped(true),
            ..self
        }
    }
}

impl Mul<Dd> for Ex<'_> {
    type Output = Self;
    fn mul(self, k: Dd) -> Self {
        self.builder.make(|g| {
            let k = g.constant(k);
            g.mul(self.expr, k)
        })
    }
}

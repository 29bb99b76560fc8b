//! Expands an expression graph into polynomials, node by node, within a limit of terms.

use bgdyn_runtime::Dd;

use super::NoClosedForm;
use super::polynomial::{Angle, Polynomial, Symbol, combined};
use crate::expr::{Graph, Leaf, Node, NodeId, Signed, reachable};

/// The symbols of the leaves of a graph.
pub(super) struct Leaves {
    /// For each coordinate the group of parallel axes of its angle, or its kind of displacement.
    pub positions: Vec<CoordinateForm>,
    /// For each run-time parameter.
    pub parameters: Vec<Polynomial>,
}

/// The form of a coordinate in a polynomial.
#[derive(Clone, Copy)]
pub(super) enum CoordinateForm {
    /// An angle of this group.
    Angle(usize),
    /// The displacement of a joint.
    Displacement(usize),
    /// A length: a displacement that is constant.
    Length(usize),
}

/// Limits of an expansion.
pub(super) struct Budget {
    /// Largest number of terms of one sum.
    pub terms: usize,
    /// Largest number of products of two terms, in total.
    pub products: usize,
    /// Number of products so far.
    pub spent: usize,
}

/// Expands the outputs into polynomials.
pub(super) fn expand(
    graph: &Graph,
    outputs: &[Signed],
    leaves: &Leaves,
    budget: Budget,
) -> Result<Vec<Polynomial>, NoClosedForm> {
    let needed = reachable(graph, outputs);
    let mut expansion = Expansion {
        graph,
        leaves,
        budget,
        made: vec![None; graph.len()],
    };
    for i in (0..graph.len()).filter(|&i| needed[i]) {
        let id = NodeId::at(i);
        // An angle is no polynomial; only its sine and cosine are.
        if !expansion.is_angle(id) {
            let polynomial = expansion.step(id)?;
            expansion.made[i] = Some(polynomial);
        }
    }
    outputs.iter().map(|&e| expansion.signed(e)).collect()
}

struct Expansion<'a> {
    graph: &'a Graph,
    leaves: &'a Leaves,
    budget: Budget,
    made: Vec<Option<Polynomial>>,
}

impl Expansion<'_> {
    fn is_angle(&self, id: NodeId) -> bool {
        match *self.graph.node(id) {
            Node::Angle(..) => true,
            Node::Leaf(Leaf::Position(j)) => {
                matches!(self.leaves.positions[j], CoordinateForm::Angle(_))
            }
            _ => false,
        }
    }

    fn at(&self, id: NodeId) -> Result<&Polynomial, NoClosedForm> {
        self.made[id.index()]
            .as_ref()
            .ok_or(NoClosedForm::NotTrigonometric)
    }

    fn signed(&self, e: Signed) -> Result<Polynomial, NoClosedForm> {
        Ok(Polynomial::default().plus(self.at(e.node)?, e.negative))
    }

    fn step(&mut self, id: NodeId) -> Result<Polynomial, NoClosedForm> {
        let made = match self.graph.node(id) {
            Node::Constant(c) => Polynomial::number(c.value()),
            Node::Leaf(leaf) => self.leaf(*leaf)?,
            Node::Add(a, b) => self.at(*a)?.plus(self.at(b.node)?, b.negative),
            Node::Mul(a, b) => self.product(*a, *b)?,
            Node::MulAdd(a, b, negative, c) => {
                let product = Polynomial::default().plus(&self.product(*a, *b)?, *negative);
                product.plus(self.at(c.node)?, c.negative)
            }
            Node::Sin(angle) => self.wave(*angle, true)?,
            Node::Cos(angle) => self.wave(*angle, false)?,
            _ => return Err(NoClosedForm::NotTrigonometric),
        };
        if made.len() > self.budget.terms {
            return Err(NoClosedForm::LongSum { terms: made.len() });
        }
        Ok(made)
    }

    fn leaf(&self, leaf: Leaf) -> Result<Polynomial, NoClosedForm> {
        Ok(match leaf {
            Leaf::Position(j) => match self.leaves.positions[j] {
                CoordinateForm::Angle(_) => return Err(NoClosedForm::NotTrigonometric),
                CoordinateForm::Displacement(j) => Polynomial::symbol(Symbol::Position(j)),
                CoordinateForm::Length(letter) => Polynomial::symbol(Symbol::Letter(letter)),
            },
            Leaf::Velocity(j) => self.moving(j, Symbol::Velocity(j)),
            Leaf::Acceleration(j) => self.moving(j, Symbol::Acceleration(j)),
            Leaf::Parameter(p) => self.leaves.parameters[p].clone(),
            _ => return Err(NoClosedForm::NotTrigonometric),
        })
    }

    /// Returns a rate; zero for lengths.
    fn moving(&self, j: usize, symbol: Symbol) -> Polynomial {
        match self.leaves.positions[j] {
            CoordinateForm::Length(_) => Polynomial::default(),
            _ => Polynomial::symbol(symbol),
        }
    }

    fn product(&mut self, a: NodeId, b: NodeId) -> Result<Polynomial, NoClosedForm> {
        let products = self.at(a)?.len() * self.at(b)?.len();
        self.budget.spent = self.budget.spent.saturating_add(products);
        if self.budget.spent > self.budget.products {
            let products = self.budget.spent;
            return Err(NoClosedForm::ManyProducts { products });
        }
        Ok(self.at(a)?.times(self.at(b)?))
    }

    /// Returns the sine or cosine of a coordinate, or of a sum of coordinates and a constant.
    fn wave(&self, of: NodeId, sine: bool) -> Result<Polynomial, NoClosedForm> {
        let (terms, offset) = match self.graph.node(of) {
            Node::Leaf(Leaf::Position(_)) => (vec![(of, 1)], Dd::ZERO),
            Node::Angle(terms, offset, negative) => {
                let sign = |e: &Signed| if e.negative { -1 } else { 1 };
                let terms = terms.iter().map(|e| (e.node, sign(e))).collect();
                let offset = offset.value();
                (terms, if *negative { -offset } else { offset })
            }
            _ => return Err(NoClosedForm::NotTrigonometric),
        };
        let mut angles: std::collections::BTreeMap<usize, Angle> = Default::default();
        for (node, n) in terms {
            let Node::Leaf(Leaf::Position(j)) = *self.graph.node(node) else {
                return Err(NoClosedForm::NotTrigonometric);
            };
            let CoordinateForm::Angle(group) = self.leaves.positions[j] else {
                return Err(NoClosedForm::NotTrigonometric);
            };
            let angle = angles.entry(group).or_default();
            *angle = combined(angle, &[(j, 1)], n);
        }
        let (sin, cos) = offset.sin_cos();
        let mut so_far = (Polynomial::number(sin), Polynomial::number(cos));
        for (group, angle) in angles {
            if angle.is_empty() {
                continue;
            }
            let (s, c) = (
                Polynomial::wave(group, true, &angle),
                Polynomial::wave(group, false, &angle),
            );
            so_far = (
                so_far.0.times(&c).plus(&so_far.1.times(&s), false),
                so_far.1.times(&c).plus(&so_far.0.times(&s), true),
            );
        }
        Ok(if sine { so_far.0 } else { so_far.1 })
    }
}

//! Operands and operations in C.

use bgdyn_runtime::ACTUATORS;

use super::block::BlockText;
use crate::column_loop::SHARED;
use crate::expr::{Leaf, Node, NodeId, Signed};
use crate::plan::block_name;

use super::words::field;

/// How tightly a piece of C binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Tightness {
    Sum,
    Product,
    Whole,
}

impl BlockText<'_> {
    /// Returns a signed operand, in parentheses if its context binds tighter.
    pub(super) fn operand(&self, e: Signed, context: Tightness) -> String {
        let (text, tightness) = self.code(e.node);
        match (e.negative, tightness) {
            (true, Tightness::Whole) if context == Tightness::Sum => format!("-{text}"),
            (true, Tightness::Whole) => format!("(-{text})"),
            (true, _) if context == Tightness::Sum => format!("-({text})"),
            (true, _) => format!("(-({text}))"),
            (false, tightness) if tightness < context => format!("({text})"),
            (false, _) => text,
        }
    }

    /// Returns a value that is assigned.
    pub(super) fn value(&self, e: Signed) -> String {
        self.operand(e, Tightness::Sum)
    }

    fn code(&self, id: NodeId) -> (String, Tightness) {
        if let Some(name) = self.listing.name(id) {
            return (name.to_string(), Tightness::Whole);
        }
        match self.listing.block.graph.node(id) {
            Node::Constant(c) => (self.style.number(c.value().to_f64()), Tightness::Whole),
            Node::Leaf(leaf) => (self.leaf(*leaf), Tightness::Whole),
            node => self.operation(node),
        }
    }

    /// Returns a leaf without a variable.
    fn leaf(&self, leaf: Leaf) -> String {
        match (leaf, &self.arrays) {
            (Leaf::Parameter(p), _) => {
                format!("parameters->{}", field(self.naming.parameters[p]))
            }
            (Leaf::BlockResult { block, index }, Some(arrays)) => match block {
                SHARED => format!("{}[{index}]", arrays.shared),
                _ => format!("{}[{index}][c]", arrays.own),
            },
            (Leaf::BlockResult { block, index }, None) => {
                format!("{}[{index}]", block_name(block))
            }
            _ => unreachable!("an argument of a mechanism that is read has a variable"),
        }
    }

    /// Returns an operation, without a name for its value.
    pub(super) fn operation(&self, node: &Node) -> (String, Tightness) {
        let plus = Signed::plus;
        let sum = |e: Signed| self.operand(e, Tightness::Sum);
        let product = |e: Signed| self.operand(e, Tightness::Product);
        let whole = |e: Signed| self.operand(e, Tightness::Whole);
        let library = |name: &str, a: Signed| {
            let name = self.style.of_library(name);
            (format!("{name}({})", sum(a)), Tightness::Whole)
        };
        let own = |name: &str, operands: &[Signed]| {
            let operands: Vec<String> = operands.iter().map(|&e| sum(e)).collect();
            let name = self.style.global(name);
            (format!("{name}({})", operands.join(", ")), Tightness::Whole)
        };
        match node {
            Node::Add(a, b) => {
                let sign = if b.negative { '-' } else { '+' };
                let (left, right) = (sum(plus(*a)), product(plus(b.node)));
                (format!("{left} {sign} {right}"), Tightness::Sum)
            }
            Node::Mul(a, b) => {
                let (left, right) = (product(plus(*a)), whole(plus(*b)));
                (format!("{left} * {right}"), Tightness::Product)
            }
            Node::Div(a, b) => {
                let (left, right) = (product(plus(*a)), whole(plus(*b)));
                (format!("{left} / {right}"), Tightness::Product)
            }
            Node::MulAdd(a, b, negative, c) => {
                own("mul_add", &[plus(*a).flipped(*negative), plus(*b), *c])
            }
            Node::Sqrt(a) => library("sqrt", *a),
            Node::Exp(a) => library("exp", *a),
            Node::Ln(a) => library("log", *a),
            Node::Tanh(a) => library("tanh", plus(*a)),
            Node::Abs(a) => library("fabs", plus(*a)),
            Node::Sign(a) => own("sign", &[plus(*a)]),
            Node::Min(a, b) => own("smaller", &[*a, *b]),
            Node::Max(a, b) => own("larger", &[*a, *b]),
            Node::Less(a, b) => (format!("{} < {}", sum(*a), sum(*b)), Tightness::Sum),
            Node::Select(condition, a, b) => {
                let condition = whole(plus(*condition));
                let text = format!("({condition} ? {} : {})", sum(*a), sum(*b));
                (text, Tightness::Whole)
            }
            Node::Pivot(value, magnitude, joint) => {
                let name = self.style.global("checked_pivot");
                let by = if self.separate { "" } else { "&" };
                let (value, magnitude) = (sum(*value), sum(*magnitude));
                // Kinds of causes begin at multiples of this number; C has the index among the names.
                let cause = joint % ACTUATORS + 1;
                let text = format!("{name}({value}, {magnitude}, {cause}, {by}refused)");
                (text, Tightness::Whole)
            }
            Node::Constant(_) | Node::Leaf(_) | Node::Angle(..) | Node::Sin(_) | Node::Cos(_) => {
                unreachable!("numbers and leaves have their own code, sines have names")
            }
        }
    }
}

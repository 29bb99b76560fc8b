//! Rust's spelling of one operation.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::code::{Binding, Code, atom};
use super::tokens::ident;
use super::writer::Writer;
use crate::expr::{Node, Signed};

impl Writer<'_> {
    /// Returns the code of an operation, without a name for its value.
    pub(super) fn operation(&self, node: &Node) -> Code {
        let plus = Signed::plus;
        let sum = |e: Signed| self.operand(e, Binding::Sum);
        match node {
            Node::Add(a, b) => {
                let left = sum(plus(*a));
                let right = self.operand(plus(b.node), Binding::Product);
                let sign = if b.negative { quote!(-) } else { quote!(+) };
                Code {
                    tokens: quote! { #left #sign #right },
                    binding: Binding::Sum,
                }
            }
            Node::Mul(a, b) | Node::Div(a, b) => {
                let left = self.operand(plus(*a), Binding::Product);
                let right = self.operand(plus(*b), Binding::Atom);
                let sign = match node {
                    Node::Mul(..) => quote!(*),
                    _ => quote!(/),
                };
                Code {
                    tokens: quote! { #left #sign #right },
                    binding: Binding::Product,
                }
            }
            Node::MulAdd(a, b, negative, c) if self.spelling.plain => {
                self.infix(plus(*a), plus(*b), *negative, *c)
            }
            Node::MulAdd(a, b, negative, c) => {
                self.call("mul_add", &[plus(*a).flipped(*negative), plus(*b), *c])
            }
            Node::Sqrt(a) => self.call("sqrt", &[*a]),
            Node::Exp(a) => self.call("exp", &[*a]),
            Node::Ln(a) => self.call("ln", &[*a]),
            Node::Tanh(a) => self.call("tanh", &[plus(*a)]),
            Node::Abs(a) => self.call("abs", &[plus(*a)]),
            Node::Sign(a) => self.call("sign", &[plus(*a)]),
            Node::Min(a, b) => self.call("min", &[*a, *b]),
            Node::Max(a, b) => self.call("max", &[*a, *b]),
            Node::Less(a, b) => self.call("less", &[*a, *b]),
            Node::Select(condition, a, b) => self.call("select", &[plus(*condition), *a, *b]),
            Node::Pivot(value, magnitude, joint) => {
                let (value, magnitude) = (sum(*value), sum(*magnitude));
                let joint = Literal::usize_unsuffixed(*joint);
                let by = (!self.separate).then(|| quote! { &mut });
                atom(quote! { T::checked_pivot(#value, #magnitude, #joint, #by refused) })
            }
            Node::Constant(_) | Node::Leaf(_) | Node::Angle(..) | Node::Sin(_) | Node::Cos(_) => {
                unreachable!("numbers and leaves have their own code, sines have names")
            }
        }
    }

    /// Returns a b + c, or c − a b if `negative`, with infix operators.
    fn infix(&self, a: Signed, b: Signed, negative: bool, c: Signed) -> Code {
        let left = self.operand(a, Binding::Product);
        let right = self.operand(b, Binding::Atom);
        let tokens = if negative && !c.negative {
            let c = self.operand(c, Binding::Sum);
            quote! { #c - #left * #right }
        } else {
            let minus = negative.then(|| quote! { - });
            let sign = if c.negative { quote!(-) } else { quote!(+) };
            let c = self.operand(Signed::plus(c.node), Binding::Product);
            quote! { #minus #left * #right #sign #c }
        };
        Code {
            tokens,
            binding: Binding::Sum,
        }
    }

    fn call(&self, name: &str, operands: &[Signed]) -> Code {
        let (name, operands): (_, Vec<TokenStream>) = (ident(name), self.values(operands));
        atom(quote! { T::#name(#(#operands),*) })
    }
}

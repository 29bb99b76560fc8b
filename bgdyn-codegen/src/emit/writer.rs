//! The state of emitting one block (code of each node, names, statements), and the code of one operation.

use std::collections::BTreeSet;

use bgdyn_runtime::Dd;
use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::code::{Binding, Code, Naming, SinePair, atom};
use super::entries::{self, Entries};
use super::named_constants::{NamedConstants, unit_of_length};
use super::names::{Names, loop_names};
use super::tokens::{COMMENT, ident};
use crate::expr::{Graph, Leaf, Node, NodeId, QuickMap, Signed, reachable};
use crate::function::Function;
use crate::method::Shape;

/// Emits the statements of a function.
pub(super) struct Writer<'a> {
    pub(super) graph: &'a Graph,
    pub(super) naming: &'a Naming<'a>,
    pub(super) names: Names,
    /// Code for the users of a node: a variable's name, or the whole operation.
    pub(super) code: Vec<Option<Code>>,
    /// Variables of sine and cosine of a node.
    pub(super) sines: QuickMap<NodeId, SinePair>,
    /// Number of uses of a node in the block.
    pub(super) uses: Vec<usize>,
    pub(super) statements: Vec<TokenStream>,
    /// The section of the last statement.
    section: Option<&'a str>,
    pub(super) needed: Vec<bool>,
    /// Whether the statements of one section are between those of others; such a block has no titles.
    pub(super) mixed: bool,
    /// Whether the block is a function of its own.
    separate: bool,
    pub(super) constants: bool,
    /// The named numbers in use.
    pub(super) named_constants: NamedConstants,
    /// The unit of length of the last comment, m.
    pub(super) unit: Option<Dd>,
    pub(super) pivots: bool,
    /// The result, if it is written entry by entry.
    pub(super) entries: Option<Entries<'a>>,
}

impl<'a> Writer<'a> {
    pub(super) fn new(function: &'a Function, naming: &'a Naming<'a>, outputs: &[Signed]) -> Self {
        let graph = &function.graph;
        let mut names = Names::default();
        let reserved = ["q", "v", "a", "tau", "k", "refused", entries::NAME];
        let of_scenes = ["state", "input", "acceleration", "t"];
        let of_scenes = of_scenes.iter().filter(|_| naming.layout.is_some());
        let arguments = function.method.arguments().iter().map(|a| a.name());
        for reserved in reserved.iter().chain(of_scenes).copied().chain(arguments) {
            names.reserve(reserved);
        }
        (0..function.blocks.len()).for_each(|b| drop(names.named(&format!("p{b}"))));
        loop_names(function)
            .iter()
            .for_each(|name| names.reserve(name));
        let mut writer = Writer {
            graph,
            naming,
            names,
            code: vec![None; graph.len()],
            sines: QuickMap::default(),
            uses: vec![0; graph.len()],
            needed: reachable(graph, outputs),
            mixed: false,
            separate: function.blocks.len() > 1,
            statements: Vec::new(),
            section: None,
            constants: false,
            named_constants: NamedConstants::default(),
            unit: None,
            pivots: false,
            entries: None,
        };
        writer.count_uses(outputs, function.shape());
        writer
    }

    /// Counts the uses of each node in the code.
    fn count_uses(&mut self, outputs: &[Signed], shape: Shape) {
        // The entries off the diagonal of a symmetric matrix are written twice.
        let times = if shape == Shape::Symmetric { 2 } else { 1 };
        for e in outputs {
            self.uses[e.node.0 as usize] += times;
        }
        for i in (0..self.needed.len()).filter(|&i| self.needed[i]) {
            let node = self.graph.node(NodeId(i as u32));
            node.for_each_operand(|operand| self.uses[operand.0 as usize] += 1);
        }
    }

    /// Binds the components of the arguments that are read.
    pub(super) fn arguments(&mut self, function: &Function, read: &BTreeSet<Leaf>) -> TokenStream {
        let mut bindings = TokenStream::new();
        for &argument in function.method.arguments() {
            let components = self.naming.components(argument);
            if !components.iter().any(|(leaf, _)| read.contains(leaf)) {
                continue;
            }
            let name = ident(argument.name());
            let mut parts = Vec::new();
            for (leaf, wanted) in components {
                if !read.contains(&leaf) {
                    parts.push(quote! { _ });
                    continue;
                }
                let variable = self.names.named(&wanted);
                parts.push(quote! { #variable });
                if let Some(id) = self.graph.find(&Node::Leaf(leaf)) {
                    self.code[id.0 as usize] = Some(atom(quote! { #variable }));
                }
            }
            bindings.extend(quote! { let [[#(#parts),*]] = #name.data.0; });
        }
        bindings
    }

    /// Emits a `let` for the node.
    pub(super) fn bind(&mut self, id: NodeId, code: Code) -> Code {
        let variable = match self.graph.name(id) {
            Some(name) => self.names.named(&name.identifier()),
            None => self.names.numbered(),
        };
        let tokens = code.tokens;
        self.push(id, quote! { let #variable = #tokens; });
        atom(quote! { #variable })
    }

    /// Adds a statement that computes the node. At the beginning of a section, the title precedes it as a
    /// comment: a doc attribute until [`super::source_text`], because tokens cannot contain comments.
    pub(super) fn push(&mut self, id: NodeId, statement: TokenStream) {
        let section = self.graph.section(id);
        let begins = section.filter(|_| section != self.section);
        let title = begins.filter(|_| !self.mixed).map(|title| {
            let text = format!("{COMMENT} {title}");
            quote! { #[doc = #text] }
        });
        let unit = begins.and_then(|_| self.graph.unit_of_length(id));
        let unit = unit.filter(|unit| self.unit.is_some_and(|said| said != *unit));
        self.unit = unit.or(self.unit);
        let unit = unit.map(|unit| {
            let text = unit_of_length(unit, &BTreeSet::new());
            quote! { #[doc = #text] }
        });
        self.section = section.or(self.section);
        self.statements.push(quote! { #unit #title #statement });
    }

    /// Adds a statement that computes no node, so that no section begins with it.
    pub(super) fn push_untitled(&mut self, statement: TokenStream) {
        self.statements.push(statement);
    }

    /// Binds the function that makes constants.
    pub(super) fn use_constants(&mut self) {
        self.constants = true;
    }

    pub(super) fn leaf(&self, leaf: Leaf) -> Option<Code> {
        match leaf {
            Leaf::Parameter(p) => {
                let field = ident(self.naming.parameters[p]);
                Some(atom(quote! { self.#field }))
            }
            Leaf::BlockResult { block, index } => {
                let (name, index) = (
                    format_ident!("p{block}"),
                    proc_macro2::Literal::usize_unsuffixed(index),
                );
                Some(atom(quote! { #name[#index] }))
            }
            // Bound with the arguments, or a field of one.
            leaf => self.naming.field(leaf).map(atom),
        }
    }

    /// Emits an argument or a parameter that has no variable yet.
    pub(super) fn bind_leaf(&mut self, id: NodeId) {
        if let Node::Leaf(leaf) = *self.graph.node(id)
            && self.code[id.0 as usize].is_none()
        {
            self.code[id.0 as usize] = self.leaf(leaf);
        }
    }

    pub(super) fn operation(&mut self, node: &Node) -> Code {
        let plus = Signed::plus;
        match node {
            Node::Add(a, b) => {
                let left = self.operand(plus(*a), Binding::Sum);
                let right = self.operand(plus(b.node), Binding::Product);
                let operations = self.size(*a) + self.size(b.node) + 1;
                let tokens = if b.negative {
                    quote! { #left - #right }
                } else {
                    quote! { #left + #right }
                };
                Code {
                    tokens,
                    binding: Binding::Sum,
                    operations,
                }
            }
            Node::Mul(a, b) => {
                let left = self.operand(plus(*a), Binding::Product);
                let right = self.operand(plus(*b), Binding::Atom);
                let operations = self.size(*a) + self.size(*b) + 1;
                Code {
                    tokens: quote! { #left * #right },
                    binding: Binding::Product,
                    operations,
                }
            }
            Node::Div(a, b) => {
                let left = self.operand(plus(*a), Binding::Product);
                let right = self.operand(plus(*b), Binding::Atom);
                let operations = self.size(*a) + self.size(*b) + 1;
                Code {
                    tokens: quote! { #left / #right },
                    binding: Binding::Product,
                    operations,
                }
            }
            Node::MulAdd(a, b, negative, c) if self.naming.plain => {
                self.infix(plus(*a), plus(*b), *negative, *c)
            }
            Node::MulAdd(a, b, negative, c) => {
                let a = self.operand(plus(*a).flipped(*negative), Binding::Sum);
                let (b, c) = (
                    self.operand(plus(*b), Binding::Sum),
                    self.operand(*c, Binding::Sum),
                );
                atom(quote! { T::mul_add(#a, #b, #c) })
            }
            Node::Sqrt(a) => self.call("sqrt", &[*a]),
            Node::Exp(a) => self.call("exp", &[*a]),
            Node::Ln(a) => self.call("ln", &[*a]),
            Node::Tanh(a) => self.call("tanh", &[plus(*a)]),
            Node::Abs(a) => self.call("abs", &[plus(*a)]),
            Node::Sign(a) => self.call("sign", &[plus(*a)]),
            Node::Min(a, b) => self.call("min", &[*a, *b]),
            Node::Max(a, b) => self.call("max", &[*a, *b]),
            Node::Select(condition, a, b) => {
                let mask = self.operand(plus(*condition), Binding::Sum);
                let (a, b) = (
                    self.operand(*a, Binding::Sum),
                    self.operand(*b, Binding::Sum),
                );
                atom(quote! { T::select(#mask, #a, #b) })
            }
            Node::Pivot(value, magnitude, joint) => {
                self.pivots = true;
                let value = self.operand(*value, Binding::Sum);
                let magnitude = self.operand(*magnitude, Binding::Sum);
                let joint = proc_macro2::Literal::usize_unsuffixed(*joint);
                let by = (!self.separate).then(|| quote! { &mut });
                atom(quote! { T::checked_pivot(#value, #magnitude, #joint, #by refused) })
            }
            Node::Constant(_) | Node::Leaf(_) | Node::Less(..) => unreachable_node(),
            Node::Angle(..) | Node::Sin(_) | Node::Cos(_) => unreachable_node(),
        }
    }

    /// Returns a b + c, or c − a b if `negative`, with infix operators.
    fn infix(&mut self, a: Signed, b: Signed, negative: bool, c: Signed) -> Code {
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
            operations: 0,
        }
    }

    fn call(&mut self, name: &str, operands: &[Signed]) -> Code {
        let name = ident(name);
        let operands: Vec<_> = operands
            .iter()
            .map(|&e| self.operand(e, Binding::Sum))
            .collect();
        atom(quote! { T::#name(#(#operands),*) })
    }

    /// Returns the number of operations in the code of a node.
    fn size(&self, id: NodeId) -> usize {
        self.code[id.0 as usize]
            .as_ref()
            .map_or(0, |c| c.operations)
    }

    /// Returns the code of a signed operand, in parentheses if its context binds tighter.
    pub(super) fn operand(&mut self, e: Signed, place: Binding) -> TokenStream {
        let code = self.code[e.node.0 as usize]
            .clone()
            .unwrap_or_else(unreachable_node);
        let tokens = code.tokens;
        match (e.negative, code.binding) {
            (true, Binding::Atom) if place == Binding::Sum => quote! { -#tokens },
            (true, Binding::Atom) => quote! { (-#tokens) },
            (true, _) if place == Binding::Sum => quote! { -(#tokens) },
            (true, _) => quote! { (-(#tokens)) },
            (false, binding) if binding < place => quote! { (#tokens) },
            (false, _) => tokens,
        }
    }
}

/// Operands precede their users, so every operand has its code; and [`Writer::node`] handles nodes that
/// are no operations.
fn unreachable_node<R>() -> R {
    unreachable!("the graph is in topological order")
}

//! The statements of a block in C.

use super::style::Style;
use super::words::{RESERVED, in_comment};
use crate::expr::{Node, NodeId, Signed};
use crate::function::Function;
use crate::method::Argument;
use crate::plan::{
    AnglePair, ArgumentNames, BlockPlan, BlockStep, Comments, Listing, LoopArrays, Naming, Place,
};

/// A block, and how it is written.
pub(super) struct BlockText<'a> {
    pub(super) listing: Listing<'a>,
    pub(super) style: &'a Style,
    pub(super) naming: &'a Naming<'a>,
    /// Whether the block is a function of its own, so that `refused` is a pointer.
    pub(super) separate: bool,
    /// Statements after those that read the arguments.
    pub(super) others: &'a [String],
    /// The arrays that a column of a loop reads.
    pub(super) arrays: Option<LoopArrays>,
}

impl<'a> BlockText<'a> {
    pub(super) fn new(
        block: &'a BlockPlan<'a>,
        function: &Function,
        style: &'a Style,
        naming: &'a Naming<'a>,
    ) -> Self {
        BlockText::within(block, function, style, naming, &[])
    }

    /// Returns a block within code that has these names.
    pub(super) fn within(
        block: &'a BlockPlan<'a>,
        function: &Function,
        style: &'a Style,
        naming: &'a Naming<'a>,
        outer: &[&str],
    ) -> Self {
        let reserved: Vec<&str> = RESERVED.iter().chain(outer).copied().collect();
        BlockText {
            listing: Listing::new(block, function, naming, &reserved),
            style,
            naming,
            separate: false,
            others: &[],
            arrays: None,
        }
    }

    /// Returns the lines of the block, without a margin. Outputs with places are stored in `result`.
    pub(super) fn lines(&self) -> Vec<String> {
        let mut lines = Vec::new();
        let unit = self.listing.unit.iter();
        lines.extend(unit.map(|unit| format!("/* {} */", in_comment(unit))));
        for constant in &self.listing.constants {
            let (real, name) = (self.style.real(), &constant.identifier);
            let number = self.style.number(constant.value.to_f64());
            lines.push(format!("/* {} */", in_comment(&constant.about)));
            lines.push(format!("const {real} {name} = {number};"));
        }
        for argument in &self.listing.arguments {
            lines.extend(self.argument(argument));
        }
        lines.extend_from_slice(self.others);
        let mut sines = 0;
        for step in &self.listing.lines {
            lines.extend(comments(&step.comments));
            self.step(step.step, &mut sines, &mut lines);
        }
        if !self.listing.block.begins() {
            let outputs = 0..self.listing.block.outputs.len();
            outputs.for_each(|k| lines.extend(self.store(k)));
        }
        lines
    }

    /// Binds the components of an argument that are read, so that a result may be stored over them.
    fn argument(&self, argument: &ArgumentNames) -> Vec<String> {
        let (real, array) = (self.style.real(), argument.argument.name());
        let is_number = argument.argument == Argument::Time;
        let components = argument.components.iter().enumerate();
        let read = components.filter_map(|(k, (_, name))| Some((k, name.as_ref()?)));
        let value = |k: usize| match is_number {
            true => array.to_string(),
            false => format!("{array}[{k}]"),
        };
        read.map(|(k, name)| format!("const {real} {name} = {};", value(k)))
            .collect()
    }

    fn step(&self, step: &BlockStep, sines: &mut usize, lines: &mut Vec<String>) {
        let block = self.listing.block;
        match step {
            BlockStep::Constant(_) => {}
            BlockStep::Value(id) => {
                let node = block.graph.node(*id);
                let name = self.listing.name(*id).unwrap_or_default();
                let kind = match node {
                    Node::Less(..) => "int",
                    _ => self.style.real(),
                };
                let (value, _) = self.operation(node);
                lines.push(format!("const {kind} {name} = {value};"));
            }
            BlockStep::Sines(angles) => {
                for pair in angles {
                    *sines += 1;
                    self.sines(pair, *sines, lines);
                }
            }
            BlockStep::Begin(_) => {
                let outputs = block.outputs.iter().enumerate();
                let constants =
                    outputs.filter(|(_, e)| matches!(block.graph.node(e.node), Node::Constant(_)));
                constants.for_each(|(k, _)| lines.extend(self.store(k)));
            }
            BlockStep::Store(output) => lines.extend(self.store(*output)),
        }
    }

    /// Stores an output at its places.
    fn store(&self, output: usize) -> Vec<String> {
        let block = self.listing.block;
        let places = block.places.iter().flat_map(|places| &places[output]);
        let value = self.value(block.outputs[output]);
        let store = |place: &Place| match place {
            Place::Element(k) => format!("result[{k}] = {value};"),
            Place::Entry { .. } => unreachable!("results of C are flat"),
        };
        places.map(store).collect()
    }

    /// Computes sine and cosine of an angle; `number` tells its variables apart from those of other angles.
    fn sines(&self, pair: &AnglePair, number: usize, lines: &mut Vec<String>) {
        let real = self.style.real();
        let name = |id: Option<NodeId>, other: &str| match id.and_then(|id| self.listing.name(id)) {
            Some(name) => name.to_string(),
            None => format!("{other}{number}"),
        };
        let (sine, cosine) = (name(pair.sine, "sine"), name(pair.cosine, "cosine"));
        let (angle, tail) = match self.listing.block.graph.node(pair.angle) {
            Node::Angle(terms, offset, negative) => {
                let offset = match negative {
                    true => -offset.value(),
                    false => offset.value(),
                };
                let names = (format!("angle{number}"), format!("tail{number}"));
                let words = self.style.two_words(offset);
                self.sum(&names, terms, words, lines);
                names
            }
            _ => {
                let zero = self.style.number(0.0);
                (self.value(Signed::plus(pair.angle)), zero)
            }
        };
        let function = self.style.global("sin_cos");
        lines.push(format!("{real} {sine};"));
        lines.push(format!("{real} {cosine};"));
        lines.push(format!("{function}({angle}, {tail}, &{sine}, &{cosine});"));
    }

    /// Sums angles and a constant of two words, with the rounding errors.
    fn sum(
        &self,
        (angle, tail): &(String, String),
        terms: &[Signed],
        offset: [f64; 2],
        lines: &mut Vec<String>,
    ) {
        let (real, function) = (self.style.real(), self.style.global("add_angle"));
        let [high, low] = offset.map(|x| self.style.number(x));
        let mut terms = terms.iter();
        let first = match offset == [0.0, 0.0] {
            true => terms.next().map(|&e| self.value(e)),
            false => None,
        };
        let first = first.unwrap_or(high);
        lines.push(format!("{real} {angle} = {first};"));
        lines.push(format!("{real} {tail} = {low};"));
        for &term in terms {
            let term = self.value(term);
            lines.push(format!("{function}(&{angle}, &{tail}, {term});"));
        }
    }
}

fn comments(comments: &Comments) -> Vec<String> {
    let heading = comments.heading.map(str::to_string);
    let all = [heading, comments.unit.clone(), comments.title.clone()];
    let texts = all.into_iter().flatten();
    texts
        .map(|text| format!("/* {} */", in_comment(&text)))
        .collect()
}

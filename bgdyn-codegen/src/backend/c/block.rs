//! The statements of a block in C.

use super::result::{ResultField, element};
use super::style::Style;
use super::words::{RESERVED, in_comment};
use crate::expr::Node;
use crate::function::Function;
use crate::method::Argument;
use crate::plan::{
    ArgumentNames, BlockPlan, BlockStep, Comments, Destination, Listing, LoopArrays, Naming,
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
    /// The fields of the result, if it is a struct.
    pub(super) fields: &'a [ResultField],
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
            fields: &[],
            arrays: None,
        }
    }

    /// Returns the lines of the block, without a margin. Outputs with destinations are stored in `result`.
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
            BlockStep::Sines(angles) => self.sines(angles, sines, lines),
            BlockStep::Begin(_) => {
                let outputs = block.outputs.iter().enumerate();
                let constants =
                    outputs.filter(|(_, e)| matches!(block.graph.node(e.node), Node::Constant(_)));
                constants.for_each(|(k, _)| lines.extend(self.store(k)));
            }
            BlockStep::Store(output) => lines.extend(self.store(*output)),
        }
    }

    /// Stores an output at its destinations.
    fn store(&self, output: usize) -> Vec<String> {
        let block = self.listing.block;
        let destinations = block
            .destinations
            .iter()
            .flat_map(|destinations| &destinations[output]);
        let value = self.value(block.outputs[output]);
        let store = |destination: &Destination| match destination {
            Destination::Element(k) => format!("{} = {value};", element(self.fields, *k)),
            Destination::Entry { .. } => unreachable!("results of C are flat"),
        };
        destinations.map(store).collect()
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

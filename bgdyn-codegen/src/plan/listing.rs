//! A block for readers: names of its values, and titles and comments before its statements.

use std::collections::BTreeSet;

use bgdyn_runtime::Dd;

use super::block::{BlockPlan, BlockStep};
use super::named_constants::{ConstantNames, NamedConstant, unit_of_length};
use super::names::{Names, outer_names};
use super::naming::{ArgumentNames, Naming};
use super::sines::AnglePair;
use crate::expr::{Leaf, Node, NodeId};
use crate::function::Function;
use crate::legend::LegendQuantity;

/// Comments before a statement, in this order.
#[derive(Clone, Debug, Default)]
pub struct Comments {
    /// A title for all that follows.
    pub heading: Option<&'static str>,
    /// The unit of length, where it changes.
    pub unit: Option<String>,
    /// The title of a section that begins.
    pub title: Option<String>,
}

/// A step with the comments before it.
#[derive(Debug)]
pub struct ListedStep<'a> {
    /// The comments.
    pub comments: Comments,
    /// The step.
    pub step: &'a BlockStep,
}

/// A block with the names of its values.
#[derive(Debug)]
pub struct Listing<'a> {
    /// The block.
    pub block: &'a BlockPlan<'a>,
    /// The arguments that are read and have no named parts.
    pub arguments: Vec<ArgumentNames>,
    /// The named numbers in use.
    pub constants: Vec<NamedConstant>,
    /// The unit of length, if the block begins with another one than the metre.
    pub unit: Option<String>,
    /// The steps with comments.
    pub lines: Vec<ListedStep<'a>>,
    /// The name of each node that has a variable or is a named number.
    names: Vec<Option<String>>,
}

impl<'a> Listing<'a> {
    /// Returns a block with names for its values. `reserved` are the names that the language's own code uses.
    pub fn new(
        block: &'a BlockPlan<'a>,
        function: &Function,
        naming: &Naming<'_>,
        reserved: &[&str],
    ) -> Self {
        let mut namer = ValueNamer {
            block,
            naming,
            used: Names::default(),
            names: vec![None; block.graph.len()],
            constants: ConstantNames::default(),
            section: None,
            unit: None,
        };
        reserved.iter().for_each(|name| namer.used.reserve(*name));
        let outer = outer_names(function);
        outer.into_iter().for_each(|name| namer.used.reserve(name));
        let arguments = namer.arguments(function);
        let unit = namer.first_unit();
        let mut lines: Vec<ListedStep<'a>> =
            block.steps.iter().map(|step| namer.line(step)).collect();
        if let Some(first) = lines.first_mut().filter(|_| block.mixed) {
            let heading = "in an order that keeps few values at a time: the steps are mixed";
            first.comments.heading = Some(heading);
        }
        Listing {
            block,
            arguments,
            constants: namer.constants.items(namer.unit),
            unit,
            lines,
            names: namer.names,
        }
    }

    /// Returns the name of a value or number; `None` for a value that is inline, an unnamed number, and what is read
    /// from arguments with named parts, parameters and blocks.
    pub fn name(&self, id: NodeId) -> Option<&str> {
        self.names[id.index()].as_deref()
    }

    /// Returns all names in the listing, for code that is within that of the block.
    pub fn all_names(&self) -> impl Iterator<Item = &str> {
        let constants = self.constants.iter().map(|c| c.identifier.as_str());
        constants.chain(self.names.iter().flatten().map(String::as_str))
    }
}

/// The state of naming a block.
struct ValueNamer<'a, 'n> {
    block: &'a BlockPlan<'a>,
    naming: &'n Naming<'n>,
    used: Names,
    names: Vec<Option<String>>,
    constants: ConstantNames,
    /// The section of the last statement.
    section: Option<&'a str>,
    /// The unit of length of the last comment, m.
    unit: Option<Dd>,
}

impl<'a> ValueNamer<'a, '_> {
    /// Names the components of the arguments that are read.
    fn arguments(&mut self, function: &Function) -> Vec<ArgumentNames> {
        let mut arguments = Vec::new();
        for &argument in function.method.arguments() {
            let components = self.naming.components(argument);
            let is_read = |leaf: &Leaf| self.block.reads.contains(leaf);
            if !components.iter().any(|(leaf, _)| is_read(leaf)) {
                continue;
            }
            let mut name = |(leaf, wanted): (Leaf, String)| {
                let name = is_read(&leaf).then(|| self.used.named(&wanted));
                if let Some(id) = self.block.graph.find(&Node::Leaf(leaf)) {
                    self.names[id.index()].clone_from(&name);
                }
                (leaf, name)
            };
            let components = components.into_iter().map(&mut name).collect();
            arguments.push(ArgumentNames {
                argument,
                components,
            });
        }
        arguments
    }

    fn line(&mut self, step: &'a BlockStep) -> ListedStep<'a> {
        let comments = match step {
            BlockStep::Constant(id) => {
                self.name_constant(*id);
                Comments::default()
            }
            BlockStep::Value(id) => {
                self.names[id.index()] = Some(self.value_name(*id));
                self.comments(*id)
            }
            BlockStep::Sines(angles) => {
                angles.iter().for_each(|pair| self.name_pair(pair));
                self.comments(angles[0].angle)
            }
            BlockStep::Begin(_) | BlockStep::Store(_) => Comments::default(),
        };
        ListedStep { comments, step }
    }

    fn name_constant(&mut self, id: NodeId) {
        if let Node::Constant(c) = self.block.graph.node(id)
            && let Some(name) = self.block.graph.constant_name(c.value())
        {
            let identifier = self.constants.add(&mut self.used, name, c.value());
            self.names[id.index()] = Some(identifier);
        }
    }

    fn value_name(&mut self, id: NodeId) -> String {
        let name = self.block.graph.name(id);
        let is_mask = matches!(self.block.graph.node(id), Node::Less(..));
        match name.filter(|_| !is_mask) {
            Some(name) => self.used.named(&name.identifier()),
            None => self.used.numbered(),
        }
    }

    /// Names sine and cosine of an angle, whether both are read or not.
    fn name_pair(&mut self, pair: &AnglePair) {
        let name = self.angle_name(pair.angle);
        for (function, node) in [("sin", pair.sine), ("cos", pair.cosine)] {
            let name = self.used.named(&format!("{function}_{name}"));
            if let Some(id) = node {
                self.names[id.index()] = Some(name);
            }
        }
    }

    /// Returns the names of the joints whose angles are summed: `shoulder_elbow`.
    fn angle_name(&self, angle: NodeId) -> String {
        let joint = |id: NodeId| match self.block.graph.node(id) {
            Node::Leaf(Leaf::Position(j)) => self.naming.positions[*j],
            Node::Leaf(Leaf::Parameter(p)) => self.naming.parameters[*p],
            _ => "angle",
        };
        match self.block.graph.node(angle) {
            Node::Angle(terms, ..) => {
                let joints: Vec<&str> = terms.iter().map(|t| joint(t.node)).collect();
                joints.join("_")
            }
            _ => joint(angle).to_string(),
        }
    }

    /// Returns the comments before a statement that computes the node: the title, if a section begins, and the unit
    /// of length, if it changes.
    fn comments(&mut self, id: NodeId) -> Comments {
        let graph = self.block.graph;
        let section = graph.section(id);
        let begins = section.filter(|_| section != self.section);
        let title = begins.filter(|_| !self.block.mixed);
        let unit = begins.and_then(|_| graph.unit_of_length(id));
        let unit = unit.filter(|unit| self.unit.is_some_and(|said| said != *unit));
        self.unit = unit.or(self.unit);
        self.section = section.or(self.section);
        Comments {
            heading: None,
            unit: unit.map(|unit| unit_of_length(unit, &BTreeSet::new())),
            title: title.map(str::to_string),
        }
    }

    /// Returns a comment on the unit of length at the beginning of the block, if it is not the metre.
    fn first_unit(&mut self) -> Option<String> {
        let graph = self.block.graph;
        let is_computed =
            |id: &NodeId| !matches!(graph.node(*id), Node::Leaf(_) | Node::Constant(_));
        let nodes = || self.block.nodes().filter(is_computed);
        let unit = nodes().find_map(|id| graph.unit_of_length(id))?;
        let names = nodes().filter_map(|id| graph.name(id));
        let quantities = names.filter_map(|name| LegendQuantity::of_name(&name.text));
        let patterns = quantities.map(|(quantity, _)| quantity.pattern()).collect();
        self.unit = Some(unit);
        (unit != Dd::ONE).then(|| unit_of_length(unit, &patterns))
    }
}

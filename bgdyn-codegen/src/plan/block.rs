//! The steps of a block, in the order in which they are computed.

use std::collections::BTreeSet;

use super::destinations::Destination;
use super::inline::{inline, uses};
use super::limits::PlanLimits;
use super::order::order;
use super::reads::leaves;
use super::sines::{AngleGroups, AnglePair};
use crate::expr::{Graph, Leaf, Node, NodeId, QuickMap, Signed, reachable};

/// A step of a block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BlockStep {
    /// A number is needed from here on.
    Constant(NodeId),
    /// Computes a value, with the operations that are inline in it.
    Value(NodeId),
    /// Computes sines and cosines of several angles together.
    Sines(Vec<AnglePair>),
    /// The first output that is no constant is known: from here on outputs are stored. Constants are stored here.
    Begin(NodeId),
    /// An output is known: it is stored at its destinations.
    Store(usize),
}

/// A block in the order in which it is computed.
#[derive(Debug)]
pub struct BlockPlan<'a> {
    /// The expressions.
    pub graph: &'a Graph,
    /// The results of the block, in order.
    pub outputs: Vec<Signed>,
    /// Destinations of each output in the result, if outputs are stored as soon as they are known.
    pub destinations: Option<Vec<Vec<Destination>>>,
    /// The steps.
    pub steps: Vec<BlockStep>,
    /// Whether the steps of one section are between those of others, so that titles would mislead.
    pub mixed: bool,
    /// The nodes that are computed or read.
    pub needed: Vec<bool>,
    /// How often each node is read. An output off the diagonal of a symmetric matrix counts as two.
    pub uses: Vec<u32>,
    /// The operations that belong to the step of their only reader.
    pub inline: Vec<bool>,
    /// Arguments, parameters, and results of earlier blocks that are read.
    pub reads: BTreeSet<Leaf>,
    /// Whether a pivot can be refused.
    pub refuses: bool,
}

impl<'a> BlockPlan<'a> {
    /// Plans a block with these outputs. `destinations` are the destinations of the outputs if they may be stored as
    /// soon as they are known; an output is read `reads_per_output` times.
    pub(super) fn new(
        graph: &'a Graph,
        outputs: Vec<Signed>,
        destinations: Option<Vec<Vec<Destination>>>,
        reads_per_output: u32,
        limits: &PlanLimits,
    ) -> Self {
        let needed = reachable(graph, &outputs);
        let uses = uses(graph, &needed, &outputs, reads_per_output);
        let count =
            |destinations: &Vec<Vec<Destination>>| destinations.iter().map(Vec::len).sum::<usize>();
        let destinations =
            destinations.filter(|destinations| count(destinations) >= limits.store_from);
        let mixed = order(graph, &needed, &outputs, destinations.is_some());
        let is_pivot = |i: usize| needed[i] && matches!(graph.node(NodeId::at(i)), Node::Pivot(..));
        let mut block = BlockPlan {
            graph,
            steps: Vec::new(),
            mixed: mixed.is_some(),
            inline: inline(graph, &needed, &uses),
            reads: leaves(graph, &outputs),
            refuses: (0..needed.len()).any(is_pivot),
            outputs,
            destinations,
            needed,
            uses,
        };
        let in_graph_order = || block.nodes().collect();
        let order = mixed.unwrap_or_else(in_graph_order);
        block.plan_steps(&order, limits);
        block
    }

    /// Returns the needed nodes in the order of the graph.
    pub fn nodes(&self) -> impl Iterator<Item = NodeId> {
        let needed = (0..self.needed.len()).filter(|&i| self.needed[i]);
        needed.map(NodeId::at)
    }

    /// Returns the earlier blocks whose results are read.
    pub fn blocks_read(&self) -> BTreeSet<usize> {
        let block = |leaf: &Leaf| match leaf {
            Leaf::BlockResult { block, .. } => Some(*block),
            _ => None,
        };
        self.reads.iter().filter_map(block).collect()
    }

    /// Returns whether any output is stored as soon as it is known; if not, all outputs are constants, or are
    /// returned at the end.
    pub fn begins(&self) -> bool {
        self.steps
            .iter()
            .any(|step| matches!(step, BlockStep::Begin(_)))
    }

    fn plan_steps(&mut self, order: &[NodeId], limits: &PlanLimits) {
        let needed = self.needed.clone();
        let mut angles = AngleGroups::new(self.graph, &needed);
        let mut outputs_of: QuickMap<NodeId, Vec<usize>> = QuickMap::default();
        if self.destinations.is_some() {
            for (k, output) in self.outputs.iter().enumerate() {
                outputs_of.entry(output.node).or_default().push(k);
            }
        }
        let mut begun = false;
        for &id in order {
            let step = match self.graph.node(id) {
                Node::Leaf(_) | Node::Angle(..) => None,
                Node::Constant(_) => Some(BlockStep::Constant(id)),
                Node::Sin(a) | Node::Cos(a) => angles.group(*a, limits).map(BlockStep::Sines),
                _ => (!self.inline[id.index()]).then_some(BlockStep::Value(id)),
            };
            self.steps.extend(step);
            if let Some(outputs) = outputs_of.get(&id)
                && !matches!(self.graph.node(id), Node::Constant(_))
            {
                if !begun {
                    self.begin(id);
                }
                begun = true;
                self.steps
                    .extend(outputs.iter().map(|&k| BlockStep::Store(k)));
            }
        }
    }

    /// Begins to store outputs: the first one becomes a value of its own, constants are needed now.
    fn begin(&mut self, first: NodeId) {
        if std::mem::replace(&mut self.inline[first.index()], false) {
            self.steps.push(BlockStep::Value(first));
        }
        let constant = |e: &Signed| match self.graph.node(e.node) {
            Node::Constant(_) => Some(BlockStep::Constant(e.node)),
            _ => None,
        };
        self.steps.extend(self.outputs.iter().filter_map(constant));
        self.steps.push(BlockStep::Begin(first));
    }
}

//! Columns of a result that are the same expressions of different values: one loop computes them.
//!
//! Forward dynamics is linear in the efforts, so each column of its derivatives is the same chain of
//! operations, M⁻¹ dτ, for another dτ. Written out, the columns of an arm are the longest part of its code
//! and outgrow the instruction cache. As a loop they run in the lanes of a register.
//!
//! What all columns read, and what each column reads of its own, are results of the straight-line code
//! before the loop, the stage. Factoring and cutting see the stage alone. The count is that of the columns
//! written out; where a loop would take one operation more, they stay written out.

use bgdyn_runtime::Scalar;

use crate::expr::{Graph, Inputs, Leaf, Node, NodeId, QuickMap, Signed, evaluate, reachable};

/// The block of [`Leaf::Passed`] that stands for values that all columns share.
pub(crate) const SHARED: usize = 0;
/// The block of [`Leaf::Passed`] that stands for values of a column.
pub(crate) const OWN: usize = 1;

/// Columns that one loop computes.
#[derive(Clone, Debug)]
pub struct ColumnLoop {
    /// The expressions of one column, over [`Leaf::Passed`]: of block 0 what all columns read, of
    /// block 1 what a column has of its own.
    pub graph: Graph,
    /// The results of a column.
    pub outputs: Vec<Signed>,
    /// Where in the stage's results stands what all columns read.
    pub shared: Vec<usize>,
    /// Where stands what each column has of its own: a list for each column.
    pub own: Vec<Vec<usize>>,
}

impl ColumnLoop {
    /// The results of every column from the stage's.
    fn evaluate<T: Scalar>(&self, stage: &[T], refused: &mut T::Refused) -> Vec<Vec<T>> {
        let at = |places: &[usize]| places.iter().map(|&k| stage[k]).collect::<Vec<T>>();
        let column = |own: &Vec<usize>| {
            let inputs = Inputs::of_blocks(vec![at(&self.shared), at(own)]);
            evaluate(&self.graph, &self.outputs, &inputs, refused)
        };
        self.own.iter().map(column).collect()
    }
}

/// Where a result of a function with loops comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResultSource {
    /// A result of the stage.
    Stage(usize),
    /// A result of a loop.
    Column {
        /// Which loop.
        group: usize,
        /// Which of its columns.
        column: usize,
        /// Which result of the column.
        row: usize,
    },
}

/// The loops of a function, and how its result is put together.
#[derive(Clone, Debug)]
pub struct LoopedResult {
    /// The loops.
    pub groups: Vec<ColumnLoop>,
    /// The function's results in the order of its shape.
    pub parts: Vec<ResultSource>,
}

impl LoopedResult {
    /// The function's results from those of the stage.
    pub(crate) fn evaluate<T: Scalar>(&self, stage: &[T], refused: &mut T::Refused) -> Vec<T> {
        let groups = self.groups.iter();
        let found: Vec<Vec<Vec<T>>> = groups.map(|g| g.evaluate(stage, refused)).collect();
        let value = |part: &ResultSource| match *part {
            ResultSource::Stage(k) => stage[k],
            ResultSource::Column { group, column, row } => found[group][column][row],
        };
        self.parts.iter().map(value).collect()
    }
}

/// One column's expressions in a graph of their own, and what it reads of the graph that it was made
/// in, as [`SHARED`] values in this order. Its own values are [`OWN`] leaves there already.
pub(crate) fn column(from: &Graph, outputs: &[Signed]) -> (Graph, Vec<Signed>, Vec<Signed>) {
    let own = of_column(from, outputs);
    let mut to = Graph::default();
    let mut shared: Vec<Signed> = Vec::new();
    let mut copies: QuickMap<NodeId, Signed> = QuickMap::default();
    let mut at = |to: &mut Graph, copies: &mut QuickMap<NodeId, Signed>, id: NodeId| -> Signed {
        if let Some(&copy) = copies.get(&id) {
            return copy;
        }
        let copy = match from.node(id) {
            Node::Constant(c) => to.constant(c.value()),
            _ => {
                let index = shared.len();
                shared.push(Signed::plus(id));
                let block = SHARED;
                to.leaf(Leaf::Passed { block, index })
            }
        };
        copies.insert(id, copy);
        copy
    };
    for i in (0..from.len()).filter(|&i| own[i]) {
        let id = NodeId(i as u32);
        let node = from.node(id);
        node.for_each_operand(|operand| {
            at(&mut to, &mut copies, operand);
        });
        let copy = to.rebuilt(node, |e: Signed| copies[&e.node].flipped(e.negative));
        copies.insert(id, copy);
    }
    let outputs = outputs.iter();
    let outputs = outputs.map(|e| at(&mut to, &mut copies, e.node).flipped(e.negative));
    let outputs = outputs.collect();
    (to, outputs, shared)
}

/// The nodes that depend on what a column has of its own.
fn of_column(graph: &Graph, outputs: &[Signed]) -> Vec<bool> {
    let needed = reachable(graph, outputs);
    let mut own = vec![false; graph.len()];
    for i in (0..graph.len()).filter(|&i| needed[i]) {
        let node = graph.node(NodeId(i as u32));
        let mut found = matches!(node, Node::Leaf(Leaf::Passed { block: OWN, .. }));
        node.for_each_operand(|operand| found |= own[operand.place()]);
        own[i] = found;
    }
    own
}

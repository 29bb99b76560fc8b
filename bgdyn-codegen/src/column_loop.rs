//! Columns of a result that are the same expressions of different values, computed by one loop.
//!
//! Forward dynamics is linear in the efforts, so each column of its derivatives is the same sequence of
//! operations, M⁻¹ dτ, for a different dτ. Without a loop, the columns of an arm are the longest part of
//! its code and exceed the instruction cache. In a loop they run in the lanes of a register.
//!
//! The values that all columns read, and the values that each column reads, are results of the
//! straight-line code before the loop, the stage. Factoring and cutting process only the stage. The
//! operation count is that of the unrolled columns; if a loop would need one operation more, the columns
//! stay unrolled.

use bgdyn_runtime::Scalar;

use crate::expr::{Graph, Inputs, Leaf, Node, NodeId, QuickMap, Signed, evaluate, reachable};

/// The block of [`Leaf::BlockResult`] for values that all columns share.
pub(crate) const SHARED: usize = 0;
/// The block of [`Leaf::BlockResult`] for values of one column.
pub(crate) const OWN: usize = 1;

/// Columns that one loop computes.
#[derive(Clone, Debug)]
pub struct ColumnLoop {
    /// The expressions of one column, over [`Leaf::BlockResult`]: block 0 is what all columns read, block 1 the
    /// values of the column.
    pub graph: Graph,
    /// The results of a column.
    pub outputs: Vec<Signed>,
    /// Indices in the stage's results of the values that all columns read.
    pub shared: Vec<usize>,
    /// Indices of the values of each column: one list per column.
    pub own: Vec<Vec<usize>>,
}

impl ColumnLoop {
    /// Computes the results of every column from the stage's results.
    fn evaluate<T: Scalar>(&self, stage: &[T], refused: &mut T::Refused) -> Vec<Vec<T>> {
        let at = |places: &[usize]| places.iter().map(|&k| stage[k]).collect::<Vec<T>>();
        let column = |own: &Vec<usize>| {
            let inputs = Inputs::of_blocks(vec![at(&self.shared), at(own)]);
            evaluate(&self.graph, &self.outputs, &inputs, refused)
        };
        self.own.iter().map(column).collect()
    }
}

/// The source of a result of a function with loops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResultSource {
    /// A result of the stage.
    Stage(usize),
    /// A result of a loop.
    Column {
        /// Index of the loop.
        group: usize,
        /// Index of the column in the loop.
        column: usize,
        /// Index of the result in the column.
        row: usize,
    },
}

/// The loops of a function, and the composition of its result.
#[derive(Clone, Debug)]
pub struct LoopedResult {
    /// The loops.
    pub groups: Vec<ColumnLoop>,
    /// The function's results in the order of its shape.
    pub parts: Vec<ResultSource>,
}

impl LoopedResult {
    /// Computes the function's results from those of the stage.
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

/// Copies one column's expressions into a graph of their own. Also returns the values that it reads from
/// the original graph, as [`SHARED`] values in this order. The values of the column are [`OWN`] leaves
/// already.
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
                to.leaf(Leaf::BlockResult { block, index })
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

/// Marks the nodes that depend on the values of a column.
fn of_column(graph: &Graph, outputs: &[Signed]) -> Vec<bool> {
    let needed = reachable(graph, outputs);
    let mut own = vec![false; graph.len()];
    for i in (0..graph.len()).filter(|&i| needed[i]) {
        let node = graph.node(NodeId(i as u32));
        let mut found = matches!(node, Node::Leaf(Leaf::BlockResult { block: OWN, .. }));
        node.for_each_operand(|operand| found |= own[operand.index()]);
        own[i] = found;
    }
    own
}

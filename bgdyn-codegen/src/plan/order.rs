//! The order in which the operations of a block are written: that of the graph, or one that keeps fewer values.
//!
//! A value that waits for its last reader occupies a register, or is stored and loaded again. Compilers keep
//! roughly the order of the statements in long code, and stored values cost twice: by their instructions, and by
//! code that no longer fits in the instruction cache (`docs/order.md`).

use super::inline::{inline, uses};
use crate::expr::{Graph, Node, NodeId, Signed};

/// Mean number of waiting values from which another order is looked for: in code with fewer, little is stored.
const MANY: f64 = 40.0;
/// Another order is taken if its mean number of waiting values is at most this part of the original one.
const FEWER: f64 = 0.75;
/// The same for blocks with pivots. They wait for divisions, which the new order also puts between other operations.
const FEWER_WITH_PIVOTS: f64 = 0.95;

/// Returns the needed nodes in an order that keeps clearly fewer values than that of the graph; `None` if none is
/// found. If `stored`, outputs are written to memory as soon as they are known, and need not wait for the end.
pub(super) fn order(
    graph: &Graph,
    needed: &[bool],
    outputs: &[Signed],
    stored: bool,
) -> Option<Vec<NodeId>> {
    let block = StatementBlock::new(graph, needed, outputs, stored);
    let limit = block.mean_waiting(&block.operations);
    if limit < MANY {
        return None;
    }
    let mut candidates = vec![block.newest_first()];
    if block.pivots == 0 {
        candidates.push(block.depth_first());
    }
    let with_means = candidates.into_iter().map(|c| (block.mean_waiting(&c), c));
    let (mean, best) = with_means.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let part = if block.pivots == 0 {
        FEWER
    } else {
        FEWER_WITH_PIVOTS
    };
    (mean <= part * limit).then(|| {
        let statement = |i: &usize| {
            block.parts[*i]
                .iter()
                .copied()
                .chain([*i])
                .collect::<Vec<_>>()
        };
        let late = best.iter().flat_map(statement);
        let all = block.early.iter().copied().chain(late);
        all.map(NodeId::at).collect()
    })
}

/// Operations of a block, and who reads whom among them. An operation with one reader is part of the reader's
/// statement.
struct StatementBlock<'a> {
    outputs: &'a [Signed],
    /// Nodes that are written first: arguments, constants, and sines of arguments.
    early: Vec<usize>,
    /// The other nodes that are statements, in the order of the graph.
    operations: Vec<usize>,
    /// Operations that are written in each statement before it is complete.
    parts: Vec<Vec<usize>>,
    /// Statements whose values each statement reads, each once.
    operands: Vec<Vec<usize>>,
    readers: Vec<Vec<usize>>,
    /// The pivot before each pivot: the first one that is refused is reported, so that their order is kept.
    pivot_before: Vec<Option<usize>>,
    pivots: usize,
    /// Whether a value waits for the end of the block.
    waits_for_end: Vec<bool>,
}

impl<'a> StatementBlock<'a> {
    fn new(graph: &Graph, needed: &[bool], outputs: &'a [Signed], stored: bool) -> Self {
        let mut block = StatementBlock {
            outputs,
            early: Vec::new(),
            operations: Vec::new(),
            parts: vec![Vec::new(); graph.len()],
            operands: vec![Vec::new(); graph.len()],
            readers: vec![Vec::new(); graph.len()],
            pivot_before: vec![None; graph.len()],
            pivots: 0,
            waits_for_end: vec![false; graph.len()],
        };
        // An output is read a second time, by the result: it is a statement.
        let is_part = inline(graph, needed, &uses(graph, needed, outputs, 2));
        let (mut is_early, mut last_pivot) = (vec![false; graph.len()], None);
        for i in (0..needed.len()).filter(|&i| needed[i]) {
            let node = graph.node(NodeId::at(i));
            let (mut late, mut parts) = (Vec::new(), Vec::new());
            node.for_each_operand(|o| match o.index() {
                o if is_early[o] => {}
                o if is_part[o] => {
                    late.extend(&block.operands[o]);
                    parts.extend(block.parts[o].iter().chain([&o]));
                }
                o => late.push(o),
            });
            late.sort_unstable();
            late.dedup();
            if late.is_empty() && parts.is_empty() && is_argument(node) {
                is_early[i] = true;
                block.early.push(i);
                continue;
            }
            (block.operands[i], block.parts[i]) = (late, parts);
            if is_part[i] {
                continue;
            }
            if let Node::Pivot(..) = node {
                block.pivot_before[i] = last_pivot.replace(i);
                block.pivots += 1;
            }
            let operands = block.operands[i].iter();
            operands.for_each(|&o| block.readers[o].push(i));
            block.operations.push(i);
        }
        for e in outputs.iter().filter(|_| !stored) {
            block.waits_for_end[e.node.index()] = true;
        }
        block
    }

    /// Returns the number of readers that each value waits for; the end of the block is one.
    fn waits(&self) -> Vec<usize> {
        let readers = self.readers.iter().zip(&self.waits_for_end);
        readers
            .map(|(readers, &end)| readers.len() + usize::from(end))
            .collect()
    }

    /// Returns how many values wait for a reader, on average over the operations in this order.
    fn mean_waiting(&self, order: &[usize]) -> f64 {
        let mut waits = self.waits();
        let (mut waiting, mut sum) = (0_usize, 0);
        for &i in order {
            for &o in &self.operands[i] {
                waits[o] -= 1;
                waiting -= usize::from(waits[o] == 0);
            }
            waiting += usize::from(waits[i] > 0);
            sum += waiting;
        }
        sum as f64 / order.len().max(1) as f64
    }

    /// Of the operations whose operands are known, the next is always one that leaves the fewest values waiting;
    /// among equals, one that reads the newest value.
    fn newest_first(&self) -> Vec<usize> {
        let mut waits = self.waits();
        let missing =
            |&i: &usize| self.operands[i].len() + usize::from(self.pivot_before[i].is_some());
        let mut missing: Vec<usize> = (0..waits.len()).map(|i| missing(&i)).collect();
        let mut next_pivot = vec![None; waits.len()];
        for &i in &self.operations {
            if let Some(before) = self.pivot_before[i] {
                next_pivot[before] = Some(i);
            }
        }
        let mut computed = vec![0; waits.len()];
        let is_known = |i: &usize| missing[*i] == 0;
        let mut ready: Vec<usize> = self.operations.iter().copied().filter(is_known).collect();
        let mut order = Vec::with_capacity(self.operations.len());
        let key = |i: usize, waits: &[usize], computed: &[usize]| {
            let operands = &self.operands[i];
            let freed = operands.iter().filter(|&&o| waits[o] == 1).count();
            let newest = operands.iter().map(|&o| computed[o]).max().unwrap_or(0);
            (
                freed + usize::from(waits[i] == 0),
                newest,
                std::cmp::Reverse(i),
            )
        };
        while let Some(slot) =
            (0..ready.len()).max_by_key(|&slot| key(ready[slot], &waits, &computed))
        {
            let i = ready.swap_remove(slot);
            order.push(i);
            computed[i] = order.len();
            self.operands[i].iter().for_each(|&o| waits[o] -= 1);
            for &next in self.readers[i].iter().chain(&next_pivot[i]) {
                missing[next] -= 1;
                if missing[next] == 0 {
                    ready.push(next);
                }
            }
        }
        order
    }

    /// What the last output needs, then what the last but one needs beside that, and so on: of a mass matrix, column
    /// after column from the tips.
    fn depth_first(&self) -> Vec<usize> {
        let mut is_done = vec![true; self.operands.len()];
        self.operations.iter().for_each(|&i| is_done[i] = false);
        let mut order = Vec::with_capacity(self.operations.len());
        for root in self.outputs.iter().rev() {
            let mut path = vec![(root.node.index(), 0)];
            while let Some((i, next)) = path.pop() {
                if is_done[i] {
                    continue;
                }
                match self.operands[i].get(next) {
                    Some(&operand) => path.extend([(i, next + 1), (operand, 0)]),
                    None => {
                        is_done[i] = true;
                        order.push(i);
                    }
                }
            }
        }
        order
    }
}

/// Returns whether a node without operands, or with arguments as operands, takes no operation.
fn is_argument(node: &Node) -> bool {
    matches!(
        node,
        Node::Leaf(_) | Node::Constant(_) | Node::Angle(..) | Node::Sin(_) | Node::Cos(_)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::{Leaf, reachable};

    /// Fails unless the order has each node once, behind its operands.
    fn check(graph: &Graph, needed: &[bool], order: &[NodeId]) {
        let mut written = vec![false; graph.len()];
        for &id in order {
            assert!(needed[id.index()] && !written[id.index()]);
            let operand = |o: NodeId| assert!(written[o.index()], "{o:?} before {id:?}");
            graph.node(id).for_each_operand(operand);
            written[id.index()] = true;
        }
        assert_eq!(written, needed);
    }

    /// Chains of square roots, written step by step for all of them together, and the sum of their ends.
    fn chains(count: usize, pivots: bool) -> (Graph, Vec<Signed>) {
        let mut g = Graph::default();
        let mut ends: Vec<Signed> = (0..count).map(|j| g.leaf(Leaf::Position(j))).collect();
        for _ in 0..6 {
            for (j, end) in ends.iter_mut().enumerate() {
                let (root, start) = (g.sqrt(*end), g.leaf(Leaf::Velocity(j)));
                let sum = g.mul_add(root, root, start);
                *end = if pivots { g.pivot(sum, start, j) } else { sum };
            }
        }
        let sum = ends.into_iter().reduce(|sum, end| g.add(sum, end));
        (g, sum.into_iter().collect())
    }

    #[test]
    fn chains_are_written_one_after_the_other() {
        let (g, outputs) = chains(60, false);
        let needed = reachable(&g, &outputs);
        let found =
            order(&g, &needed, &outputs, false).expect("60 values wait; a statement reads seven");
        check(&g, &needed, &found);
        let block = StatementBlock::new(&g, &needed, &outputs, false);
        assert!(block.mean_waiting(&block.operations) > 50.0);
        assert!(block.mean_waiting(&block.newest_first()) < 8.0);
        assert_eq!(block.depth_first().len(), block.operations.len());
        let (g, outputs) = chains(20, false);
        assert_eq!(order(&g, &reachable(&g, &outputs), &outputs, false), None);
    }

    /// A product that only a sine reads belongs to the sine's statement: the sine is not written with the arguments.
    #[test]
    fn sines_of_products_follow_the_products() {
        let (mut g, mut outputs) = chains(60, false);
        let (rate, time) = (g.leaf(Leaf::Velocity(3)), g.leaf(Leaf::Time));
        let angle = g.mul(rate, time);
        let sine = g.sin(angle);
        outputs.push(sine);
        let needed = reachable(&g, &outputs);
        let found = order(&g, &needed, &outputs, false).expect("60 values wait");
        check(&g, &needed, &found);
    }

    /// The first refused pivot is reported, so that their order must not change.
    #[test]
    fn pivots_keep_their_order() {
        let (g, outputs) = chains(60, true);
        let needed = reachable(&g, &outputs);
        let block = StatementBlock::new(&g, &needed, &outputs, false);
        let found = block.newest_first();
        assert_eq!(found.len(), block.operations.len());
        let pivots = found
            .iter()
            .filter(|&&i| matches!(g.node(NodeId::at(i)), Node::Pivot(..)));
        assert!(pivots.is_sorted());
        if let Some(found) = order(&g, &needed, &outputs, false) {
            check(&g, &needed, &found);
        }
    }
}

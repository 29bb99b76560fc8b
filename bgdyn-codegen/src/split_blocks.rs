//! Divides a long function into blocks that pass values.
//!
//! Compilers need time and stack that grow faster than the length of straight-line code, so each block
//! becomes a function of its own. Sines stay with their cosines, and a comparison with its reader, so that
//! a division costs no operation. Entries of a matrix that are inner products of two tables form the last
//! block, whose code is loops.

use crate::expr::{Graph, Leaf, Node, NodeId, QuickMap, Signed, reachable};
use crate::function::{Block, Function, InnerProducts, in_triangle};
use crate::inner_products::products;
use crate::method::Shape;

/// Largest number of operations in a block. Arms of seven axes are not divided.
const MAX_BLOCK: usize = 3200;
/// Largest number of operations in a function that is not divided: a short last block would cost more, by the values
/// that are passed to it, than the first one gains.
const MAX_WHOLE: usize = 3500;

/// Returns whether the function is divided: its straight-line code is clearly longer than one block.
pub fn is_cut(function: &Function) -> bool {
    function.straight().total() > MAX_WHOLE
}

/// Returns the function in blocks of bounded length.
pub fn cut(function: Function) -> Function {
    if !is_cut(&function) || function.blocks.len() != 1 {
        return function;
    }
    let outputs = &function.blocks[0].outputs;
    let products = match function.shape() {
        Shape::Symmetric => products(&function.graph, outputs),
        _ => Vec::new(),
    };
    let homes = homes(&function.graph, outputs, &products);
    let mut cutter = Cutter::new(&function.graph, homes, outputs);
    let mut blocks: Vec<Block> = (0..cutter.blocks()).map(|b| cutter.block(b)).collect();
    if let Some(last) = blocks.last_mut() {
        cutter.enter(products, last);
    }
    Function {
        graph: cutter.made,
        blocks,
        ..function
    }
}

/// Returns the block in which each node is computed; `None` for nodes whose code is at their users.
fn homes(graph: &Graph, outputs: &[Signed], products: &[InnerProducts]) -> Vec<Option<usize>> {
    let needed = reachable(graph, outputs);
    let in_loops = in_loops(graph, outputs, products);
    let mut homes = vec![None; graph.len()];
    let mut angles: QuickMap<NodeId, usize> = QuickMap::default();
    let mut done = 0;
    for i in (0..graph.len()).filter(|&i| needed[i] && !in_loops[i]) {
        homes[i] = match graph.node(NodeId(i as u32)) {
            Node::Constant(_) | Node::Leaf(_) | Node::Angle(..) | Node::Less(..) => None,
            Node::Sin(a) | Node::Cos(a) => Some(*angles.entry(*a).or_insert(done / MAX_BLOCK)),
            Node::MulAdd(..) => {
                done += 2;
                Some(done / MAX_BLOCK)
            }
            _ => {
                done += 1;
                Some(done / MAX_BLOCK)
            }
        };
    }
    for i in (0..graph.len()).filter(|&i| in_loops[i]) {
        homes[i] = Some(done / MAX_BLOCK + 1);
    }
    homes
}

/// Returns, for each node, whether it is a sum of products or part of such a sum.
fn in_loops(graph: &Graph, outputs: &[Signed], products: &[InnerProducts]) -> Vec<bool> {
    let mut found = vec![false; graph.len()];
    for (row, column) in products.iter().flat_map(InnerProducts::entries) {
        let mut sum = outputs[in_triangle(row, column)].node;
        found[sum.index()] = true;
        while let Node::MulAdd(_, _, _, rest) = graph.node(sum) {
            sum = rest.node;
            found[sum.index()] = true;
        }
    }
    found
}

struct Cutter<'a> {
    graph: &'a Graph,
    homes: Vec<Option<usize>>,
    /// The function's results, and the results of each block: nodes that later blocks read.
    results: &'a [Signed],
    passed: Vec<Vec<NodeId>>,
    /// The graph with blocks, and the node in it of each original node, block by block.
    made: Graph,
    titles: u32,
    copies: QuickMap<NodeId, Signed>,
}

impl<'a> Cutter<'a> {
    fn new(graph: &'a Graph, homes: Vec<Option<usize>>, results: &'a [Signed]) -> Self {
        let last = homes.iter().flatten().max().copied().unwrap_or(0);
        let mut cutter = Cutter {
            graph,
            homes,
            results,
            passed: vec![Vec::new(); last + 1],
            made: Graph::default(),
            titles: 0,
            copies: QuickMap::default(),
        };
        cutter.find_passed(last);
        cutter.titles = cutter.made.adopt_sections(graph);
        cutter
    }

    fn blocks(&self) -> usize {
        self.passed.len()
    }

    /// Collects every node that a later block, or the result, reads.
    fn find_passed(&mut self, last: usize) {
        let mut read_later = vec![false; self.graph.len()];
        let needed = reachable(self.graph, self.results);
        for i in (0..self.graph.len()).filter(|&i| needed[i]) {
            let Some(home) = self.homes[i] else { continue };
            self.for_each_read(NodeId(i as u32), &mut |operand| {
                if self.homes[operand.0 as usize].is_some_and(|h| h < home) {
                    read_later[operand.0 as usize] = true;
                }
            });
        }
        for e in self.results {
            if self.homes[e.node.0 as usize].is_some_and(|h| h < last) {
                read_later[e.node.0 as usize] = true;
            }
        }
        for i in (0..self.graph.len()).filter(|&i| read_later[i]) {
            if let Some(home) = self.homes[i] {
                self.passed[home].push(NodeId(i as u32));
            }
        }
    }

    /// Calls `f` with the operands; nodes without a block are replaced by their operands.
    fn for_each_read(&self, id: NodeId, f: &mut dyn FnMut(NodeId)) {
        self.graph
            .node(id)
            .for_each_operand(|operand| match self.homes[operand.0 as usize] {
                Some(_) => f(operand),
                None => self.for_each_read(operand, f),
            });
    }

    /// Copies a block; the last one's outputs are the function's.
    fn block(&mut self, b: usize) -> Block {
        self.copies.clear();
        for (block, passed) in self.passed.iter().enumerate().take(b) {
            for (index, &id) in passed.iter().enumerate() {
                let leaf = self.made.leaf(Leaf::BlockResult { block, index });
                self.copies.insert(id, leaf);
            }
        }
        let wanted: Vec<Signed> = if b + 1 == self.blocks() {
            self.results.to_vec()
        } else {
            self.passed[b].iter().map(|&id| Signed::plus(id)).collect()
        };
        for i in 0..self.graph.len() {
            if self.homes[i] == Some(b) {
                self.copy(NodeId(i as u32));
            }
        }
        Block {
            outputs: wanted.into_iter().map(|e| self.copy_signed(e)).collect(),
            products: Vec::new(),
        }
    }

    /// Adds inner products to the last block, each summed in the order of its vectors.
    fn enter(&mut self, products: Vec<InnerProducts>, block: &mut Block) {
        for mut found in products {
            for e in (found.rows.values_mut().chain(found.columns.values_mut())).flatten() {
                *e = self.copy_signed(*e);
            }
            for (row, column) in found.entries() {
                let mut terms = found.rows[&row].iter().zip(&found.columns[&column]);
                let first = terms.next().map(|(&x, &y)| self.made.mul(x, y));
                let add = |sum, (&x, &y): (&Signed, &Signed)| self.made.mul_add(x, y, sum);
                if let Some(first) = first {
                    block.outputs[in_triangle(row, column)] = terms.fold(first, add);
                }
            }
            block.products.push(found);
        }
    }

    fn copy_signed(&mut self, e: Signed) -> Signed {
        self.copy(e.node).flipped(e.negative)
    }

    fn copy(&mut self, id: NodeId) -> Signed {
        if let Some(&copy) = self.copies.get(&id) {
            return copy;
        }
        let node = self.graph.node(id).clone();
        let copied = node.map_operands(|e| self.copy_signed(e));
        self.made.reopen_section(self.graph, id, self.titles);
        let copy = Signed::plus(self.made.intern(copied));
        self.made.copy_name(copy, self.graph, id);
        self.copies.insert(id, copy);
        copy
    }
}

//! The type of a generated function, which can be counted, evaluated or emitted.

use std::collections::BTreeMap;
use std::ops::Range;

use bgdyn_runtime::{Dd, Scalar};

use crate::bond_graph::Multibody;
use crate::column_loop::{ColumnLoop, LoopedResult};
use crate::expr::{Cost, Graph, Inputs, Operations, Signed, cost, count, evaluate};
use crate::method::{Method, Shape};

/// A piece of straight-line code. Later blocks read its results as [`crate::expr::Leaf::BlockResult`].
#[derive(Clone, Debug)]
pub struct Block {
    /// Its results, in order.
    pub outputs: Vec<Signed>,
    /// The results that are computed in loops; each is one of `outputs` as well.
    pub products: Vec<InnerProducts>,
}

/// Entries of a symmetric matrix that are inner products of a vector of their row and one of their column:
/// M_ij = x₀ y₀ + x₁ y₁ + …, summed in this order. All vectors have the same length.
#[derive(Clone, Debug, Default)]
pub struct InnerProducts {
    /// Vectors by row.
    pub rows: BTreeMap<usize, Vec<Signed>>,
    /// Vectors by column.
    pub columns: BTreeMap<usize, Vec<Signed>>,
    /// The entries: columns, with rows below the diagonal.
    pub runs: Vec<(usize, Range<usize>)>,
}

impl InnerProducts {
    /// Returns row and column of each entry.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize)> {
        let runs = self.runs.iter().cloned();
        runs.flat_map(|(column, rows)| rows.map(move |row| (row, column)))
    }
}

/// Returns the index of an entry on or below the diagonal among those of the lower triangle, row by row.
pub fn in_triangle(row: usize, column: usize) -> usize {
    row * (row + 1) / 2 + column
}

/// An alternative for a function, with its cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Considered {
    /// A plan or a formulation in words.
    pub what: String,
    /// Its cost.
    pub cost: Cost,
}

/// A generated method: an expression graph, divided into blocks. The result is that of the last block, or
/// that of the loops over columns after it.
#[derive(Clone, Debug)]
pub struct Function {
    /// The method.
    pub method: Method,
    /// Its name in the generated code.
    pub name: String,
    /// Name of the formulation that was chosen, with its variant.
    pub formulation: String,
    /// The cheapest plans of its formulation, with their cost before factoring; the first one was chosen.
    /// Empty if there are no choices.
    pub plans: Vec<Considered>,
    /// Rejected alternatives that were created completely, with their cost at the comparison.
    pub rejected: Vec<Considered>,
    /// Whether its accuracy depends on the order of its operations; then it is not factored.
    pub ordered: bool,
    /// Expressions of all blocks.
    pub graph: Graph,
    /// The blocks in the order of execution; at least one.
    pub blocks: Vec<Block>,
    /// Loops over similar parts of the result, after the blocks.
    pub loops: Option<LoopedResult>,
}

impl Function {
    /// Returns a function of one block.
    pub fn flat(
        bond_graph: &Multibody,
        method: Method,
        formulation: String,
        graph: Graph,
        outputs: Vec<Signed>,
    ) -> Self {
        // One zero only: a result that is always zero has no sign.
        let unsigned = |e: Signed| match graph.constant_of(e) {
            Some(x) if x == Dd::ZERO => Signed::plus(e.node),
            _ => e,
        };
        let outputs = outputs.into_iter().map(unsigned).collect();
        Function {
            method,
            name: method.name(&bond_graph.sites),
            formulation,
            plans: Vec::new(),
            rejected: Vec::new(),
            ordered: false,
            graph,
            blocks: vec![Block {
                outputs,
                products: Vec::new(),
            }],
            loops: None,
        }
    }

    /// Marks the function as ordered: it is not factored.
    pub(crate) fn in_order(self) -> Self {
        Function {
            ordered: true,
            ..self
        }
    }

    /// Returns the loops over columns.
    pub(crate) fn columns(&self) -> &[ColumnLoop] {
        self.loops.as_ref().map_or(&[], |loops| &loops.groups)
    }

    /// Returns the number of its results.
    pub fn output_count(&self) -> usize {
        match &self.loops {
            Some(loops) => loops.parts.len(),
            None => self.blocks.last().map_or(0, |block| block.outputs.len()),
        }
    }

    /// Returns its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the shape of its result.
    pub fn shape(&self) -> Shape {
        self.method.shape()
    }

    /// Returns the number of operations of one call.
    pub fn operations(&self) -> Operations {
        let mut all = self.straight();
        for one in self.columns() {
            let column = count(&one.graph, &one.outputs);
            one.own.iter().for_each(|_| all += column);
        }
        all
    }

    /// Returns the number of operations of the blocks, without the loops after them.
    pub(crate) fn straight(&self) -> Operations {
        let mut all = Operations::default();
        for block in &self.blocks {
            all += count(&self.graph, &block.outputs);
        }
        all
    }

    /// Returns the cost of one call.
    pub fn cost(&self) -> Cost {
        let mut all = Cost::default();
        for block in &self.blocks {
            let c = cost(&self.graph, &block.outputs);
            all.operations += c.operations;
            all.angles += c.angles;
            all.fusable += c.fusable;
            all.depth += c.depth;
        }
        for one in self.columns() {
            let c = cost(&one.graph, &one.outputs);
            for _ in &one.own {
                all.operations += c.operations;
                all.fusable += c.fusable;
            }
            all.depth += c.depth;
        }
        all
    }

    /// Returns its value, without a compiler.
    ///
    /// # Panics
    /// If `inputs` lacks a component.
    pub fn evaluate<T: Scalar>(&self, mut inputs: Inputs<T>) -> (Vec<T>, T::Refused) {
        let mut refused = T::none_refused();
        let mut result = Vec::new();
        for block in &self.blocks {
            result = evaluate(&self.graph, &block.outputs, &inputs, &mut refused);
            inputs.passed.push(result.clone());
        }
        if let Some(loops) = &self.loops {
            result = loops.evaluate(&result, &mut refused);
        }
        (result, refused)
    }
}

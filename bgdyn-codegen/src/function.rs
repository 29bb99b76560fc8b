//! A function ready to be counted, evaluated or emitted.

use std::collections::BTreeMap;
use std::ops::Range;

use bgdyn_runtime::{Dd, Scalar};

use crate::bond_graph::Multibody;
use crate::column_loop::{ColumnLoop, LoopedResult};
use crate::expr::{Cost, Graph, Inputs, Operations, Signed, cost, count, evaluate};
use crate::method::{Method, Shape};

/// A straight line of code: what it computes. Later blocks read its results as
/// [`crate::expr::Leaf::Passed`].
#[derive(Clone, Debug)]
pub struct Block {
    /// Its results, in order.
    pub outputs: Vec<Signed>,
    /// Those of its results that are computed in loops; each is one of `outputs` as well.
    pub products: Vec<InnerProducts>,
}

/// Entries of a symmetric matrix that are inner products of a vector of their row and one of their
/// column: M_ij = x₀ y₀ + x₁ y₁ + …, summed in this order. All vectors are equally long.
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
    /// Row and column of each entry.
    pub fn places(&self) -> impl Iterator<Item = (usize, usize)> {
        let runs = self.runs.iter().cloned();
        runs.flat_map(|(column, rows)| rows.map(move |row| (row, column)))
    }
}

/// Where an entry on or below the diagonal stands among those of the lower triangle, row by row.
pub fn in_triangle(row: usize, column: usize) -> usize {
    row * (row + 1) / 2 + column
}

/// Something that was tried for a function, and what it costs.
#[derive(Clone, Debug, PartialEq)]
pub struct Considered {
    /// A plan or a formulation in words.
    pub what: String,
    /// What it costs.
    pub cost: Cost,
}

/// A generated method: an expression graph, cut into blocks. The last block gives the result, or what
/// loops over columns make it of.
#[derive(Clone, Debug)]
pub struct Function {
    /// Which method.
    pub method: Method,
    /// Its name in the generated code.
    pub name: String,
    /// Name of the formulation that was chosen, with its variant.
    pub formulation: String,
    /// The cheapest plans of its formulation, with their cost before factoring; the one taken is
    /// the first. None where there is nothing to choose.
    pub plans: Vec<Considered>,
    /// Other ways to it that were made in full, with their cost when they were compared.
    pub passed_over: Vec<Considered>,
    /// Whether the order of its operations is what it is made for: it is not factored.
    pub ordered: bool,
    /// Expressions of all blocks.
    pub graph: Graph,
    /// In the order of execution; at least one.
    pub blocks: Vec<Block>,
    /// What follows them: parts of the result that are alike.
    pub loops: Option<LoopedResult>,
}

impl Function {
    /// A function of one block.
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
            passed_over: Vec::new(),
            ordered: false,
            graph,
            blocks: vec![Block {
                outputs,
                products: Vec::new(),
            }],
            loops: None,
        }
    }

    /// The same function, not to be factored.
    pub(crate) fn in_order(self) -> Self {
        Function {
            ordered: true,
            ..self
        }
    }

    /// The loops over columns.
    pub(crate) fn columns(&self) -> &[ColumnLoop] {
        self.loops.as_ref().map_or(&[], |loops| &loops.groups)
    }

    /// One column of a loop as a function.
    pub(crate) fn of_column(&self, columns: &ColumnLoop) -> Function {
        Function {
            method: self.method,
            name: self.name.clone(),
            formulation: self.formulation.clone(),
            plans: Vec::new(),
            passed_over: Vec::new(),
            ordered: self.ordered,
            graph: columns.graph.clone(),
            blocks: vec![Block {
                outputs: columns.outputs.clone(),
                products: Vec::new(),
            }],
            loops: None,
        }
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its result's shape.
    pub fn shape(&self) -> Shape {
        self.method.shape()
    }

    /// Operations of one call.
    pub fn operations(&self) -> Operations {
        let mut all = self.straight();
        for one in self.columns() {
            let column = count(&one.graph, &one.outputs);
            one.own.iter().for_each(|_| all += column);
        }
        all
    }

    /// Operations of the blocks, without the loops that follow them.
    pub(crate) fn straight(&self) -> Operations {
        let mut all = Operations::default();
        for block in &self.blocks {
            all += count(&self.graph, &block.outputs);
        }
        all
    }

    /// What one call costs.
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

    /// Its value, without a compiler.
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

//! A function ready to be counted, evaluated or emitted.

use bgdyn_runtime::{Dd, Scalar};

use crate::bond_graph::BondGraph;
use crate::expr::{Expr, Graph, Inputs, Operations, count, evaluate, factored};
use crate::method::{Method, Shape};

/// A straight line of code: what it computes. Later blocks read its results as
/// [`crate::expr::Leaf::Passed`].
#[derive(Clone, Debug)]
pub struct Block {
    /// Its results, in order.
    pub outputs: Vec<Expr>,
}

/// A generated method: an expression graph, cut into blocks; the last block gives the result.
#[derive(Clone, Debug)]
pub struct Function {
    /// Which method.
    pub method: Method,
    /// Its name in the generated code.
    pub name: String,
    /// Name of the formulation that was chosen, with its variant.
    pub formulation: String,
    /// Whether the order of its operations is what it is made for: it is not factored.
    pub ordered: bool,
    /// Expressions of all blocks.
    pub graph: Graph,
    /// In the order of execution; at least one.
    pub blocks: Vec<Block>,
}

impl Function {
    /// A function of one block.
    pub fn flat(
        bond_graph: &BondGraph,
        method: Method,
        formulation: String,
        graph: Graph,
        outputs: Vec<Expr>,
    ) -> Self {
        // One zero only: a result that is always zero has no sign.
        let unsigned = |e: Expr| match graph.constant_of(e) {
            Some(x) if x == Dd::ZERO => Expr::plus(e.node),
            _ => e,
        };
        let outputs = outputs.into_iter().map(unsigned).collect();
        Function {
            method,
            name: method.name(&bond_graph.sites),
            formulation,
            ordered: false,
            graph,
            blocks: vec![Block { outputs }],
        }
    }

    /// The same function, not to be factored.
    pub(crate) fn in_order(self) -> Self {
        Function {
            ordered: true,
            ..self
        }
    }

    /// The same function with fewer operations, where factoring finds a way. A function that is cut
    /// into blocks stays as it is.
    pub(crate) fn factored(mut self) -> Self {
        if let ([Block { outputs }], false) = (&mut self.blocks[..], self.ordered) {
            let graph = std::mem::take(&mut self.graph);
            (self.graph, *outputs) = factored(graph, std::mem::take(outputs));
        }
        self
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
        let mut all = Operations::default();
        for block in &self.blocks {
            all += count(&self.graph, &block.outputs);
        }
        all
    }

    /// Its value, without a compiler: the expressions of the last block.
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
        (result, refused)
    }
}

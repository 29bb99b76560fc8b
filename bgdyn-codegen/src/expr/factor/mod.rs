//! Algebraic factoring: computes the same function with fewer operations.
//!
//! 1. [`network`] reads the graph as sums of products, Σ k·Π factors. Values with a single user are
//!    expanded, so that constants and equal terms of nested expressions are combined, and cancel. A sum with
//!    several users is expanded if the cancellation saves more than it costs.
//! 2. [`extract`] extracts common products and common two-term sums, the largest saving first (the
//!    two-cube divisors of Rajski and Vasudevamurthy 1992, used on polynomials by Hosangadi, Fallah and
//!    Kastner 2006). A last round expands every product again, so that the first choices do not block better
//!    ones.
//! 3. [`rebuild`] rebuilds the graph in the old order, with the old names and sections.
//! 4. In small functions, shared values are then expanded one by one if another round becomes cheaper.
//!
//! The result is the cheaper one of the functions before and after, so a count never increases. A sum is
//! multiplied by numbers only, never by another sum: no term grows, and rounding errors do not grow. A
//! pivot's magnitude remains a separate value, and so does a product with a quotient. Functions with a
//! fixed order of operations (`Function::ordered`: the literal sum, articulated bodies with own inertia)
//! are not factored. At the end `quotient.rs` divides directly if a reciprocal has a single user.

mod divisor;
mod divisors;
mod extract;
mod network;
mod rebuild;

use super::{Cost, Graph, Node, NodeId, Signed, cost, reachable};
use extract::Extraction;
use network::{Inline, Network};

/// Largest number of rounds; each one starts from the result of the previous one.
const ROUNDS: usize = 2;

/// Functions with more operations are not factored: the run time grows slightly faster than their number.
const LIMIT: usize = 8_000;

/// Largest number of operations for expanding products once more; beyond, this saves one in a thousand.
const MAX_INLINED_OPERATIONS: usize = 2_500;

/// Largest number of operations for expanding shared values one by one; each attempt is a round.
const MAX_POLISHED_OPERATIONS: usize = 100;

/// A function's graph and results, and their cost.
struct Best {
    graph: Graph,
    outputs: Vec<Signed>,
    cost: Cost,
}

impl Best {
    /// Runs a round in which `spread` is expanded, and uses its result if it is cheaper.
    fn improve(&mut self, spread: Inline) -> bool {
        let mut network = Network::new(&self.graph, &self.outputs, spread);
        Extraction::new(&mut network).run();
        let (graph, outputs) = rebuild::rebuild(&network, &self.outputs);
        let cost = cost(&graph, &outputs).unfinished();
        let better = cheaper(&cost, &self.cost);
        if better {
            *self = Best {
                graph,
                outputs,
                cost,
            };
        }
        better
    }

    /// Expands sums and products with few readers, one by one, until a whole pass changes nothing.
    fn polish(&mut self) {
        let mut readers = readers(&self.graph, &self.outputs);
        let (mut i, mut unchanged) = (0, 0);
        let mut tries = 4 * MAX_POLISHED_OPERATIONS;
        while unchanged < self.graph.len() && tries > 0 {
            let index = i % self.graph.len();
            (i, unchanged) = (i + 1, unchanged + 1);
            if (1..=3).contains(&readers[index]) {
                tries -= 1;
                if self.improve(Inline::One(NodeId(index as u32))) {
                    readers = self::readers(&self.graph, &self.outputs);
                    unchanged = 0;
                }
            }
        }
    }
}

/// Returns the number of readers of each sum and product.
fn readers(graph: &Graph, outputs: &[Signed]) -> Vec<usize> {
    let needed = reachable(graph, outputs);
    let ids = || (0..graph.len()).map(|i| NodeId(i as u32));
    let mut readers = vec![0; graph.len()];
    for id in ids().filter(|id| needed[id.0 as usize]) {
        graph.node(id).for_each_operand(|operand| {
            if matches!(graph.node(operand), Node::Add(..) | Node::Mul(..)) {
                readers[operand.0 as usize] += 1;
            }
        });
    }
    readers
}

/// Returns the same values with fewer operations, if the pass finds them.
pub fn factor(graph: Graph, outputs: Vec<Signed>) -> (Graph, Vec<Signed>) {
    let best = rounds(graph, outputs, ROUNDS);
    (best.graph, best.outputs)
}

/// Estimates the cost of the function that [`factor`] returns; for long functions, after a single round.
pub fn factored_cost(graph: Graph, outputs: Vec<Signed>) -> Cost {
    let best = rounds(graph, outputs, 1);
    cost(&best.graph, &best.outputs)
}

fn rounds(graph: Graph, outputs: Vec<Signed>, most: usize) -> Best {
    let cost = cost(&graph, &outputs).unfinished();
    let mut best = Best {
        graph,
        outputs,
        cost,
    };
    for _ in 0..most {
        if cost.operations.total() > LIMIT || !best.improve(Inline::Nothing) {
            break;
        }
    }
    // Products that were extracted first may block better ones.
    if most > 1 && cost.operations.total() <= MAX_INLINED_OPERATIONS {
        best.improve(Inline::Products);
    }
    if best.cost.operations.total() <= MAX_POLISHED_OPERATIONS {
        best.polish();
    }
    best
}

/// Returns whether `a` is cheaper, with no more operations of any kind.
fn cheaper(a: &Cost, b: &Cost) -> bool {
    let counts = |c: &Cost| {
        let o = &c.operations;
        [o.total(), o.div, o.sqrt, o.sincos, o.other]
    };
    let mut both = counts(a).into_iter().zip(counts(b));
    a.weighted() < b.weighted() && both.all(|(x, y)| x <= y)
}

//! Algebraic factoring: a function with fewer operations and the same value.
//!
//! The graph is read as sums of products, Σ k·Π factors ([`network`]): single uses are written
//! out, so that constants and equal terms meet across nesting, and cancel. Then common products
//! and common two-term sums are taken out, the one that saves most first ([`extract`]; the two-cube
//! divisors of Rajski and Vasudevamurthy 1992, used on polynomials by Hosangadi, Fallah and
//! Kastner 2006), and the graph is built again ([`rebuild`]). Whichever of before and after costs
//! less is kept.
//!
//! Only sums are regrouped; no product of sums is multiplied out but by a number, so that no term
//! is larger than one that was there before, and rounding errors keep their size.

mod extract;
mod network;
mod rebuild;

use super::{Expr, Graph, Node, NodeId, Operations, count};
use extract::Extraction;
use network::Network;

/// Rounds at the most; each one reads what the one before has made.
const ROUNDS: usize = 4;

/// Operations beyond which a function stays as it is: the pass takes time that grows a little
/// faster than their number.
const LIMIT: usize = 20_000;

/// Operations up to which shared values are tried to be written out, one by one: each try is a
/// round.
const POLISHED: usize = 130;

/// A function's graph and results, and what they cost.
struct Best {
    graph: Graph,
    outputs: Vec<Expr>,
    cost: Operations,
}

impl Best {
    /// A round; `spread` is written out where it is read. Kept where it is cheaper.
    fn improve(&mut self, spread: Option<NodeId>) -> bool {
        let mut network = Network::new(&self.graph, &self.outputs, spread);
        Extraction::new(&mut network).run();
        let (graph, outputs) = rebuild::rebuild(&network, &self.outputs);
        let cost = count(&graph, &outputs);
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

    /// Writes out shared sums and products one by one, as long as a whole turn changes something.
    fn polish(&mut self) {
        let (mut i, mut unchanged) = (0, 0);
        let mut tries = 4 * POLISHED;
        while unchanged < self.graph.len() && tries > 0 {
            let id = NodeId((i % self.graph.len()) as u32);
            (i, unchanged) = (i + 1, unchanged + 1);
            if matches!(self.graph.node(id), Node::Add(..) | Node::Mul(..)) {
                tries -= 1;
                if self.improve(Some(id)) {
                    unchanged = 0;
                }
            }
        }
    }
}

/// The same values with fewer operations, where the pass finds a way.
pub fn factored(graph: Graph, outputs: Vec<Expr>) -> (Graph, Vec<Expr>) {
    let cost = count(&graph, &outputs);
    let mut best = Best {
        graph,
        outputs,
        cost,
    };
    if cost.total() <= LIMIT {
        for _ in 0..ROUNDS {
            if !best.improve(None) {
                break;
            }
        }
        if best.cost.total() <= POLISHED {
            best.polish();
        }
    }
    (best.graph, best.outputs)
}

/// Fewer multiplications and additions, and no more of anything else.
fn cheaper(a: &Operations, b: &Operations) -> bool {
    let rest = |o: &Operations| [o.div, o.sqrt, o.sincos, o.other];
    let mut rests = rest(a).into_iter().zip(rest(b));
    a.mul + a.add < b.mul + b.add && rests.all(|(x, y)| x <= y)
}

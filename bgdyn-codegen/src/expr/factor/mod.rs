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

use super::{Expr, Graph, Operations, count};
use extract::Extraction;
use network::Network;

/// Rounds at the most; each one reads what the one before has made.
const ROUNDS: usize = 4;

/// Operations beyond which a function stays as it is: the pass takes time that grows a little
/// faster than their number.
const LIMIT: usize = 20_000;

/// The same values with fewer operations, where the pass finds a way.
pub fn factored(graph: Graph, outputs: Vec<Expr>) -> (Graph, Vec<Expr>) {
    let mut best = (graph, outputs);
    let mut cost = count(&best.0, &best.1);
    if cost.total() > LIMIT {
        return best;
    }
    let mut improved = |best: &mut (Graph, Vec<Expr>), spread| {
        let mut network = Network::new(&best.0, &best.1, spread);
        Extraction::new(&mut network).run();
        let made = rebuild::rebuild(&network, &best.1);
        let made_cost = count(&made.0, &made.1);
        let better = cheaper(&made_cost, &cost);
        if better {
            (*best, cost) = (made, made_cost);
        }
        better
    };
    for _ in 0..ROUNDS {
        if !improved(&mut best, None) {
            break;
        }
    }
    let effort: usize = std::env::var("EFFORT").map_or(0, |s| s.parse().unwrap());
    let mut tries = effort / best.0.len().max(1);
    let mut i = 0;
    let mut last = 0;
    loop {
        if tries == 0 {
            break;
        }
        let n = best.0.len();
        if i >= n { i = 0; }
        let id = super::NodeId(i as u32);
        if matches!(best.0.node(id), super::Node::Add(..) | super::Node::Mul(..)) {
            tries -= 1;
            if improved(&mut best, Some(id)) {
                last = 0;
            }
        }
        i += 1;
        last += 1;
        if last > best.0.len() {
            break;
        }
    }
    best
}

/// Fewer multiplications and additions, and no more of anything else.
fn cheaper(a: &Operations, b: &Operations) -> bool {
    let rest = |o: &Operations| [o.div, o.sqrt, o.sincos, o.other];
    let pairs = rest(a).into_iter().zip(rest(b));
    a.mul + a.add < b.mul + b.add && pairs.into_iter().all(|(x, y)| x <= y)
}

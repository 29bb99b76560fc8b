//! Computes the cost of a function: a weighted sum of the operations that its compiled code executes.
//!
//! It compares candidates: plans, formulations, a function before and after factoring.
//!
//! The unit is a multiplication or an addition. All weights are integer hundredths of it, so that the
//! comparison is exact. Weights were measured on one core of a Xeon at 2.8 GHz (2026): operations one by
//! one in a loop of sixteen independent ones, and the times of 52 functions generated for the arms in
//! `specs/` fitted as a sum of their parts, in which an operation takes 0.21 to 0.25 ns, with an error of
//! 16 %. On the mechanisms of this repository no choice depends on the weights of divisions, roots and
//! sines: candidates for one function have the same number of them.
//!
//! Small weights on the critical path and on fusable additions decide only between almost equal costs. A
//! sum of angles inside a sine has the weight of five operations, in finished functions only: this decides
//! whether the axes of a tip are turned at its centre of mass. In unfinished graphs (a plan's, or between
//! rounds of factoring) fusable additions have no weight: any weight made derivatives longer by an
//! operation or two.

use std::fmt;

use bgdyn_runtime::{Dd, Operations};

use super::count::Counter;
use super::{Graph, Node, Signed};

/// A multiplication or an addition; both take the same time.
const OPERATION: usize = 100;

/// The saving of a fused multiply-add if the target has one (`fuse.rs`): half an operation (8.3 fused
/// against 12.5 separate ones in a ns on a Zen 5 core). Otherwise it saves nothing. A fifth decides
/// between almost equal costs in favour of such a machine, and only between finished functions.
const FUSABLE: usize = 20;

/// A division: 8.0 times a multiplication in a loop of independent ones, 3.5 times in a chain.
const DIVISION: usize = 800;

/// A square root: 12 times a multiplication in a loop of independent ones, 4.6 times in a chain.
const ROOT: usize = 1200;

/// A pair of sine and cosine: 6.4 to 7.5 ns in the fit, about 30 operations.
const SINE_COSINE: usize = 3000;

/// An additional angle or constant in the sum inside a sine, which is computed exactly: nine operations in
/// the code, for a sum in two words and the second word of the reduction. Five are enough to decide
/// against turning a link's axes to save four operations (which took 4 to 9 % of the time of SCARA and
/// Panda); nine would also prevent common axes of parallel joints, at the price of 33 operations in a
/// UR5's inverse dynamics. Counted in finished functions only: plans are searched by operations, and the
/// plans found are compared with and without turned axes.
const ANGLE: usize = 500;

/// A comparison, a selection, a checked pivot: a comparison and a multiplication of its operand.
/// Estimated.
const OTHER: usize = 200;

/// An additional operation on the critical path. Its effect was not visible in the fit: a processor works
/// on several values at a time, and begins the next call before one is finished. A fifth decides between
/// almost equal costs.
const DEPTH: usize = 20;

/// The cost of computing a function once, part by part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// The operation counts.
    pub operations: Operations,
    /// Number of angles and constants that are added to others inside sines.
    pub angles: usize,
    /// Additions of a product without other readers, which can be fused or are fused.
    pub fusable: usize,
    /// The critical path: the length of the longest chain of dependent operations, in multiplications.
    pub depth: usize,
}

impl Cost {
    /// Returns the cost of an unfinished graph: without fusable additions, because factoring changes which
    /// product is added to which sum, and without sums of angles.
    pub(crate) fn unfinished(self) -> Self {
        Cost {
            fusable: 0,
            angles: 0,
            ..self
        }
    }

    /// Returns the weighted sum, in hundredths of an operation.
    pub fn weighted(&self) -> usize {
        let o = &self.operations;
        let executed = OPERATION * o.total()
            + DIVISION * o.div
            + ROOT * o.sqrt
            + SINE_COSINE * o.sincos
            + ANGLE * self.angles
            + OTHER * o.other;
        // The number of fusable additions is at most that of additions.
        executed + DEPTH * self.depth - FUSABLE * self.fusable
    }
}

impl fmt::Display for Cost {
    /// Prints the sum and its parts: `29.6 = 12 mul + 17 add − 0.2 × 4 fusable + 0.2 × 7 in a row`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let o = &self.operations;
        write!(
            f,
            "{} = {} mul + {} add",
            hundredths(self.weighted()),
            o.mul,
            o.add
        )?;
        let parts = [
            ("+", DIVISION, o.div, "div"),
            ("+", ROOT, o.sqrt, "sqrt"),
            ("+", SINE_COSINE, o.sincos, "sincos"),
            ("+", ANGLE, self.angles, "angles summed"),
            ("+", OTHER, o.other, "other"),
            ("−", FUSABLE, self.fusable, "fusable"),
            ("+", DEPTH, self.depth, "in a row"),
        ];
        for (sign, weight, n, what) in parts.into_iter().filter(|part| part.2 > 0) {
            write!(f, " {sign} {} × {n} {what}", hundredths(weight))?;
        }
        Ok(())
    }
}

/// Converts hundredths to a number that prints with as few decimals as possible.
fn hundredths(n: usize) -> f64 {
    n as f64 / 100.0
}

/// Returns the cost of computing the outputs once.
pub fn cost(graph: &Graph, outputs: &[Signed]) -> Cost {
    let reads = reads(graph, outputs);
    let ready = ready(graph, &reads);
    let mut counter = Counter::new(graph.len());
    let (mut fusable, mut angles) = (0, 0);
    for (_, node) in needed(graph, &reads) {
        counter.add(node);
        fusable += match node {
            Node::Add(a, b) => {
                let fuses = |i: usize| reads[i] == 1 && matches!(graph.nodes[i], Node::Mul(..));
                usize::from(fuses(a.0 as usize) || fuses(b.node.0 as usize))
            }
            Node::MulAdd(..) => 1,
            _ => 0,
        };
        if let Node::Angle(terms, offset, _) = node {
            angles += terms.len() - usize::from(offset.value() == Dd::ZERO);
        }
    }
    Cost {
        operations: counter.operations,
        angles,
        fusable,
        depth: ready.into_iter().max().unwrap_or(0),
    }
}

/// Returns the nodes that are read.
fn needed<'a>(graph: &'a Graph, reads: &'a [u32]) -> impl Iterator<Item = (usize, &'a Node)> {
    let nodes = graph.nodes.iter().enumerate();
    nodes.filter(|&(i, _)| reads[i] > 0)
}

/// Returns the earliest time at which each value that is read is available, in multiplications.
pub(super) fn ready(graph: &Graph, reads: &[u32]) -> Vec<usize> {
    let mut ready = vec![0; graph.len()];
    for (i, node) in needed(graph, reads) {
        let mut begin = 0;
        node.for_each_operand(|operand| begin = begin.max(ready[operand.0 as usize]));
        ready[i] = begin + latency(node);
    }
    ready
}

/// Returns the number of readers of each node, among needed nodes and outputs; 0 for nodes that are not
/// needed.
pub(crate) fn reads(graph: &Graph, outputs: &[Signed]) -> Vec<u32> {
    let mut reads = vec![0; graph.len()];
    for e in outputs {
        reads[e.node.0 as usize] += 1;
    }
    for (i, node) in graph.nodes.iter().enumerate().rev() {
        if reads[i] > 0 {
            node.for_each_operand(|operand| reads[operand.0 as usize] += 1);
        }
    }
    reads
}

/// Returns the latency of an operation, in multiplications: measured for division (3.5), root (4.6) and
/// sine (18), estimated for the others.
pub(super) fn latency(node: &Node) -> usize {
    match node {
        Node::Constant(_) | Node::Leaf(_) => 0,
        // A sum of two, and its second word after the reduction.
        Node::Angle(..) => 3,
        // Nothing waits for the comparisons.
        Node::Pivot(..) => 0,
        Node::Add(..) | Node::Mul(..) | Node::MulAdd(..) => 1,
        Node::Div(..) => 4,
        Node::Sqrt(_) => 5,
        Node::Sin(_) | Node::Cos(_) | Node::Exp(_) | Node::Ln(_) | Node::Tanh(_) => 18,
        Node::Abs(_) | Node::Min(..) | Node::Max(..) | Node::Sign(_) => 1,
        Node::Less(..) | Node::Select(..) => 1,
    }
}

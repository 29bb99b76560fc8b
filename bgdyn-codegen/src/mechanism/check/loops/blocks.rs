//! Arranges rows and dependent velocities in blocks that are solved one after the other.
//!
//! The blocks are the strongly connected parts of the graph of matched rows (Dulmage and Mendelsohn 1958).

use crate::mechanism::CoordinateId;
use crate::mechanism::closure::{Closure, ClosureBlock};

/// An entry below this at all sampled positions is zero.
const ZERO: f64 = 1e-24;

/// Replaces the single block by the blocks of the structure.
pub(super) fn arrange(closure: &mut Closure) {
    let dependents: Vec<usize> = closure.dependents().map(|j| j.0).collect();
    let n = dependents.len();
    let mut reads = vec![vec![false; n]; n];
    for q in &closure.samples {
        let jacobian = closure.solved_rates(q);
        for (row, entries) in jacobian.iter().enumerate() {
            for (d, &j) in dependents.iter().enumerate() {
                reads[row][d] |= entries[j].to_f64().abs() > ZERO;
            }
        }
    }
    let Some(row_of) = matching(&reads) else {
        return;
    };
    // The row of dependent d reads others: it waits for their rows.
    let waits = |d: usize| {
        (0..n)
            .filter(move |&e| e != d)
            .filter(|&e| reads[row_of[d]][e])
            .collect::<Vec<_>>()
    };
    let waits: Vec<Vec<usize>> = (0..n).map(waits).collect();
    let reach: Vec<Vec<bool>> = (0..n).map(|d| reachable(&waits, d)).collect();
    let mut blocks: Vec<Vec<usize>> = Vec::new();
    for d in 0..n {
        let together = |e: &usize| *e == d || (reach[d][*e] && reach[*e][d]);
        if blocks.iter().flatten().all(|e| *e != d) {
            blocks.push((0..n).filter(together).collect());
        }
    }
    // A block waits for those that it reaches: fewest first.
    blocks.sort_by_key(|block| reach[block[0]].iter().filter(|r| **r).count());
    closure.blocks = blocks
        .into_iter()
        .map(|block| ClosureBlock {
            rows: block.iter().map(|&d| row_of[d]).collect(),
            dependents: block.iter().map(|&d| CoordinateId(dependents[d])).collect(),
        })
        .collect();
}

/// Returns the row of each column in a perfect matching.
fn matching(reads: &[Vec<bool>]) -> Option<Vec<usize>> {
    let n = reads.len();
    let mut row_of: Vec<Option<usize>> = vec![None; n];
    for row in 0..n {
        let mut seen = vec![false; n];
        if !augment(reads, row, &mut row_of, &mut seen) {
            return None;
        }
    }
    row_of.into_iter().collect()
}

fn augment(
    reads: &[Vec<bool>],
    row: usize,
    row_of: &mut [Option<usize>],
    seen: &mut [bool],
) -> bool {
    for column in 0..reads.len() {
        if !reads[row][column] || seen[column] {
            continue;
        }
        seen[column] = true;
        let free = match row_of[column] {
            None => true,
            Some(other) => augment(reads, other, row_of, seen),
        };
        if free {
            row_of[column] = Some(row);
            return true;
        }
    }
    false
}

/// Returns the nodes that a node reaches; itself only through others.
fn reachable(next: &[Vec<usize>], from: usize) -> Vec<bool> {
    let mut reached = vec![false; next.len()];
    let mut open = next[from].clone();
    while let Some(node) = open.pop() {
        if !reached[node] {
            reached[node] = true;
            open.extend(&next[node]);
        }
    }
    reached
}

//! Which independent velocities move joints in loops, and whether these joints determine them.

use super::Closure;
use super::solve::rank;
use crate::mechanism::CoordinateId;

/// An entry of S below this part of the largest one of its row is a rounding error.
const ROUNDING: f64 = 1e-18;

impl Closure {
    /// Returns the indices of the independent velocities that move one of these velocities of the open tree at a sampled
    /// position.
    pub fn movers(&self, of: &[CoordinateId]) -> Vec<usize> {
        let mut moves = vec![false; self.independents.len()];
        for q in &self.samples {
            let Some(map) = self.velocity_map(q) else {
                continue;
            };
            for j in of {
                let sizes = map[j.0].iter().map(|s| s.to_f64().abs());
                let largest = sizes.clone().fold(0.0, f64::max);
                for (moves, size) in moves.iter_mut().zip(sizes) {
                    *moves |= size > ROUNDING * largest;
                }
            }
        }
        (0..moves.len()).filter(|&k| moves[k]).collect()
    }

    /// Returns the rank of the rows of S of these velocities of the open tree, in the columns of the independent
    /// velocities with the indices `along`: the largest one at the sampled positions.
    pub fn rank_along(&self, of: &[CoordinateId], along: &[usize]) -> usize {
        let at = |map: Vec<Vec<_>>| {
            let row = |j: &CoordinateId| along.iter().map(|&k| map[j.0][k]).collect();
            rank(
                &mut of.iter().map(row).collect::<Vec<Vec<_>>>(),
                along.len(),
            )
        };
        let maps = self.samples.iter().filter_map(|q| self.velocity_map(q));
        maps.map(at).max().unwrap_or(0)
    }
}

//! Closed positions at random.

use bgdyn_runtime::Dd;

use crate::mechanism::closure::Closure;
use crate::random::Random;

/// Closed positions at random.
const SAMPLES: u64 = 12;

/// Returns closed positions at random; once the blocks are known, on the branch of the start.
pub(super) fn sample(closure: &Closure) -> Vec<Vec<Dd>> {
    let mut q = closure.start.clone();
    let mut random = Random(17);
    let rows = closure.position_rows();
    let next = |_| {
        closure.walk(&rows, &mut q, &mut random);
        q.clone()
    };
    (0..SAMPLES).map(next).collect()
}

/// Returns closed positions at random, each a short way from the start.
pub(super) fn around(closure: &Closure) -> Vec<Vec<Dd>> {
    let rows = closure.position_rows();
    let near = |seed| {
        let mut q = closure.start.clone();
        closure.walk(&rows, &mut q, &mut Random(seed));
        q
    };
    (0..SAMPLES).map(near).collect()
}

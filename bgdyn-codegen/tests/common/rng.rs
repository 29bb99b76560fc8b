//! The random numbers of the tests, the same on every machine.

use bgdyn_codegen::random::Random;

/// A sequence of random numbers.
#[derive(Clone, Debug)]
pub struct Rng(Random);

impl Rng {
    /// Returns the sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Rng(Random(
            seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d_4c95_7f2d,
        ))
    }

    pub fn next(&mut self) -> u64 {
        self.0.word()
    }

    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0.unit()
    }

    /// In (−size, size).
    pub fn within(&mut self, size: f64) -> f64 {
        self.0.signed() * size
    }

    pub fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }

    /// In 0 .. n.
    pub fn below(&mut self, n: usize) -> usize {
        self.0.below(n as u64) as usize
    }

    pub fn pick<'a, T>(&mut self, from: &'a [T]) -> &'a T {
        &from[self.below(from.len())]
    }
}

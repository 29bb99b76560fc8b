//! The states of every timing: the same numbers in all programs that are compared.

use std::f64::consts::PI;

/// Number of states: too many for a branch predictor to learn, few enough for the cache.
pub const STATES: usize = 1024;

/// A state with accelerations and efforts, joint by joint.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Positions: any angle, ±0.3 m.
    pub q: Vec<f64>,
    /// Velocities within ±2.
    pub v: Vec<f64>,
    /// Accelerations within ±2.
    pub a: Vec<f64>,
    /// Efforts within ±10.
    pub tau: Vec<f64>,
}

/// Equally distributed numbers: splitmix64 (Steele, Lea, Flood 2014).
struct Random(u64);

impl Random {
    /// In [−size, size).
    fn within(&mut self, size: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        size * ((z >> 11) as f64 * (2.0 / (1u64 << 53) as f64) - 1.0)
    }
}

/// The states of a mechanism; `slides`: which joints are prismatic.
pub fn states(slides: &[bool]) -> Vec<State> {
    let mut random = Random(0x5eed_5eed_1234_5678);
    let state = |_| {
        let mut joints = |size: f64| slides.iter().map(|_| random.within(size)).collect();
        let turns: Vec<f64> = joints(1.0);
        let reach = |slides: bool| if slides { 0.3 } else { PI };
        State {
            q: turns
                .iter()
                .zip(slides)
                .map(|(x, &s)| reach(s) * x)
                .collect(),
            v: joints(2.0),
            a: joints(2.0),
            tau: joints(10.0),
        }
    };
    (0..STATES).map(state).collect()
}

//! Random states for all timings: the same numbers in all compared programs.

use std::f64::consts::PI;

/// That of the generator; a peer without bgdyn includes this file.
#[path = "../../bgdyn-codegen/src/random.rs"]
#[allow(dead_code)]
mod random;

use random::Random;

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

/// Returns the states of a mechanism; `slides` marks prismatic joints.
pub fn states(slides: &[bool]) -> Vec<State> {
    let mut random = Random(0x5eed_5eed_1234_5678);
    let state = |_| {
        let mut joints = |size: f64| slides.iter().map(|_| size * random.signed()).collect();
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
